"""Figures without a display."""

from typing import Any

from burnish.study.extras import missing_extra


def new_figure(width: float, height: float) -> Any:
    """Make an empty figure that is drawn by Agg.

    Parameters
    ----------
    width, height : float
        Inches.

    Raises
    ------
    ImportError
        Without matplotlib.
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError as error:
        raise missing_extra("matplotlib", "study", "A plot") from error
    figure = Figure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(figure)
    return figure
