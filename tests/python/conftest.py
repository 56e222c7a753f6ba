"""Fixtures every test may ask for."""

import os
import signal
from pathlib import Path

# Read by the library when a device is made: a validation error then fails the test that caused it.
os.environ.setdefault("BURNISH_VALIDATION", "1")

import numpy as np
import pytest

pytest_plugins = ["closing_check"]

# A shell that starts the tests in the background has them, and the commands they interrupt, ignore Ctrl-C.
if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)

REPOSITORY = Path(__file__).resolve().parents[2]
# What is measured on the driver is kept between runs, but not among what the user's programs measured.
os.environ.setdefault("BURNISH_CACHE", str(REPOSITORY / "build/cache"))


def pytest_configure(config):
    """Choose one lookup for the whole run, programs that tests start included."""
    try:
        from burnish import Device, VulkanError
    except ImportError as error:
        config.burnish_header = f"burnish: {error}"
        return
    try:
        device = Device()
    except VulkanError as error:
        config.burnish_header = f"burnish: {error}"
        return
    os.environ["BURNISH_LOOKUP"] = device.lookup
    config.burnish_header = f"{device.driver}, lookup by {device.lookup}: {device.lookup_reason}"


def pytest_report_header(config):
    return config.burnish_header


@pytest.fixture(autouse=True)
def strict_arithmetic():
    """Division by zero, overflow and invalid operations raise; a density's far tail may underflow to 0."""
    with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
        yield


@pytest.fixture
def rng():
    """Random numbers that are the same in every run."""
    return np.random.default_rng(20140619)


@pytest.fixture(scope="session")
def shared_data():
    """Folder of environments, scenes and hostile files beside the repository."""
    path = REPOSITORY.parent / "shared" / "data"
    if not path.is_dir():
        pytest.skip(f"needs the test files in {path}")
    return path


@pytest.fixture(scope="session")
def device():
    """Return the one Vulkan device of the session."""
    import burnish

    return burnish.Device()
