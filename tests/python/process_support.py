"""Programs that tests run in a Python of their own."""

import os
import subprocess
import sys
import textwrap


def start(code, *arguments, **environment):
    return subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(code), *arguments],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path), "BURNISH_VALIDATION": "0"} | environment,
    )


def finish(process):
    out, err = process.communicate(timeout=240)
    assert process.returncode == 0, f"exit {process.returncode}: {err[-2000:]}"
    return out.split()[-1]
