"""The version of what is installed."""

from importlib.metadata import PackageNotFoundError, version

try:
    __version__ = version("burnish")
except PackageNotFoundError:  # used from a source tree that is not installed
    __version__ = "0+unknown"
