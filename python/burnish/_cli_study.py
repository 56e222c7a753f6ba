"""``burnish study``: what it takes, its help, and what it does."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from burnish import Material
    from burnish.study import Study

STUDY_HELP = "measure error and time of samplers, as a table, curves and a page to look at"

STUDY_DESCRIPTION = """\
Measure what accuracy costs: every sampler draws every scene under every environment, its error against a
reference is taken, and then all samplers take turns and are timed (medians of --repeats runs, warm, without
compilation, noise stated). Errors count where objects are: relative RMSE of linear radiance, RMS of the
displayed picture (98th percentile at 1, clipped), FLIP, and the largest.

With --journal an interrupted study goes on where it stopped when the same command is given again.

With --paper, instead of scenes: the evaluation of the CGI 2014 paper on regular sampling, done again on its
own setup, every statement with a verdict (some minutes; --quick for a first look).
"""

STUDY_EXAMPLES = """\
examples:
  burnish study sphere -o page.html
  burnish study model.glb --env world.exr --samplers regular:5,14,30 importance:5,14,30:fibonacci -o page.html
  burnish study sphere --roughness 0.05 0.1 0.2/0.075 --env spots:seed=1 spots:seed=2 --csv rows.csv
  burnish study spheres --filter box gauss6 --journal long.jsonl --json rows.json --plot curves.png
  burnish study sphere --env spots --workers 2 --journal long.jsonl -o page.html
  burnish study sphere --env spots --scheduler tcp://host:8786 --json rows.json
  burnish study --paper -o paper.html --json paper.json

The page is one file that needs no other: tables, curves, a slider to compare pictures. Pages and plots need
pip install 'burnish[study]', workers need pip install 'burnish[cluster]'.
"""

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


def add_study_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Parameters
    ----------
    parser : ArgumentParser
        Of the subcommand.
    """
    from burnish._cli_arguments import SCENE_HELP, parse_size

    parser.description = STUDY_DESCRIPTION
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
        choices=("box", "gauss4", "gauss6"),
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


def default_samplers() -> list[str]:
    """Name every sampler that this build of the engine has."""
    from burnish import _core

    names = ["regular:5,14,30", "importance:5,14,30:fibonacci"]
    names += ["matched:5,14,30"] if hasattr(_core, "Matched") else []
    return names + (["prefiltered"] if hasattr(_core, "Prefiltered") else [])


def _outputs(options: argparse.Namespace) -> list[str]:
    return [name for name in (options.output, options.json, options.csv, options.plot) if name]


def require_outputs(options: argparse.Namespace) -> None:
    """Find out before the work that a file could not be written, or a package is missing."""
    from burnish.study.plots import new_figure

    for option, name, suffixes in (
        ("--output", options.output, (".html", ".htm")),
        ("--plot", options.plot, (".png", ".svg", ".pdf")),
    ):
        if name and Path(name).suffix.lower() not in suffixes:
            raise ValueError(f"{option}: expected a name ending in {' or '.join(suffixes)}, got {name!r}")
        if name:
            new_figure(1.0, 1.0)
    for name in _outputs(options):
        if not Path(name).parent.is_dir():
            raise ValueError(f"{name}: expected an existing folder, got {Path(name).parent}")


def _samplers(texts: Sequence[str]) -> list[str]:
    from burnish.study.sampler_text import expand_counts, sampler_from_text

    expanded = [one for text in texts for one in expand_counts(text)]
    try:
        for one in expanded:
            sampler_from_text(one)
    except ValueError as error:
        raise ValueError(str(error).replace("--sampler:", "--samplers:", 1)) from error
    return expanded


def _materials(slopes: Sequence[tuple[float, float]] | None) -> "list[Material] | None":
    from burnish import KurtLobe, Material

    if slopes is None:
        return None
    return [Material(lobes=[KurtLobe(roughness=pair)]) for pair in slopes]


def _measure(options: argparse.Namespace) -> "Study":
    from burnish.study import EnvironmentSource, sweep

    lights = [
        EnvironmentSource.from_text(name, options.face_size, options.rotate_env) for name in options.env
    ]
    return sweep(
        _samplers(options.samplers or default_samplers()),
        options.scenes,
        lights,
        _materials(options.roughness),
        options.filter,
        options.reference,
        options.camera,
        options.size,
        options.spp,
        DEFAULT_REPEATS if options.repeats is None else options.repeats,
        options.device,
        journal=options.journal,
        keep_pictures=bool(options.output),
        scheduler=options.scheduler,
        workers=options.workers,
        command=options.command_line,
    )


def _write(study: "Study", options: argparse.Namespace) -> None:
    from burnish import FileError
    from burnish.study.findings import list_findings

    if not options.quiet:
        print(study.format_table())
        print("", *list_findings(study), "", sep="\n")
    failures = []
    for name, save in (
        (options.json, study.save_json),
        (options.csv, study.save_csv),
        (options.plot, study.plot),
        (options.output, study.save_html),
    ):
        try:
            if name:
                save(name)
        except FileError as error:
            failures.append(str(error))  # what was measured for long is written wherever it can be
        else:
            if name and not options.quiet:
                print(f"wrote {name}")
    if failures:
        raise FileError("; ".join(failures))


def run_study(options: argparse.Namespace) -> int:
    """``burnish study``: 0 done, 130 interrupted; what was finished is written in both cases."""
    from burnish.study import StudyInterrupted

    if options.paper:
        from burnish._cli_paper import run_paper

        return run_paper(options)
    if options.quick:
        raise ValueError("--quick: expected --paper beside it")
    if not options.scenes:
        raise ValueError("the following arguments are required: SCENE, or --paper")
    require_outputs(options)
    try:
        _write(_measure(options), options)
    except StudyInterrupted as interruption:
        study = interruption.study
        if study.rows:
            _write(study, options)
        again = (
            "the same command takes up from here" if options.journal else "--journal FILE would let it go on"
        )
        print(f"burnish study: interrupted after {len(study.rows)} rows; {again}", file=sys.stderr)
        return 130
    return 0
