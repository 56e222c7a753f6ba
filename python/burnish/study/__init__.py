"""What accuracy costs in time: errors against milliseconds, for every sampler on one scale.

`accuracy` measures samplers on one scene or on points; `sweep` over a grid of scenes, materials, environments
and filters. Both give a `Study`, which holds the rows and makes tables, curves and pages of them.
`measure_paper` does the evaluation of the paper on regular sampling again.
"""

from burnish.study.accuracy import accuracy
from burnish.study.metrics import Errors, measure_errors
from burnish.study.paper import Paper, PaperSettings, measure_paper
from burnish.study.runner import StudyInterrupted
from burnish.study.sources import EnvironmentSource
from burnish.study.study import Study
from burnish.study.subject import Points
from burnish.study.sweep import sweep
from burnish.study.timing import AlternatingRuns, Timing, frame_times, time_alternating

__all__ = [
    "AlternatingRuns",
    "EnvironmentSource",
    "Errors",
    "Paper",
    "PaperSettings",
    "Points",
    "Study",
    "StudyInterrupted",
    "Timing",
    "accuracy",
    "frame_times",
    "measure_errors",
    "measure_paper",
    "sweep",
    "time_alternating",
]
