"""The interpreter ends while threads work: the process ends with its own exit code, and says nothing."""

import os
import subprocess
import sys
import textwrap

import pytest

SETUP = """
    import sys, threading, time
    import numpy as np
    import burnish

    scene = burnish.Scene.sphere(burnish.Material(diffuse=0.5, lobes=[burnish.KurtLobe(roughness=0.3)]))
    scene.environment = burnish.Environment.from_faces(np.ones((6, 1, 1, 3), np.float32))
    has_begun = threading.Event()

    def start(work):
        def loop():
            while True:
                work()
                has_begun.set()
        threading.Thread(target=loop, daemon=True).start()
"""

RENDER = "start(lambda: burnish.render(scene, size=(64, 64), sampler=burnish.Prefiltered()))"
CALLED_BACK = """
    def step(share, text):
        has_begun.set()
    start(lambda: burnish.render(scene, size=(64, 64), sampler=burnish.Prefiltered(), spp=64, progress=step))
"""
WAITS_IN_PYTHON = """
    def step(share, text):
        has_begun.set()
        threading.Event().wait()
    start(lambda: burnish.render(scene, size=(64, 64), sampler=burnish.Prefiltered(), progress=step))
"""
SHADE = """
    up = np.ascontiguousarray(np.broadcast_to([0, 1, 0], (20000, 3)), np.float32)
    across = np.ascontiguousarray(np.roll(up, 1, axis=1))
    lobes = burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)])
    start(lambda: burnish.shade(scene.environment, lobes, burnish.Importance(100), up, across, up))
"""
STUDY = """
    def work():
        burnish.study.accuracy(
            scene, ["prefiltered", "regular:5"], reference="reference:0.1", size=(16, 16), repeats=1
        )

    import burnish.study
    start(work)
"""
LOADS = """
    image = np.ones((256, 512, 3), np.float32)
    start(lambda: burnish.Environment.from_lat_long(image, 256))
"""
OPENS = "start(lambda: burnish.Device())"

WORK = {
    "render": RENDER,
    "render with callbacks": CALLED_BACK,
    "callback that waits": WAITS_IN_PYTHON,
    "shade": SHADE,
    "study": STUDY,
    "load": LOADS,
    "open": OPENS,
}
END = {"end of the script": ("", 0), "sys.exit": ("sys.exit(7)", 7), "exception": ("raise KeyError('x')", 1)}


def run(code, timeout=120):
    return subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path), "BURNISH_VALIDATION": "0"},
        capture_output=True,
        text=True,
        timeout=timeout,
    )


def program(*parts):
    return "\n".join(textwrap.dedent(part) for part in (SETUP, *parts))


ROWS = [(work, end) for work in WORK for end in END if end == "end of the script" or work == "render"]


@pytest.mark.parametrize(("work", "end"), ROWS, ids=[f"{work}-{end}" for work, end in ROWS])
def test_exit_code_is_the_script_s_while_a_daemon_thread_works(work, end):
    last, expected = END[end]
    for delay in (0.0, 0.05, 0.2):
        found = run(program(WORK[work], "has_begun.wait()", f"time.sleep({delay})", last))
        assert found.returncode == expected, found.stderr[-2000:]
        if expected == 0:
            assert found.stderr == ""


def test_code_that_runs_at_exit_may_draw():
    """In the thread that ends the interpreter, also before and after others were brought to rest."""
    before = "import atexit; atexit.register(lambda: draw())"
    after = f"""
        def draw():
            print(burnish.render(scene, size=(8, 8)).color.shape)

        {RENDER}
        has_begun.wait()
        atexit.register(draw)
    """
    found = run(before + "\n" + program(after))
    assert (found.returncode, found.stderr) == (0, "")
    assert found.stdout.split("\n")[:2] == ["(8, 8, 3)"] * 2


def test_a_fork_ends_by_itself_while_its_parent_draws():
    """It has none of its parent's threads to wait for."""
    code = """
        has_begun.wait()
        import os
        child = os.fork()
        if child == 0:
            import atexit, signal
            signal.alarm(60)
            atexit._run_exitfuncs()
            os._exit(5)  # Mesa's exit handler waits for the parent's threads
        assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 5
    """
    found = run(program(RENDER, code))
    assert (found.returncode, found.stderr) == (0, "")
