"""Why the compiled part cannot be loaded, in one sentence that names the remedy."""

from functools import cache

INSTALL_LOADER = "sudo apt-get install libvulkan1"
LOADER_MISSING = f"the Vulkan loader libvulkan.so.1 is not installed; install it with: {INSTALL_LOADER}"
NOT_BUILT = "the compiled module burnish._core is missing; build it with: scripts/setup, or pip install ."


def explain(error: ImportError) -> str:
    """Turn what the import of ``burnish._core`` raised into one sentence."""
    text = str(error)
    if "libvulkan" in text:
        return LOADER_MISSING
    if isinstance(error, ModuleNotFoundError) or (error.name == "burnish._core" and error.path is None):
        return NOT_BUILT
    return f"the compiled module burnish._core cannot be loaded: {text}"


@cache
def load_failure() -> str | None:
    """Import ``burnish._core``; None when that works, else the reason."""
    try:
        import burnish._core  # noqa: F401
    except ImportError as error:
        return explain(error)
    return None
