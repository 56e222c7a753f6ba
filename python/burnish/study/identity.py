"""What scenes, materials and environments are called, and digests that tell them apart in every process."""

import hashlib
import json
from collections.abc import Sequence
from typing import Any

import numpy as np

from burnish import _core
from burnish.lobes import describe_lobe, make_lobe, name_lobe


def describe_material(material: _core.Material) -> dict[str, Any]:
    """Give a material's parameters in a form that JSON can hold; textures are not in it."""
    return {
        "diffuse": list(material.diffuse),
        "lobes": [describe_lobe(lobe) for lobe in material.lobes],
        "emissive": list(material.emissive),
        "name": material.name,
        "double_sided": material.double_sided,
    }


def make_material(description: dict[str, Any]) -> _core.Material:
    """Make the material that `describe_material` described.

    Parameters
    ----------
    description : dict
        Constructor arguments of a `Material`, its lobes as dicts of theirs.
    """
    lobes = [make_lobe(lobe) for lobe in description["lobes"]]
    return _core.Material(**description | {"lobes": lobes})


def material_label(material: _core.Material) -> str:
    """Name a material in few words: its own name, or slopes and what is unusual.

    Such as ``m 0.2/0.075``, ``m 0.05, r0 0.04, alpha 0.5``, ``diffuse``.
    """
    if material.name:
        return material.name
    parts = ["diffuse"] if any(material.diffuse) else []
    parts += [name_lobe(lobe) for lobe in material.lobes]
    return " + ".join(parts) or "black"


def materials_label(materials: Sequence[_core.Material]) -> str:
    """Name a scene's materials: the one, or how many."""
    return material_label(materials[0]) if len(materials) == 1 else f"{len(materials)} materials"


def environment_label(environment: _core.Environment | None) -> str:
    """Name an environment and the size of its faces."""
    if environment is None:
        return "none"
    return f"{environment.name or 'environment'} ({environment.face_size})"


def describe_environment(environment: _core.Environment | None) -> list[Any]:
    """Give everything of an environment that the picture depends on."""
    if environment is None:
        return []
    return [environment.faces, environment.rotation, environment.exposure]


def describe_camera(camera: _core.Camera | None) -> list[Any]:
    """Give everything of a camera that the picture depends on."""
    if camera is None:
        return []
    projection = [camera.vertical_fov, camera.half_height, camera.near_plane, camera.is_orthographic]
    return [camera.world_from_camera, projection]


def describe_scene(scene: _core.Scene) -> list[Any]:
    """Give everything of a scene that the picture depends on, except the texels of its textures."""
    meshes = [[mesh.positions, mesh.normals, mesh.indices, mesh.uv0] for mesh in scene.meshes]
    materials = [describe_material(material) for material in scene.materials]
    objects = [
        [one.mesh, one.material, one.world_from_object, describe_environment(one.reflects)]
        for one in scene.objects
    ]
    return [
        scene.name,
        meshes,
        materials,
        objects,
        describe_environment(scene.environment),
        scene.image_count,
    ]


def digest(*values: Any) -> str:
    """Digest nested lists of numbers, texts, dicts and arrays into 16 hexadecimal digits."""
    state = hashlib.sha256()

    def add(value: Any) -> None:
        if isinstance(value, np.ndarray):
            state.update(f"array{value.shape}{value.dtype}".encode())
            state.update(np.ascontiguousarray(value).tobytes())
        elif isinstance(value, list | tuple):
            state.update(f"list{len(value)}".encode())
            for one in value:
                add(one)
        else:
            state.update(json.dumps(value, sort_keys=True).encode() + b";")

    add(values)
    return state.hexdigest()[:16]
