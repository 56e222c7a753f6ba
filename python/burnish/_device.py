"""The device that is used where none is given."""

import os
import threading

from burnish._core import Device

_lock = threading.Lock()
_device: Device | None = None


def default_device() -> Device:
    """Open the best device at first use, and the same one ever after, from any thread.

    One that was lost, or that was opened before this process was forked, is replaced.
    """
    global _device
    with _lock:
        if _device is None or _device.is_lost:
            _device = Device()
        return _device


def _forget_device() -> None:
    global _lock, _device
    _lock = threading.Lock()  # another thread may have held it, and that one stayed behind
    _device = None


os.register_at_fork(after_in_child=_forget_device)
