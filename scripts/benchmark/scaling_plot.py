"""A picture of the cost curves: time against what grows, log-log, a panel each; thick: of all threads."""

import statistics
from pathlib import Path

from .bench import CPU

ORDER = ("cores", "pixels", "triangles", "materials", "lobes")


def plot_curves(run: dict, path: Path) -> None:
    """Draw every curve of what --json writes."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.ticker import NullFormatter

    curves = [(name, run["curves"][name]) for name in ORDER if name in run["curves"]]
    columns = min(3, len(curves))
    rows = -(-len(curves) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(3.6 * columns, 2.9 * rows), squeeze=False)
    for axis in axes.flat[len(curves) :]:
        axis.set_visible(False)
    for axis, (name, lines) in zip(axes.flat, curves, strict=False):
        for key, points in lines.items():
            curve = [(x, statistics.median(run["figures"][figure_name])) for x, figure_name in points]
            width = 2 if key.endswith(CPU) else 0.8  # what other work on the machine hardly changes
            axis.plot(*zip(*curve, strict=True), marker="o", markersize=3, linewidth=width, label=key)
        axis.set_xscale("log")
        axis.set_yscale("log")
        if curve[-1][0] < 100:
            axis.set_xticks([x for x, _ in curve], [str(x) for x, _ in curve], minor=False)
            axis.xaxis.set_minor_formatter(NullFormatter())
        axis.yaxis.set_minor_formatter(NullFormatter())
        axis.set_xlabel(name, fontsize=8)
        axis.tick_params(labelsize=7)
        axis.grid(alpha=0.3, which="both", linewidth=0.4)
        axis.legend(fontsize=7)
    for row in axes:
        row[0].set_ylabel("ms", fontsize=8)
    figure.suptitle(f"{run['device']}, {run['date']}", fontsize=9)
    figure.tight_layout()
    figure.savefig(path, dpi=120)
    plt.close(figure)
