"""Hostile picture files: each loads or is refused in words, in a process of little memory and time."""

import subprocess
import sys
from pathlib import Path

import pytest

DATA = Path(__file__).resolve().parents[4] / "shared" / "data" / "bad-input"
FOLDERS = ("openexr", "openimageio", "image-rs")
FILES = sorted(p for folder in FOLDERS for p in (DATA / folder).rglob("*") if p.is_file())

# Files the index calls valid, and those whose faults lie outside the pixels.
LOADABLE = {
    "t05.exr",
    "BrightRings.exr",
    "BrightRingsNanInf.exr",
    "bad.exr",
    "old-rle.hdr",
    "scale.hdr",
    "test.jpg",
    "basn2c16.png",
    "corrupt-exif-1626.jpg",
    "corrupt-exif-recursive-ifd.jpg",
    "corrupt-icc-4551.jpg",
    "exif-utf8-type.png",
}

PROGRAM = """
import resource, sys
resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))
import numpy as np
from burnish import FileError
from burnish.images import read_image
for path in sys.argv[1:]:
    try:
        pixels = read_image(path)
        assert pixels.dtype == np.float32 and pixels.ndim == 3 and pixels.shape[2] in (3, 4)
        print("loaded")
    except FileError as error:
        assert str(error).startswith(path), error
        print("refused", str(error)[len(path):])
"""


@pytest.mark.skipif(not FILES, reason=f"needs the test files in {DATA}")
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name[-40:])
def test_a_hostile_picture_loads_or_is_refused_in_words(path):
    run = subprocess.run([sys.executable, "-c", PROGRAM, path], capture_output=True, text=True, timeout=60)
    assert run.returncode == 0, run.stderr
    if path.name in LOADABLE:
        assert run.stdout == "loaded\n"
    else:
        assert run.stdout.startswith("refused : "), run.stdout
        assert "expected" in run.stdout or "cannot be decoded" in run.stdout
