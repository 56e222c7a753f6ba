"""The reference as a candidate, for errors that no sampler meets: it is asked for its standard error."""

from burnish import _core
from burnish.advice.probe import Probe
from burnish.advice.search import Candidate
from burnish.samplers import sampler_to_text

TRIAL_SAMPLES = 2048
MOST_SAMPLES = 65536
MOST_MS = 60e3
"""A frame that would take longer is not chosen unasked."""


def predict_reference(probe: Probe, target_error: float, pixels: int) -> Candidate:
    """Predict what a progressive reference of that standard error would take and reach.

    A short one is drawn on the small picture: its standard error falls with the root of its samples, its time
    grows with them.

    Parameters
    ----------
    probe : Probe
        After its survey.
    target_error : float
        Relative RMSE, taken as the standard error.
    pixels : int
        Of the large picture.

    Returns
    -------
    candidate : Candidate
        Of the family "reference"; its count is the number of samples a pixel.
    """
    trial = probe.draw(_core.Reference(1e-9, "progressive", TRIAL_SAMPLES), probe.size)
    report = trial.report
    needed = TRIAL_SAMPLES * max(1.0, (report.standard_error / target_error) ** 2)
    samples = int(min(needed, MOST_SAMPLES))
    error = max(target_error, report.standard_error * (TRIAL_SAMPLES / samples) ** 0.5)
    predicted_ms = report.total_ms * samples / TRIAL_SAMPLES * pixels / trial.alpha.size
    text = sampler_to_text(_core.Reference(target_error, method="progressive"))
    return Candidate(text, "reference", samples, error, predicted_ms, is_probed=True)


def with_last_resort(
    candidates: list[Candidate], closest: Candidate, last: Candidate
) -> tuple[Candidate, bool]:
    """Choose between the closest sampler and the reference.

    Parameters
    ----------
    candidates : list of Candidate
        Gets the reference as its last.
    closest : Candidate
        Of the samplers.
    last : Candidate
        The reference.

    Returns
    -------
    chosen : Candidate
    is_reference : bool
        Whether the reference is affordable and more accurate.
    """
    candidates.append(last)
    is_better = last.predicted_ms <= MOST_MS and last.predicted_error < closest.predicted_error
    return (last, True) if is_better else (closest, False)
