"""The command line, ``burnish``."""

from burnish.cli.main import main, make_parser

__all__ = ["main", "make_parser"]
