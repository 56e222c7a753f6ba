"""What accuracy costs in time: errors against milliseconds, for every sampler on one scale."""

from burnish.study.metrics import Errors, measure_errors
from burnish.study.subject import Points
from burnish.study.timing import AlternatingRuns, Timing, frame_times, time_alternating

__all__ = [
    "AlternatingRuns",
    "Errors",
    "Points",
    "Timing",
    "frame_times",
    "measure_errors",
    "time_alternating",
]
