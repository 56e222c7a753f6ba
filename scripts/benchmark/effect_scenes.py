"""Scenes of the benchmark: each effect absent, present but zero, and present."""

import base64
import io
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from PIL import Image

from burnish import Environment, GgxLobe, KurtLobe, Material, Mesh, PointLight, Scene

Row = tuple[str, tuple[str, ...], tuple[Scene, Scene, Scene], tuple[int, int, int]]
# As good as nothing in any pixel, yet not nothing to the plan.
TRACE = 1e-6


def _sphere(environment: Environment, material: Material) -> Scene:
    scene = Scene.sphere(material)
    scene.environment = environment
    return scene


def _lobes(environment: Environment, *lobes: KurtLobe | GgxLobe, **fields: object) -> Scene:
    return _sphere(environment, Material(lobes=list(lobes), **fields))


def _lit(environment: Environment, lobe: KurtLobe, lights: list[PointLight]) -> Scene:
    scene = _lobes(environment, lobe, diffuse=0.5)
    scene.lights = lights
    return scene


def _data_uri(mime: str, data: bytes) -> str:
    return f"data:{mime};base64,{base64.b64encode(data).decode()}"


def _png(pixels: np.ndarray) -> str:
    buffer = io.BytesIO()
    Image.fromarray(pixels.astype(np.uint8)).save(buffer, "PNG")
    return _data_uri("image/png", buffer.getvalue())


def textured_sphere(
    path: Path, textures: dict[str, np.ndarray], has_colors: bool = False, **fields: object
) -> Path:
    """Write the unit sphere as glTF with 8-bit textures by their slots' names; fields of its material.

    Textures of a clear coat make one.
    """
    mesh = Mesh.sphere()
    arrays = {
        "POSITION": (mesh.positions, "VEC3"),
        "NORMAL": (mesh.normals, "VEC3"),
        "TANGENT": (mesh.tangents, "VEC4"),
        "TEXCOORD_0": (mesh.uv0, "VEC2"),
    }
    if has_colors:
        arrays["COLOR_0"] = (np.ones((len(mesh.positions), 3), np.float32), "VEC3")
    blobs, views, accessors, attributes = b"", [], [], {}
    for name, (array, kind) in [*arrays.items(), ("", (mesh.indices.reshape(-1), "SCALAR"))]:
        data = np.ascontiguousarray(array).tobytes()
        views.append({"buffer": 0, "byteOffset": len(blobs), "byteLength": len(data)})
        accessor = {"bufferView": len(views) - 1, "componentType": 5126 if name else 5125, "type": kind}
        accessor["count"] = len(array) if name else array.size
        if name == "POSITION":
            accessor |= {"min": array.min(0).tolist(), "max": array.max(0).tolist()}
        accessors.append(accessor)
        blobs += data
        if name:
            attributes[name] = len(accessors) - 1
    slots = {name: {"index": k} for k, name in enumerate(textures)}
    material: dict = {"pbrMetallicRoughness": {"roughnessFactor": 0.45, "metallicFactor": 1.0}}
    coat: dict = {"clearcoatFactor": 1.0, "clearcoatRoughnessFactor": 0.3}
    for name, slot in slots.items():
        is_base = "Color" in name or "metallic" in name
        home = coat if "clearcoat" in name else material["pbrMetallicRoughness"] if is_base else material
        home[name] = slot
    if any("clearcoat" in name for name in slots):
        material["extensions"] = {"KHR_materials_clearcoat": coat}
    if "emissiveTexture" in slots:
        material["emissiveFactor"] = [1, 1, 1]
    material |= fields
    document = {
        "asset": {"version": "2.0"},
        "extensionsUsed": list(material.get("extensions", {})),
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [
            {"primitives": [{"attributes": attributes, "indices": len(accessors) - 1, "material": 0}]}
        ],
        "materials": [material],
        "images": [{"uri": _png(pixels)} for pixels in textures.values()],
        "textures": [{"source": k} for k in range(len(textures))],
        "buffers": [{"uri": _data_uri("application/octet-stream", blobs), "byteLength": len(blobs)}],
        "bufferViews": views,
        "accessors": accessors,
    }
    if not textures:
        for key in ("images", "textures"):
            del document[key]
    path.write_text(json.dumps(document))
    return path


def _texture_rows(folder: Path, environment: Environment) -> Iterator[Row]:
    noise = np.random.default_rng(1).integers(100, 255, (256, 256, 3))
    flat = np.full((256, 256, 3), (128, 128, 255))
    bumps = np.clip(flat + np.random.default_rng(2).integers(-20, 20, flat.shape), 0, 255)
    kinds = {
        "baseColorTexture": (np.full((256, 256, 3), 255), noise),
        "metallicRoughnessTexture": (np.full((256, 256, 3), 255), noise),
        "normalTexture": (flat, bumps),
        "occlusionTexture": (np.full((256, 256, 3), 255), noise),
        "emissiveTexture": (np.zeros((256, 256, 3)), noise),
    }

    def load(name: str, textures: dict[str, np.ndarray]) -> Scene:
        scene = Scene.from_file(textured_sphere(folder / f"{name}.gltf", textures))
        scene.environment = environment
        return scene

    absent = load("plain", {})
    for kind, (zero, present) in kinds.items():
        scenes = (absent, load("zero", {kind: zero}), load("present", {kind: present}))
        yield kind.removesuffix("Texture") + " texture", ("surface", "shade"), scenes, (1, 1, 1)
    weight = {"clearcoatTexture": np.full((256, 256, 3), 255)}
    coats = (
        load("coat", weight),
        load("zero", weight | {"clearcoatNormalTexture": flat}),
        load("present", weight | {"clearcoatNormalTexture": bumps}),
    )
    yield "clear coat normal", ("surface", "shade"), coats, (1, 1, 1)


def _mask_and_unlit_rows(folder: Path, environment: Environment) -> Iterator[Row]:
    noise = np.random.default_rng(3).integers(0, 255, (256, 256, 4))
    solid = np.concatenate([noise[..., :3], np.full((256, 256, 1), 255)], axis=-1)
    mask, unlit = {"alphaMode": "MASK"}, {"extensions": {"KHR_materials_unlit": {}}}

    def load(name: str, texels: np.ndarray | None, has_colors: bool = False, **fields: object) -> Scene:
        textures = {} if texels is None else {"baseColorTexture": texels}
        scene = Scene.from_file(textured_sphere(folder / f"{name}.gltf", textures, has_colors, **fields))
        scene.environment = environment
        return scene

    scenes = (load("opaque", noise), load("solid", solid, **mask), load("mask", noise, **mask))
    yield "alpha mask", ("surface", "shade"), scenes, (1, 1, 1)
    scenes = (load("lit", None, True), load("unlit", None, False, **unlit), load("both", None, True, **unlit))
    yield "unlit, with vertex colours", ("surface", "shade"), scenes, (1, 1, 1)


def effect_scenes(folder: Path, environment: Environment) -> Iterator[Row]:
    """Name, the numbers to show, the three scenes and their spp."""
    plain = _lobes(environment, KurtLobe(0.1))
    lobe = KurtLobe(0.1)
    once = (1, 1, 1)
    rows: dict[str, tuple[Scene, Scene]] = {
        # A model has no zero: the lobe that it stands in for comes twice.
        "GGX in Kurt's place": (plain, _lobes(environment, GgxLobe(0.1))),
        "fresnel": (
            _lobes(environment, KurtLobe(0.1, r0=1 - TRACE)),
            _lobes(environment, KurtLobe(0.1, r0=0.04)),
        ),
        "alpha .5": (
            _lobes(environment, KurtLobe(0.1, alpha=TRACE)),
            _lobes(environment, KurtLobe(0.1, alpha=0.5)),
        ),
        "alpha .3": (
            _lobes(environment, KurtLobe(0.1, alpha=TRACE)),
            _lobes(environment, KurtLobe(0.1, alpha=0.3)),
        ),
        "anisotropy": (
            _lobes(environment, KurtLobe((0.1, 0.1 + TRACE))),
            _lobes(environment, KurtLobe((0.1, 0.05))),
        ),
        "lobe 2": (
            _lobes(environment, lobe, KurtLobe(0.1, weight=0.0)),
            _lobes(environment, lobe, KurtLobe(0.3, weight=0.2)),
        ),
        "diffuse": (_lobes(environment, lobe, diffuse=TRACE), _lobes(environment, lobe, diffuse=0.5)),
        "emissive": (_lobes(environment, lobe, emissive=TRACE), _lobes(environment, lobe, emissive=0.5)),
    }
    for name, (zero, present) in rows.items():
        yield name, ("shade",), (plain, zero, present), once
    # Beside a diffuse part that is not covered.
    layers = [_lobes(environment, lobe, diffuse=d, layered=k > 0) for k, d in enumerate((0.5, TRACE, 0.5))]
    yield "layers", ("shade",), (layers[0], layers[1], layers[2]), once
    # Beside a light that reaches nothing: tiles are sorted, and that is all.
    lights = ([], [PointLight((0, 99, 0), range=1)], [PointLight((3, 3, 3), 20, radius=0.3)])
    yield "light", ("shade",), tuple(_lit(environment, KurtLobe(0.1), some) for some in lights), once
    yield "accumulation", ("wall",), (plain, plain, plain), (1, 2, 4)
    yield from _texture_rows(folder, environment)
    yield from _mask_and_unlit_rows(folder, environment)
