"""glTF's factors as diffuse and Kurt lobe: shader against oracle."""

import numpy as np
from probe import ULP, assert_close, probe

from burnish.oracle import metallic_roughness

COUNT = 3000


def factors(rng, *shape):
    """Numbers in [0, 1], both ends among them."""
    values = rng.uniform(0, 1, (COUNT, *shape))
    return np.where(rng.random(values.shape) < 0.2, np.round(values), values).astype(np.float32)


def test_slope_from_perceptual(device, rng):
    roughness = np.concatenate([factors(rng), np.array([0, 0.01, 0.0316, 0.0317, 1], np.float32)])
    actual = probe(device, "slope_from_perceptual", roughness)[:, 0, 0]
    expected = np.maximum(roughness.astype(float) ** 2, metallic_roughness.MIN_ROUGHNESS)
    assert_close("slope_from_perceptual", actual, expected, ULP * expected, roughness=roughness)


def test_map_metallic_roughness(device, rng):
    base, color = factors(rng, 3), factors(rng, 3)
    metallic, roughness, specular, anisotropy = (factors(rng) for _ in range(4))
    ior = rng.choice((1.0, 1.33, 1.5, 2.4, 100.0), COUNT)
    reflectance = ((ior - 1) / (ior + 1)) ** 2
    dielectric = (np.minimum(reflectance[:, None] * color, 1) * specular[:, None]).astype(np.float32)
    actual = probe(
        device, "map_metallic_roughness", base, dielectric, (metallic, roughness, specular, anisotropy)
    )
    expected = np.zeros((COUNT, 3, 4))
    for k in range(COUNT):
        source = metallic_roughness.MetallicRoughness(
            base_color=base[k],
            metallic=float(metallic[k]),
            roughness=float(roughness[k]),
            ior=float(ior[k]),
            specular=float(specular[k]),
            specular_color=color[k],
            anisotropy=float(anisotropy[k]),
        )
        mapped = metallic_roughness.map_metallic_roughness(source)
        expected[k, 0, :3] = mapped.diffuse
        for lobe in mapped.lobes:  # none where its weight is zero
            weight, r0 = np.asarray(lobe.weight), np.asarray(lobe.r0)
            expected[k, 1, :3], expected[k, 2, :3] = weight * r0, weight * (1 - r0)
        slope = max(float(roughness[k]) ** 2, metallic_roughness.MIN_ROUGHNESS)
        share = float(anisotropy[k]) ** 2
        expected[k, 0, 3], expected[k, 1, 3] = slope * (1 - share) + share, slope
    # Numbers in [0, 1], seven operations at most, and the dielectric's own rounding.
    assert_close(
        "map_metallic_roughness", actual, expected, 4 * ULP, base=base, dielectric=dielectric,
        metallic=metallic, roughness=roughness, specular=specular, anisotropy=anisotropy,
    )  # fmt: skip
    assert np.all(actual >= 0)


def test_a_rough_scale_never_maps_below_the_least_slope(device):
    actual = probe(device, "slope_from_perceptual", np.array([0, -0.0, 1e-30], np.float32))[:, 0, 0]
    np.testing.assert_array_equal(actual, np.float32(metallic_roughness.MIN_ROUGHNESS))
