"""A picture of the cost curves: time against what grows, log-log, a panel each."""

import statistics
from pathlib import Path


def plot_curves(run: dict, path: Path) -> None:
    """Draw every curve of what --json writes."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    curves = run["curves"]
    columns = min(4, len(curves))
    rows = -(-len(curves) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(3.4 * columns, 2.9 * rows), squeeze=False)
    for axis in axes.flat[len(curves) :]:
        axis.set_visible(False)
    for axis, (name, curve) in zip(axes.flat, curves.items(), strict=False):
        for key, points in curve["lines"].items():
            rates = [(x, statistics.median(run["figures"][figure_name])) for x, figure_name in points]
            if all(y > 0 for _, y in rates):
                axis.plot(*zip(*rates, strict=True), marker="o", markersize=3, linewidth=1, label=key)
        axis.set_xscale("log")
        axis.set_yscale("log")
        axis.set_title(name, fontsize=9)
        axis.set_xlabel(curve["unit"], fontsize=8)
        axis.tick_params(labelsize=7)
        axis.grid(alpha=0.3, which="both", linewidth=0.4)
        axis.legend(fontsize=7)
    axes[0, 0].set_ylabel("ms", fontsize=8)
    figure.suptitle(f"{run['device']}, {run['date']}", fontsize=9)
    figure.tight_layout()
    figure.savefig(path, dpi=120)
    plt.close(figure)
