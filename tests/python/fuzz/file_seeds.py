"""Tiny files to start fuzzing from, all made here: one of every form that a reader knows."""

import base64
import io
import json
import struct
import zlib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import OpenEXR
from PIL import Image

import picture_support as made
from picture_support import png_chunk

SEED = 20140619


def _picture(size=4, channels=3, dtype=np.uint8):
    rng = np.random.default_rng(SEED)
    return rng.integers(0, np.iinfo(dtype).max, (size, size, channels), dtype)


def encoded(mode: str, format: str, size: int = 4, **options) -> bytes:
    """Encode a small picture of noise by Pillow."""
    stream = io.BytesIO()
    Image.fromarray(_picture(size)).convert(mode).save(stream, format, **options)
    return stream.getvalue()


def png(color_type: int, bits: int, interlaced: bool, size: int = 5) -> bytes:
    """Give a PNG of any colour type and depth, its rows filled with noise that is not filtered."""
    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[color_type]
    rng = np.random.default_rng(SEED)
    passes = made.ADAM7 if interlaced else [(0, 0, 1, 1)]
    rows = b""
    for x, y, dx, dy in passes:
        columns = len(range(x, size, dx))
        if columns:
            row_bytes = -(-columns * channels * bits // 8)
            for row in range(y, size, dy):
                rows += bytes([row % 5]) + rng.bytes(row_bytes)
    palette = png_chunk(b"PLTE", rng.bytes(3 * 2**bits)) if color_type == 3 else b""
    transparency = {0: b"\0\1", 2: b"\0\1\0\2\0\3", 3: b"\0\x80"}.get(color_type, b"")
    return (
        b"\x89PNG\r\n\x1a\n"
        + png_chunk(b"IHDR", struct.pack(">2I5B", size, size, bits, color_type, 0, 0, interlaced))
        + palette
        + (png_chunk(b"tRNS", transparency) if transparency else b"")
        + png_chunk(b"IDAT", zlib.compress(rows))
        + png_chunk(b"IEND", b"")
    )


def _profile() -> bytes:
    """An ICC profile of primaries that are not Rec. 709."""
    return made.icc_profile([(0.5, 0.25, 0.0), (0.3, 0.68, 0.05), (0.164, 0.07, 0.775)], 1.8)


def _exif() -> bytes:
    fields = Image.Exif()
    fields[0x0112] = 6
    return fields.tobytes()


def png_files() -> Iterator[bytes]:
    """Every colour type and depth of PNG, plain and interlaced; every chunk that is looked at."""
    for color_type, depths in {
        0: (1, 2, 4, 8, 16),
        2: (8, 16),
        3: (1, 2, 4, 8),
        4: (8, 16),
        6: (8, 16),
    }.items():
        for bits in depths:
            yield png(color_type, bits, False)
            yield png(color_type, bits, True)
    chunks = {
        b"gAMA": struct.pack(">I", 100000),
        b"cHRM": struct.pack(">8I", 31270, 32900, 70800, 29200, 17000, 79700, 13100, 4600),
        b"iCCP": b"name\0\0" + zlib.compress(_profile()),
        b"cICP": bytes([9, 13, 0, 1]),
        b"pHYs": struct.pack(">IIB", 1, 2, 0),
        b"eXIf": _exif()[6:],
    }
    for dtype in (np.uint8, np.uint16):
        picture = _picture(dtype=dtype)
        for chunk in chunks.items():
            yield made.png(picture, chunk)


def jpeg_files() -> Iterator[bytes]:
    """Baseline and progressive JPEG in grey, colour and four channels, restart marks, a profile and Exif."""
    for mode in ("L", "RGB", "CMYK"):
        for options in ({}, {"progressive": True}, {"subsampling": 0}, {"restart_marker_blocks": 1}):
            yield encoded(mode, "JPEG", 17, **options)
    yield encoded("RGB", "JPEG", 17, icc_profile=_profile(), exif=_exif())


def hdr_files() -> Iterator[bytes]:
    """Radiance pictures: flat, old and new runs, XYZE, every orientation, exposure, primaries, gamma."""
    rng = np.random.default_rng(SEED)
    pixels = rng.integers(2, 255, (2, 8, 4), np.uint8)
    new = b"".join(
        bytes([2, 2, 0, 8]) + b"".join(bytes([8]) + row[:, c].tobytes() for c in range(4)) for row in pixels
    )
    runs = b"".join(bytes([2, 2, 0, 8]) + bytes([128 + 8, c, 128 + 5, c, 3, 1, 2, 3]) * 2 for c in (1, 2))
    old = (pixels[0, 0].tobytes() + bytes([1, 1, 1, 7])) * 2
    head = b"#?RADIANCE\n"
    for variables in (
        b"",
        b"FORMAT=32-bit_rle_rgbe\n",
        b"EXPOSURE=2\nCOLORCORR=1 2 3\nFORMAT=32-bit_rle_xyze\n",
        b"PRIMARIES=.7 .29 .17 .79 .13 .05 .3127 .329\nGAMMA=2\nPIXASPECT=2\n",
    ):
        for body in (pixels.tobytes(), new, runs, old):
            yield head + variables + b"\n-Y 2 +X 8\n" + body
    for axes in (b"+Y 2 +X 8", b"-Y 2 -X 8", b"+X 2 -Y 8", b"-X 2 +Y 8"):
        yield head + b"\n" + axes + b"\n" + new


def exr_files(folder: Path) -> Iterator[bytes]:
    """OpenEXR: every compression, tiles, every sample type, windows, layers, envmap, colours, parts."""
    rng = np.random.default_rng(SEED)
    path = folder / "seed.exr"

    def written(header, channels) -> bytes:
        with OpenEXR.File({"type": OpenEXR.scanlineimage} | header, channels) as file:
            file.write(str(path))
        return path.read_bytes()

    half = rng.random((6, 12, 3)).astype(np.float16)
    for name in ("NO", "RLE", "ZIPS", "ZIP", "PIZ", "PXR24", "B44", "B44A", "DWAA", "DWAB"):
        compression = getattr(OpenEXR, f"{name}_COMPRESSION")
        yield written({"compression": compression}, {"RGB": half})
        tiles = OpenEXR.TileDescription()
        tiles.xSize = tiles.ySize = 8
        yield written(
            {"compression": compression, "type": OpenEXR.tiledimage, "tiles": tiles},
            {"RGB": half.astype(np.float32)},
        )
    plain = {"compression": OpenEXR.NO_COMPRESSION}
    yield written(plain, {"Y": rng.integers(0, 9, (2, 3)).astype(np.uint32)})
    yield written(
        plain, {"left.R": half[..., 0].copy(), "left.G": half[..., 1].copy(), "left.B": half[..., 2].copy()}
    )
    yield written(plain, {"RGBA": rng.random((2, 2, 4)).astype(np.float32)})
    window = np.array([2, 1], np.int32), np.array([9, 3], np.int32)
    yield written(plain | {"displayWindow": window}, {"RGB": half})
    yield written(plain | {"envmap": OpenEXR.ENVMAP_LATLONG}, {"RGB": half})
    yield written(plain | {"envmap": OpenEXR.ENVMAP_CUBE}, {"RGB": rng.random((12, 2, 3)).astype(np.float16)})
    colors = (0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767)
    yield written(plain | {"chromaticities": colors, "whiteLuminance": 100.0}, {"RGB": half})
    yield written(plain | {"colorInteropID": "lin_ap0_scene", "pixelAspectRatio": 2.0}, {"RGB": half})
    yield written(plain, {name: half[..., i].copy() for i, name in enumerate("XYZ")})
    planes = {name: half[..., i] for i, name in enumerate("RGB")}
    views = b"".join(struct.pack("<i", len(view)) + view for view in (b"left", b"right"))
    stereo = made.exr({**planes, **{f"right.{name}": plane for name, plane in planes.items()}}, plain)
    yield made.with_attribute(stereo, "multiView", "stringvector", views)
    yield made.exr_parts(({"name": "depth"}, {"Z": half[..., 0]}), ({"name": "rgb", "view": "left"}, planes))


def _gltf_document(binary: bytes, is_embedded: bool) -> dict:
    """A document that uses what the reader knows: strips, sparse data, pictures, extensions, cameras."""
    texture = {
        "index": 0,
        "texCoord": 0,
        "extensions": {"KHR_texture_transform": {"offset": [0.5, 0], "texCoord": 1}},
    }
    views = {"floats": (0, 144), "indices": (144, 12), "picture": (156, len(binary) - 156)}
    document = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_clearcoat", "KHR_mesh_quantization"],
        "buffers": [{"byteLength": len(binary)}],
        "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in views.values()],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
            {"bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 0, "byteOffset": 80, "componentType": 5126, "count": 4, "type": "VEC4"},
            {
                "componentType": 5126,
                "count": 4,
                "type": "VEC3",
                "sparse": {
                    "count": 2,
                    "indices": {"bufferView": 1, "componentType": 5123},
                    "values": {"bufferView": 0},
                },
            },
            {"bufferView": 0, "componentType": 5120, "normalized": True, "count": 4, "type": "VEC3"},
            {"componentType": 5121, "count": 4, "type": "VEC4"},
            {"bufferView": 0, "componentType": 5126, "count": 2, "type": "MAT4"},
        ],
        "images": [{"bufferView": 2, "mimeType": "image/png"}],
        "samplers": [{"magFilter": 9728, "minFilter": 9987, "wrapS": 33071, "wrapT": 33648}],
        "textures": [{"source": 0, "sampler": 0}],
        "materials": [
            {
                "name": "all",
                "pbrMetallicRoughness": {
                    "baseColorFactor": [1, 0.5, 0.25, 1],
                    "roughnessFactor": 0.25,
                    "baseColorTexture": texture,
                },
                "normalTexture": {"index": 0, "scale": 0.5},
                "emissiveFactor": [0, 0, 1],
                "alphaMode": "MASK",
                "extensions": {
                    "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatTexture": {"index": 0}},
                    "KHR_materials_anisotropy": {
                        "anisotropyStrength": 0.5,
                        "anisotropyTexture": {"index": 0},
                    },
                    "KHR_materials_specular": {"specularColorFactor": [1, 1, 0.5]},
                    "KHR_materials_ior": {"ior": 1.5},
                    "KHR_materials_emissive_strength": {"emissiveStrength": 5},
                },
            },
            {"extensions": {"KHR_materials_unlit": {}}},
        ],
        "meshes": [
            {
                "primitives": [
                    {
                        "attributes": {"POSITION": 0, "TEXCOORD_0": 2, "TEXCOORD_1": 2},
                        "indices": 1,
                        "material": 0,
                    },
                    {"attributes": {"POSITION": 4, "NORMAL": 5, "TANGENT": 3, "COLOR_0": 3}, "mode": 5},
                    {"attributes": {"POSITION": 0, "NORMAL": 0}, "mode": 6, "material": 1},
                ]
            },
            {"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 6, "WEIGHTS_0": 3}, "mode": 5}]},
        ],
        "skins": [{"joints": [1, 2]}, {"joints": [1, 2], "inverseBindMatrices": 7}],
        "cameras": [
            {"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 10}},
            {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 9}},
        ],
        "nodes": [
            {"children": [1, 2, 3], "scale": [1, -1, 2], "rotation": [0, 0, 0.6, 0.8], "mesh": 0},
            {"camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 4, 5, 1]},
            {
                "camera": 1,
                "translation": [1, 2, 3],
                "mesh": 0,
                "extensions": {
                    "EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0, "ROTATION": 3, "SCALE": 0}}
                },
            },
            {"mesh": 1, "skin": 0},
        ],
        "scenes": [{"nodes": [0]}],
        "scene": 0,
    }
    if is_embedded:
        document["buffers"][0]["uri"] = (
            "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
        )
    return document


def gltf_binary() -> bytes:
    """Give four vertices in several readings, six indices and a PNG."""
    floats = np.arange(36, dtype=np.float32) * 0.25 - 2.0
    indices = np.array([0, 1, 2, 2, 1, 3], np.uint16)
    return floats.tobytes() + indices.tobytes() + png(2, 8, False, 2)


def glb(document: dict, binary: bytes) -> bytes:
    """Pack a document and its bytes into the binary form."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    chunks = (
        struct.pack("<2I", len(text), 0x4E4F534A)
        + text
        + struct.pack("<2I", len(binary), 0x004E4942)
        + binary
    )
    return b"glTF" + struct.pack("<2I", 2, 12 + len(chunks)) + chunks


def gltf_files() -> Iterator[bytes]:
    """One scene that uses all that is read, as text and as binary, and the least one."""
    binary = gltf_binary()
    yield json.dumps(_gltf_document(binary, True)).encode()
    yield glb(_gltf_document(binary, False), binary)
    yield b'{"asset":{"version":"2.0"}}'


def write_seeds(target: str, folder: Path) -> int:
    """Write the seeds of a target into a folder; give their number."""
    folder.mkdir(parents=True, exist_ok=True)
    sources = {"gltf": gltf_files, "hdr": hdr_files, "png": png_files, "jpeg": jpeg_files}
    if target == "exr":
        files = list(exr_files(folder))
        (folder / "seed.exr").unlink()
    elif target == "pillow":
        files = [*png_files(), *jpeg_files()]
    else:
        files = list(sources[target]())
    for number, content in enumerate(files):
        (folder / f"seed-{number:02}").write_bytes(content)
    return len(files)
