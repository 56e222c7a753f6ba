"""Ctrl-C ends long work soon, without a traceback on the command line, and the engine works after it."""

import os
import signal
import subprocess
import sys
import textwrap
import time

import pytest

# Would take hours, so a test that is not interrupted runs into its time limit.
ENDLESS = {
    "frames": "burnish.render(scene, size=(100, 100), spp=65536, device=device)",
    "reference": "burnish.render(scene, size=(300, 300), sampler=endless, device=device)",
    "points": "burnish.shade(scene.environment, scene.materials[0], endless, *points, device=device)",
}

INTERRUPTED = """
    import os, signal, sys, threading
    import numpy as np
    import burnish
    from burnish import builtin

    device = burnish.Device(name=sys.argv[1])
    scene = builtin.make_scene("sphere")
    scene.environment = builtin.make_environment("spots", 256)
    endless = burnish.Reference(1e-6, max_samples=1 << 30)
    points = [np.tile(np.float32(v), (50_000, 1)) for v in ([0, 0, 1], [1, 0, 0], [0, 0, 1])]
    before = burnish.render(scene, size=(24, 32), device=device).color.copy()
    threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
    try:
        CALL
        sys.exit("it came to its end")
    except KeyboardInterrupt:
        pass
    assert (burnish.render(scene, size=(24, 32), device=device).color == before).all()
    print("works")
"""


@pytest.mark.parametrize("name", ENDLESS)
def test_ctrl_c_ends_long_work_and_the_device_works_on(device, name):
    code = textwrap.dedent(INTERRUPTED).replace("CALL", ENDLESS[name])
    result = subprocess.run(
        [sys.executable, "-c", code, device.name],
        capture_output=True,
        text=True,
        timeout=150,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path), "BURNISH_VALIDATION": "0"},
    )
    assert (result.returncode, result.stdout) == (0, "works\n"), result.stderr[-2000:]


def test_ctrl_c_on_the_command_line_writes_nothing_and_exits_with_130(tmp_path):
    """The picture's old file stays; the interruption comes once the renderer's threads are at work."""
    path = tmp_path / "picture.png"
    path.write_bytes(b"old")
    arguments = ["render", "sphere", "--size", "100x100", "--spp", "65536", "-o", str(path)]
    process = subprocess.Popen(
        [sys.executable, "-m", "burnish", *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    wait_until_busy(process, 3.0)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=150)
    assert (process.returncode, out) == (130, "")
    assert err == "burnish render: interrupted\n"
    assert [(one.name, one.read_bytes()) for one in tmp_path.iterdir()] == [("picture.png", b"old")]


def wait_until_busy(process, cpu_seconds):
    """Wait until a process has used so much of a processor: more than starting takes."""
    tick = os.sysconf("SC_CLK_TCK")
    limit = time.monotonic() + 100
    while time.monotonic() < limit and process.poll() is None:
        with open(f"/proc/{process.pid}/stat") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        if (int(fields[11]) + int(fields[12])) / tick > cpu_seconds:
            return
        time.sleep(0.05)
    process.kill()
    pytest.fail(f"the command ended with {process.returncode}: {process.communicate()[1][-2000:]}")
