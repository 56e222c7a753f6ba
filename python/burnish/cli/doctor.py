"""``burnish doctor``: what is missing here."""

import argparse
from pathlib import Path

from burnish._progress import progress_bar

HELP = "say what is missing here and how to install it"
EXAMPLES = """\
examples:
  burnish doctor
  burnish doctor --device llvmpipe
  burnish doctor --hard-cases --lookup both -o hard-cases.md
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Parameters
    ----------
    parser : ArgumentParser
        Of the subcommand.
    """
    parser.add_argument("--device", metavar="NAME", help="part of a Vulkan device's name (default: the best)")
    parser.add_argument(
        "--hard-cases",
        action="store_true",
        help="measure the worst inputs against their bounds: takes minutes on a CPU",
    )
    parser.add_argument(
        "--lookup",
        choices=("auto", "sampler", "software", "both"),
        help="how the hard cases read maps (default: auto)",
    )
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="also write the table of hard cases as Markdown"
    )


def run(options: argparse.Namespace) -> int:
    """Print what the doctor found; 0 when this machine can render, else 1.

    Parameters
    ----------
    options : Namespace
        As `add_arguments` declares them.
    """
    from burnish.doctor import examine

    if (options.output or options.lookup) and not options.hard_cases:
        raise ValueError("--hard-cases: expected it beside --output and --lookup")
    path = Path(options.output) if options.output else None
    if path is not None and not path.parent.is_dir():
        raise ValueError(f"{path}: expected an existing folder, got {path.parent}")
    wanted = (options.lookup or "auto") if options.hard_cases else ""
    with progress_bar("hard cases") as advance:
        report = examine(options.device or "", hard_cases=wanted, progress=advance)
    print(report)
    if path is not None and report.hard_cases:
        from burnish.hardcases import CASES, page
        from burnish.images.files import write_text

        write_text(path, page(report.hard_cases, CASES))
        print(f"wrote {path}")
    return 0 if report.can_render else 1
