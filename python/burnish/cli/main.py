"""The command line: one file a command, each with its help, its arguments and what it does."""

import argparse
import os
import shlex
import sys
from collections.abc import Sequence

from burnish._extension import load_failure
from burnish._version import __version__
from burnish.cli import advise, doctor, explain, render, study
from burnish.cli.arguments import Parser

COMMANDS = {"render": render, "explain": explain, "advise": advise, "study": study, "doctor": doctor}


def make_parser() -> argparse.ArgumentParser:
    """Build the parser of all commands."""
    parser = Parser(prog="burnish", description="Glossy materials under environment light.")
    parser.add_argument("--version", action="version", version=f"burnish {__version__}")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    for name, command in COMMANDS.items():
        made = commands.add_parser(
            name,
            help=command.HELP,
            description=getattr(command, "DESCRIPTION", command.HELP),
            epilog=command.EXAMPLES,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )
        command.add_arguments(made)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : sequence of str or None
        None: those of the process.

    Returns
    -------
    code : int
        0 done; 1 this machine cannot render (doctor), or no sampler meets the error (advise); 2 an error, in
        one line on stderr; 130 interrupted.
    """
    given = sys.argv[1:] if arguments is None else list(arguments)
    options = make_parser().parse_args(given)
    options.command_line = shlex.join(["burnish", *given])  # what is written says how it was made
    try:
        reason = load_failure()
        if reason is not None and options.command != "doctor":
            raise ImportError(reason)
        code: int = COMMANDS[options.command].run(options)
        return code
    except KeyboardInterrupt:
        print(f"burnish {options.command}: interrupted", file=sys.stderr)
        return 130
    except BrokenPipeError:
        # The reader, such as head, has seen enough. What is still buffered must not raise again at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (ValueError, OSError, RuntimeError, ImportError, MemoryError, FloatingPointError) as error:
        text = " ".join(str(error).split()) or type(error).__name__
        print(f"burnish {options.command}: error: {text}", file=sys.stderr)
        return 2
