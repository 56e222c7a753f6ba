"""Hostile glTF and picture files: each in its own process, with little memory and time."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

BAD_INPUT = Path(__file__).parents[3].parent / "shared" / "data" / "bad-input"
FOLDERS = ["assimp", "gltf-validator", "tinygltf"]
MAX_RSS_BYTES = 2 << 30
MAX_ADDRESS_BYTES = 4 << 30
SECONDS = 30

SCENES = sorted(
    path for folder in FOLDERS for path in (BAD_INPUT / folder).rglob("*") if path.suffix in (".gltf", ".glb")
)
PICTURES = sorted(path for path in BAD_INPUT.rglob("*") if path.suffix in (".png", ".jpg", ".jpeg"))

# Without errors for the validator, yet refused: the file asks for more than this reader has.
REFUSED_THOUGH_VALID = {
    "non_relative_uri.gltf": "another scheme",
    "min_version_valid.gltf": "asset.minVersion: expected at most 2.0",
}

LOAD = """
import json, re, resource, sys
resource.setrlimit(resource.RLIMIT_AS, 2 * (int(sys.argv[2]),))
import burnish
try:
    scene = burnish.Scene.from_file(sys.argv[1])
    result = {"loaded": True, "warnings": scene.warnings, "images": scene.image_count}
except burnish.FileError as error:
    result = {"loaded": False, "error": str(error)}
# ru_maxrss would still know the size of the process that started this one.
result["rss"] = 1024 * int(re.search(r"VmHWM:\\s*(\\d+) kB", open("/proc/self/status").read())[1])
print(json.dumps(result))
"""

pytestmark = pytest.mark.skipif(not BAD_INPUT.is_dir(), reason=f"{BAD_INPUT} is absent")


def load_apart(path: Path) -> dict:
    done = subprocess.run(
        [sys.executable, "-c", LOAD, str(path), str(MAX_ADDRESS_BYTES)],
        capture_output=True,
        text=True,
        timeout=SECONDS,
        check=False,
    )
    assert done.returncode == 0, f"{path} ended with {done.returncode}:\n{done.stderr}"
    result = json.loads(done.stdout.splitlines()[-1])
    assert result["rss"] < MAX_RSS_BYTES, f"{path} took {result['rss'] / 2**30:.1f} GiB"
    return result


def name_of(path: Path) -> str:
    return str(path.relative_to(BAD_INPUT))


@pytest.mark.parametrize("path", SCENES, ids=name_of)
def test_bad_gltf_loads_or_says_why(path):
    result = load_apart(path)
    report = path.with_name(path.name + ".report.json")
    is_valid = report.is_file() and json.loads(report.read_text())["issues"]["numErrors"] == 0
    if result["loaded"]:
        return
    reason = result["error"]
    assert reason.startswith(str(path)), "the path comes first"
    assert len(reason) > len(str(path)) + 10
    if is_valid:
        assert REFUSED_THOUGH_VALID[path.name] in reason


@pytest.mark.parametrize("path", PICTURES, ids=name_of)
def test_bad_picture_is_read_or_named(path, tmp_path):
    shutil.copy(path, tmp_path)  # a link out of the scene's folder would be refused
    document = {
        "asset": {"version": "2.0"},
        "images": [{"uri": path.name}],
        "textures": [{"source": 0}],
        "materials": [{"emissiveTexture": {"index": 0}}],
    }
    scene = tmp_path / "scene.gltf"
    scene.write_text(json.dumps(document))
    result = load_apart(scene)
    assert result["loaded"]
    assert result["images"] == 1 or any(path.name in sentence for sentence in result["warnings"])


BOTH_DOORS = """
import resource, sys
from pathlib import Path
resource.setrlimit(resource.RLIMIT_AS, 2 * (int(sys.argv[2]),))
import burnish
from burnish.images import read_image
for path in sorted(p for p in Path(sys.argv[1]).rglob("*") if p.is_file()):
    for read in (burnish.Scene.from_file, read_image):
        try:
            read(path)
        except burnish.FileError as error:
            assert str(error).startswith(str(path)), error
        print(path, flush=True)
"""


def test_every_file_passes_through_both_doors():
    """Scenes, pictures and what lies beside them, each read as a scene and as a picture."""
    done = subprocess.run(
        [sys.executable, "-c", BOTH_DOORS, str(BAD_INPUT), str(MAX_ADDRESS_BYTES)],
        capture_output=True,
        text=True,
        timeout=10 * SECONDS,
        check=False,
    )
    read = done.stdout.splitlines()
    assert done.returncode == 0, f"after {read[-1:]}: {done.stderr[-2000:]}"
    assert len(read) == 2 * sum(path.is_file() for path in BAD_INPUT.rglob("*"))


def test_bad_input_is_found():
    assert len(SCENES) > 120
    assert len(PICTURES) >= 10


@pytest.mark.parametrize(
    "name", ["IndexOutOfRange", "RecursiveNodes", "BoxWithInfinites", "badUint", "MissingBin"]
)
def test_bad_gltf_is_refused(name):
    (path,) = (path for path in SCENES if name in str(path))
    assert not load_apart(path)["loaded"]
