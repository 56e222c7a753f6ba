"""`doctor` looks for what is missing on this machine and tries the engine."""

from burnish.doctor.examination import DoctorReport, doctor, examine
from burnish.doctor.finding import Finding

__all__ = ["DoctorReport", "Finding", "doctor", "examine"]
