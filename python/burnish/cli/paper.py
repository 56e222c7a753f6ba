"""``burnish study --paper``: the paper's evaluation, done again."""

import argparse
import sys

from burnish.cli.study_arguments import PAPER_REPEATS, add_arguments, require_outputs

TAKEN = ("paper", "quick", "repeats", "device", "output", "json", "quiet")
"""Arguments of ``burnish study`` that mean something here; the paper decides about the others."""


def _refuse_others(options: argparse.Namespace) -> None:
    """Raise ValueError for an argument that would have no effect."""
    parser = argparse.ArgumentParser()
    add_arguments(parser)
    for name, default in vars(parser.parse_args([])).items():
        value = getattr(options, name)
        if name not in TAKEN and value != default:
            shown = f"SCENE {value[0]}" if name == "scenes" else f"--{name.replace('_', '-')}"
            raise ValueError(f"--paper: expected none of the scenes and their arguments, got {shown}")


def run_paper(options: argparse.Namespace) -> int:
    """Measure, write and print: 0 done, 130 interrupted, with nothing written.

    Parameters
    ----------
    options : Namespace
        Of ``burnish study``.
    """
    from burnish._core import Device
    from burnish.study.accuracy import require_repeats
    from burnish.study.paper import PaperSettings, list_verdicts, measure_paper

    _refuse_others(options)
    require_outputs(options)
    repeats = PAPER_REPEATS if options.repeats is None else options.repeats
    require_repeats(repeats)
    settings = PaperSettings.quick(repeats) if options.quick else PaperSettings(repeats=repeats)
    device = Device(name=options.device) if options.device else None
    try:
        paper = measure_paper(settings, device, options.command_line)
        if options.json:
            paper.save_json(options.json)
        if options.output:
            paper.save_html(options.output)
    except KeyboardInterrupt:
        print("burnish study: interrupted; nothing half-written is left", file=sys.stderr)
        return 130
    if options.quiet:
        return 0
    for verdict in list_verdicts(paper.numbers):
        print(verdict)
    print()
    for name in (options.output, options.json):
        if name:
            print(f"wrote {name}")
    return 0
