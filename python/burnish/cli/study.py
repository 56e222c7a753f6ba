"""``burnish study``: what accuracy costs."""

import argparse
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from burnish.cli.study_arguments import DEFAULT_REPEATS, require_outputs
from burnish.cli.study_arguments import add_arguments as add_arguments

if TYPE_CHECKING:
    from burnish._core import Material
    from burnish.study import Study

HELP = "measure error and time of samplers, as a table, curves and a page to look at"

DESCRIPTION = """\
Measure what accuracy costs: every sampler draws every scene under every environment, its error against a
reference is taken, and then all samplers take turns and are timed (medians of --repeats runs, warm, without
compilation, noise stated). Errors count where objects are: relative RMSE of linear radiance, RMS of the
displayed picture (98th percentile at 1, clipped), FLIP, and the largest.

With --journal an interrupted study goes on where it stopped when the same command is given again.

With --paper, instead of scenes: the evaluation of the CGI 2014 paper on regular sampling, done again on its
own setup, every statement with a verdict (some minutes; --quick for a first look).
"""

EXAMPLES = """\
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

DEFAULT_SAMPLERS = ("regular:5,14,30", "importance:5,14,30:fibonacci", "matched:5,14,30", "prefiltered")


def _samplers(texts: Sequence[str]) -> list[str]:
    from burnish.samplers import expand_counts, sampler_from_text

    expanded = [one for text in texts for one in expand_counts(text)]
    for one in expanded:
        sampler_from_text(one, "--samplers")
    return expanded


def _materials(slopes: Sequence[tuple[float, float]] | None) -> "list[Material] | None":
    from burnish._core import KurtLobe, Material

    if slopes is None:
        return None
    return [Material(lobes=[KurtLobe(roughness=pair)]) for pair in slopes]


def _measure(options: argparse.Namespace) -> "Study":
    from burnish.study import EnvironmentSource, sweep

    lights = [
        EnvironmentSource.from_text(name, options.face_size, options.rotate_env) for name in options.env
    ]
    return sweep(
        _samplers(options.samplers or DEFAULT_SAMPLERS),
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
    from burnish._core import FileError
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


def run(options: argparse.Namespace) -> int:
    """Measure, print and write; 0 done, 130 interrupted: what was finished is written in both cases.

    Parameters
    ----------
    options : Namespace
        As `add_arguments` declares them.
    """
    from burnish.study import StudyInterrupted

    if options.paper:
        from burnish.cli.paper import run_paper

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
