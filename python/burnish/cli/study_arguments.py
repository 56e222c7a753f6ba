"""Arguments of ``burnish study``, which measures scenes or does the paper again."""

import argparse
from pathlib import Path

from burnish.cli.arguments import SCENE_HELP, parse_size
from burnish.filters import FILTERS

SAMPLERS_HELP = (
    "as for --sampler of burnish render, with several counts at once and any parameter by name: "
    "regular:5,14,30 regular:14:published importance:14:mip_bias=1 "
    "(default: every sampler there is, at 5, 14 and 30 samples)"
)
DEFAULT_REPEATS = 5
PAPER_REPEATS = 3


def parse_roughness(text: str) -> tuple[float, float]:
    """Read ``0.1`` or ``0.2/0.075``."""
    try:
        slopes = [float(part) for part in text.split("/")]
    except ValueError:
        slopes = []
    if len(slopes) not in (1, 2):
        raise argparse.ArgumentTypeError(
            f"expected a slope such as 0.1, or two such as 0.2/0.075, got {text!r}"
        )
    return slopes[0], slopes[-1]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Parameters
    ----------
    parser : ArgumentParser
        Of the subcommand.
    """
    parser.add_argument("scenes", metavar="SCENE", nargs="*", help=SCENE_HELP)
    grid = parser.add_argument_group("what is drawn")
    grid.add_argument(
        "--env",
        metavar="ENV",
        nargs="+",
        default=["studio"],
        help="environments: .hdr or .exr files, or built-in: studio, sky, spots, uniform, with arguments "
        "such as spots:seed=2:face_size=512 (default: studio)",
    )
    grid.add_argument(
        "--roughness",
        metavar="M",
        nargs="+",
        type=parse_roughness,
        help="put one lobe of these slopes, r0 = 1, in place of each scene's first material: 0.1 0.2/0.075",
    )
    grid.add_argument("--samplers", metavar="S", nargs="+", default=None, help=SAMPLERS_HELP)
    grid.add_argument(
        "--filter",
        nargs="+",
        choices=FILTERS,
        default=["gauss6"],
        help="reduction filters of the environment's pyramid (default: gauss6)",
    )
    grid.add_argument(
        "--size", type=parse_size, default=(180, 320), metavar="HxW", help="height x width (default: 180x320)"
    )
    grid.add_argument("--spp", type=int, default=1, metavar="N", help="frames to accumulate (default: 1)")
    grid.add_argument("--camera", metavar="NAME|INDEX", help="a camera of the scene (default: the first)")
    grid.add_argument("--rotate-env", type=float, default=0.0, metavar="DEG", help="turn the light about +y")
    grid.add_argument("--face-size", type=int, metavar="N", help="texels along a cube face, a power of two")

    how = parser.add_argument_group("how it is measured")
    how.add_argument(
        "--reference",
        metavar="S",
        default="reference:0.005",
        help="sampler that draws the truth; its standard error should be a tenth of the errors it judges; "
        "half of it takes four times as long (default: reference:0.005)",
    )
    how.add_argument(
        "--repeats",
        type=int,
        metavar="N",
        help=f"timed runs of each (default: {DEFAULT_REPEATS}, of --paper {PAPER_REPEATS})",
    )
    how.add_argument("--device", metavar="NAME", default="", help="part of a Vulkan device's name")
    how.add_argument(
        "--journal", metavar="FILE", help="keep finished rows here, and take up where it stopped"
    )
    how.add_argument("--scheduler", metavar="ADDRESS", help="measure on the workers of this dask scheduler")
    how.add_argument(
        "--workers",
        type=int,
        default=0,
        metavar="N",
        help="measure in N processes of this machine; they disturb one another's times (default: none)",
    )

    paper = parser.add_argument_group("the paper")
    paper.add_argument(
        "--paper", action="store_true", help="do the paper's evaluation again; takes no scenes, -o, --json"
    )
    paper.add_argument("--quick", action="store_true", help="with --paper: small maps, pictures and frames")

    out = parser.add_argument_group("what is written")
    out.add_argument("-o", "--output", metavar="FILE", help="the page, .html")
    out.add_argument("--json", metavar="FILE", help="the rows as JSON")
    out.add_argument("--csv", metavar="FILE", help="the rows as a table")
    out.add_argument("--plot", metavar="FILE", help="error against frame time: .png, .svg or .pdf")
    out.add_argument("-q", "--quiet", action="store_true", help="do not print the table")


def outputs_of(options: argparse.Namespace) -> list[str]:
    """List the files that shall be written.

    Parameters
    ----------
    options : Namespace
        Of ``burnish study``.
    """
    return [name for name in (options.output, options.json, options.csv, options.plot) if name]


def require_outputs(options: argparse.Namespace) -> None:
    """Find out before the work that a file could not be written, or a package is missing.

    Parameters
    ----------
    options : Namespace
        Of ``burnish study``.
    """
    from burnish.study.figure import new_figure

    for option, name, suffixes in (
        ("--output", options.output, (".html", ".htm")),
        ("--plot", options.plot, (".png", ".svg", ".pdf")),
    ):
        if name and Path(name).suffix.lower() not in suffixes:
            raise ValueError(f"{option}: expected a name ending in {' or '.join(suffixes)}, got {name!r}")
        if name:
            new_figure(1.0, 1.0)
    for name in outputs_of(options):
        if not Path(name).parent.is_dir():
            raise ValueError(f"{name}: expected an existing folder, got {Path(name).parent}")
