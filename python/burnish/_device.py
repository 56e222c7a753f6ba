"""The device that is used where none is given."""

import threading

from burnish._core import Device

_lock = threading.Lock()
_device: Device | None = None


def default_device() -> Device:
    """Open the best device at first use, and the same one ever after, from any thread."""
    global _device
    with _lock:
        if _device is None:
            _device = Device()
        return _device
