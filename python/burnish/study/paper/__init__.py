"""The evaluation of *Real-Time Rendering of Glossy Materials with Regular Sampling* (CGI 2014), done again.

`measure_paper` makes the numbers and pictures, `list_verdicts` judges them, `Paper.save_html` shows them.
"""

from burnish.study.paper.judging import Verdict
from burnish.study.paper.measure import Paper, measure_paper
from burnish.study.paper.settings import PaperSettings
from burnish.study.paper.verdicts import list_verdicts

__all__ = ["Paper", "PaperSettings", "Verdict", "list_verdicts", "measure_paper"]
