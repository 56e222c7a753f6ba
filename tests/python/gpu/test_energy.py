"""Lobes that conserve energy in a constant environment: min(albedo, 1) comes back, by any sampler."""

import base64
import json

import numpy as np
import pytest

import burnish
from burnish.oracle.albedo import directional_albedo

SAMPLERS = {
    "furnace": burnish.Regular(samples=30),
    "projected": burnish.Regular(samples=600, threshold=0.001, normalization="projected"),
    "importance": burnish.Importance(samples=1000, points="fibonacci"),
    "quadrature": burnish.Reference(method="quadrature"),
    "progressive": burnish.Reference(method="progressive"),
}
# Furnace is exact but for its table; the others integrate to about a percent at grazing views.
TOLERANCE = {"furnace": 2e-3, "quadrature": 5e-3}


def _views(count: int) -> np.ndarray:
    cos_o = np.linspace(0.03, 1.0, count)  # from 1.7 degrees above the surface
    return np.stack([np.sqrt(1 - cos_o**2), np.zeros(count), cos_o], axis=-1)


def _shade(device, sampler, lobe):
    views = _views(40)
    normals = np.tile(np.float32([0, 0, 1]), (len(views), 1))
    tangents = np.tile(np.float32([1, 0, 0]), (len(views), 1))
    environment = burnish.Environment.from_faces(np.ones((6, 128, 128, 3), np.float32))
    material = burnish.Material(lobes=[lobe])
    views32 = np.float32(views)
    radiance = burnish.shade(environment, material, sampler, normals, tangents, views32, device=device)
    return radiance[:, 0], directional_albedo(views, lobe.roughness, lobe.alpha)[:, 0]


@pytest.mark.parametrize("sampler", SAMPLERS)
@pytest.mark.parametrize("roughness", [0.3, (0.6, 0.2)])
def test_conserving_lobe_returns_at_most_what_it_gets(device, sampler, roughness):
    lobe = burnish.KurtLobe(roughness=roughness, alpha=0.75, conserve_energy=True)
    radiance, albedo = _shade(device, SAMPLERS[sampler], lobe)
    assert albedo.max() > 1.5, "the case must gain energy without the correction"
    np.testing.assert_allclose(radiance, np.minimum(albedo, 1.0), rtol=TOLERANCE.get(sampler, 1.5e-2))


def test_published_lobe_is_left_as_it_is(device):
    radiance, albedo = _shade(device, SAMPLERS["furnace"], burnish.KurtLobe(roughness=0.3, alpha=0.75))
    np.testing.assert_allclose(radiance, albedo, rtol=2e-3)


def test_mapped_materials_conserve_energy(tmp_path):
    scene = burnish.Scene.from_file(_write_metal(tmp_path), "kurt")
    assert [lobe.conserve_energy for lobe in scene.materials[0].lobes] == [True]


def _write_metal(folder):
    corners = base64.b64encode(np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]).tobytes()).decode()
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"metallicFactor": 1.0, "roughnessFactor": 0.8}}],
        "buffers": [{"uri": f"data:application/octet-stream;base64,{corners}", "byteLength": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "type": "VEC3",
                "count": 3,
                "min": [0, 0, 0],
                "max": [1, 1, 0],
            }
        ],
    }
    path = folder / "metal.gltf"
    path.write_text(json.dumps(document))
    return path
