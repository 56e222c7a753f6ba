"""What to say when an optional package is missing."""


def missing_extra(package: str, extra: str, purpose: str) -> ImportError:
    """Make the error for a missing package.

    Parameters
    ----------
    package : str
        As pip knows it.
    extra : str
        Extra of Burnish that contains it.
    purpose : str
        What needs it, as the start of a sentence.
    """
    return ImportError(
        f"{purpose} needs the package {package}; install it with: pip install 'burnish[{extra}]'"
    )
