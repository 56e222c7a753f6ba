"""Changed files load or raise FileError: a short run without clang, and every file that once broke a reader.

The search that is guided by coverage, and long, is scripts/fuzz.
"""

import base64
import json
import os
import random
import struct
import subprocess
import sys

import file_seeds
import pytest

import burnish
from burnish import FileError
from burnish.images import read_image
from picture_support import png_chunk

ADDRESS_BYTES = 4 << 30
CHANGES_PER_SEED = 20
# A reader that crashes takes its process with it: the changed files are read in one of their own.
READ_ALL = """
import os, resource, sys, warnings
resource.setrlimit(resource.RLIMIT_AS, 2 * (int(sys.argv[2]),))
os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # libraries print what they think of each file
import burnish
from burnish.images import read_image
warnings.simplefilter("ignore")
read = burnish.Scene.from_file if sys.argv[3] == "gltf" else read_image
for name in sorted(os.listdir(sys.argv[1])):
    path = os.path.join(sys.argv[1], name)
    print(name, end=" ", flush=True)
    try:
        read(path)
        print("loaded", flush=True)
    except burnish.FileError as error:
        assert str(error).startswith(path) and len(str(error)) > len(path) + 10, error
        print("refused", flush=True)
"""


def changed(content: bytes, random_numbers: random.Random) -> bytes:
    """Change a file as a fuzzer does: bytes, bits, lengths of blocks, its end."""
    data = bytearray(content)
    for _ in range(random_numbers.randint(1, 3)):
        at = random_numbers.randrange(len(data))
        match random_numbers.randrange(5):
            case 0:
                data[at] = random_numbers.randrange(256)
            case 1:
                data[at] ^= 1 << random_numbers.randrange(8)
            case 2:
                data[at : at + 4] = random_numbers.choice(
                    [b"\0\0\0\0", b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f"]
                )
            case 3:
                data[at:at] = data[random_numbers.randrange(len(data)) :][: random_numbers.randrange(1, 32)]
            case _:
                del data[at : at + random_numbers.randrange(1, 32)]
        if not data:
            return content
    return bytes(data)


@pytest.mark.parametrize("target", ["gltf", "hdr", "png", "jpeg", "exr"])
def test_changed_files_load_or_are_refused_in_words(target, tmp_path):
    random_numbers = random.Random(target)
    seeds, files = tmp_path / "seeds", tmp_path / "files"
    file_seeds.write_seeds(target, seeds)
    files.mkdir()
    originals = sorted(seeds.iterdir())
    for path in originals:
        (files / path.name).write_bytes(path.read_bytes())
        for number in range(CHANGES_PER_SEED if target != "gltf" else 10 * CHANGES_PER_SEED):
            (files / f"{path.name}-{number:03}").write_bytes(changed(path.read_bytes(), random_numbers))
    done = subprocess.run(
        [sys.executable, "-c", READ_ALL, str(files), str(ADDRESS_BYTES), target],
        capture_output=True,
        text=True,
        timeout=200,
        check=False,
    )
    results = dict(line.split() for line in done.stdout.splitlines() if " " in line.strip())
    assert done.returncode == 0, f"ended with {done.returncode} at {done.stdout.splitlines()[-1]}"
    assert len(results) == len(list(files.iterdir()))
    assert all(results[path.name] == "loaded" for path in originals), "every seed is a sound file"
    assert "refused" in results.values(), "some changes must break some files, or nothing is tried"


# What fuzzing found, least first.
BROKEN_SCENES = {
    "text that is not UTF-8": b"{\xff}",
    "a picture": file_seeds.png(2, 8, False, 2),
    "a value whose quotation is cut inside a letter": (
        '{"asset":{"version":"2.0"},"nodes":[{"mesh":"' + "x" + "\u00e9" * 40 + '"}]}'
    ).encode(),
}


@pytest.mark.parametrize("name", BROKEN_SCENES)
def test_a_message_that_quotes_bytes_is_not_empty(name, tmp_path):
    path = tmp_path / "scene.gltf"
    path.write_bytes(BROKEN_SCENES[name])
    with pytest.raises(FileError, match=r"scene\.gltf: \S+") as caught:
        burnish.Scene.from_file(path)
    assert str(caught.value).startswith(str(path))
    str(caught.value).encode()  # and it can be printed


def jpeg_without_tables() -> bytes:
    """A grey baseline JPEG of 8 x 8 whose scan names Huffman tables that it does not define."""

    def segment(code, content):
        return bytes([0xFF, code]) + (len(content) + 2).to_bytes(2, "big") + content

    quantization = segment(0xDB, b"\0" + bytes(range(1, 65)))
    frame = segment(0xC0, bytes([8, 0, 8, 0, 8, 1, 1, 0x11, 0]))
    scan = segment(0xDA, bytes([1, 1, 0x00, 0, 63, 0])) + bytes(range(1, 65))
    return b"\xff\xd8" + quantization + frame + scan + b"\xff\xd9"


def test_what_a_picture_becomes_does_not_depend_on_old_memory(tmp_path):
    uri = "data:image/jpeg;base64," + base64.b64encode(jpeg_without_tables()).decode()
    document = {
        "asset": {"version": "2.0"},
        "images": [{"uri": uri}],
        "textures": [{"source": 0}],
        "materials": [{"emissiveTexture": {"index": 0}}],
    }
    path = tmp_path / "scene.gltf"
    path.write_text(json.dumps(document))
    program = "import burnish, sys; scene = burnish.Scene.from_file(sys.argv[1]); print(scene.warnings)"
    said = {
        subprocess.run(
            [sys.executable, "-c", program, str(path)],
            capture_output=True,
            text=True,
            check=True,
            env=os.environ | {"MALLOC_PERTURB_": filling},  # new memory holds its complement
        ).stdout
        for filling in ("254", "17", "128")
    }
    assert len(said) == 1


def test_a_picture_of_another_kind_is_named(tmp_path):
    path = tmp_path / "picture.exr"
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(FileError, match="expected an OpenEXR, Radiance, PNG or JPEG picture, got ff fe"):
        read_image(path)


def test_a_png_too_short_for_its_size_is_refused(tmp_path):
    """A hundred bytes that declare 49 million pixels took minutes and gigabytes to become black."""
    small = file_seeds.png(0, 1, False)
    header = struct.pack(">IIBBBBB", 5, 9_764_869, 1, 0, 0, 0, 0)
    data = png_chunk(b"IHDR", header) + small[8 + 25 :]
    path = tmp_path / "picture.png"
    path.write_bytes(small[:8] + data)
    with pytest.raises(FileError, match=r"PNG: expected data for 5 x 9764869 pixels, got \d+ bytes"):
        read_image(path)
