"""Fails the test, or the run, in which the validation layer complained while a device was closed."""

import gc
import sys

import pytest

_seen = 0


def _new_messages():
    """Those since the last call; none where no test imported the engine."""
    global _seen
    core = sys.modules.get("burnish._core")
    messages = core.closing_messages()[_seen:] if core else []
    _seen += len(messages)
    return messages


@pytest.fixture(autouse=True)
def closing_messages_fail():
    """A device that this test closed had given everything back."""
    yield
    assert _new_messages() == []


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session, exitstatus):
    """Close what fixtures and the package kept; what closes later still ends the process with code 1."""
    core = sys.modules.get("burnish._core")
    if core is None:
        return
    if "burnish._device" in sys.modules:
        sys.modules["burnish._device"]._forget_device()
    gc.collect()
    messages = _new_messages()
    if messages:
        print("\nwhile devices were closed after the last test:", *messages, sep="\n", file=sys.__stderr__)
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
    core.exit_on_closing_messages()
