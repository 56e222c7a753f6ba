"""Light times a power of two gives the picture times that: no map is too bright or too dim for halves."""

import numpy as np
import pytest

import burnish
from burnish.environments import cube_directions
from engine_support import random_points, smooth_environment_faces

POWERS = (-40, -30, -20, -10, 10, 20, 30, 40)
FACE_SIZE = 32
SUN = np.float32([0.6, 0.64, 0.48])
# Halves and float32 keep all bits under powers of two; a GPU's sampler may round its weighted sums otherwise.
LIMIT = {True: 0.0, False: 2.0**-11}
SAMPLERS = {
    "regular": burnish.Regular(8),
    "published": burnish.Regular(8, footprint="published", normalization="published"),
    "importance": burnish.Importance(8),
    "matched": burnish.Matched(8),
    "prefiltered": burnish.Prefiltered(),
    "quadrature": burnish.Reference(0.05, "quadrature"),
    "progressive": burnish.Reference(0.05, "progressive", 2048),
}


def faces_of(sun):
    """Smooth light of about 1, a 4096th of that in one face, and a sun if one is asked for."""
    faces = smooth_environment_faces(FACE_SIZE)
    faces[3] *= 2.0**-12
    if sun:
        faces.reshape(-1, 3)[np.argmax(cube_directions(FACE_SIZE).reshape(-1, 3) @ SUN)] = sun
    return faces


def scaled(faces, power):
    return burnish.Environment.from_faces(np.ldexp(faces, power))


def scene_under(environment, power):
    brushed = burnish.KurtLobe(roughness=(0.3, 0.1), r0=0.2, alpha=0.5)
    material = burnish.Material(
        diffuse=(0.3, 0.2, 0.1),
        emissive=np.ldexp(np.float32([0.1, 0.0, 0.2]), power),
        lobes=[burnish.KurtLobe(roughness=0.15, weight=(0.9, 0.7, 0.3)), brushed],
    )
    scene = burnish.Scene.sphere(material)
    scene.environment = environment
    return scene


@pytest.fixture(scope="module", params=["software", "sampler"])
def lookup_device(request):
    return burnish.Device(lookup=request.param)


@pytest.fixture
def assert_scaled(lookup_device):
    is_exact = lookup_device.is_software or lookup_device.lookup == "software"

    def check(got, power, expected):
        assert expected.max() > 0
        np.testing.assert_allclose(
            np.ldexp(got, -power), expected, rtol=LIMIT[is_exact], err_msg=f"2^{power}"
        )

    return check


@pytest.mark.parametrize("sun", [0.0, 4e4], ids=["smooth", "with a sun"])
@pytest.mark.parametrize("sampler", SAMPLERS)
def test_pictures_scale_with_the_light(lookup_device, assert_scaled, sampler, sun):
    def picture(power):
        scene = scene_under(scaled(faces_of(sun), power), power)
        return burnish.render(scene, size=(16, 16), sampler=SAMPLERS[sampler], device=lookup_device)

    expected = picture(0)
    assert 0 < expected.alpha.mean() < 1, "both the sphere and the background are seen"
    for power in POWERS:
        frame = picture(power)
        assert_scaled(frame.color, power, expected.color)
        assert frame.report.warnings == expected.report.warnings


@pytest.mark.parametrize("sampler", SAMPLERS)
def test_points_scale_with_the_light(lookup_device, assert_scaled, rng, sampler):
    points = random_points(rng, 50)
    material = burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)])

    def radiance(power):
        environment = scaled(faces_of(0.0), power)
        return burnish.shade(environment, material, SAMPLERS[sampler], *points, device=lookup_device)

    expected = radiance(0)
    for power in POWERS:
        assert_scaled(radiance(power), power, expected)


def test_levels_scale_with_the_light(lookup_device, assert_scaled):
    plain = scaled(faces_of(0.0), 0)
    for power in POWERS:
        environment = scaled(faces_of(0.0), power)
        for got, expected in zip(
            environment.pyramid(device=lookup_device), plain.pyramid(device=lookup_device), strict=True
        ):
            assert_scaled(got, power, expected)
        for got, expected in zip(
            environment.prefiltered(device=lookup_device),
            plain.prefiltered(device=lookup_device),
            strict=True,
        ):
            assert got[0] == expected[0]
            assert_scaled(got[1], power, expected[1])


def test_captured_maps_scale_with_the_light(lookup_device, assert_scaled):
    def captured(power):
        scene = scene_under(scaled(faces_of(4e4), power), power)
        return scene.capture(point=(0, 2, 0), face_size=8, device=lookup_device).faces

    expected = captured(0)
    for power in POWERS:
        assert_scaled(captured(power), power, expected)


def test_exposure_and_the_light_make_up_for_each_other(lookup_device, assert_scaled):
    for power in (-30, 30):
        dim = scaled(faces_of(4e4), -power)
        dim.exposure = float(power)
        frames = [
            burnish.render(
                scene_under(environment, 0), size=(8, 8), sampler=burnish.Matched(5), device=lookup_device
            ).color
            for environment in (dim, scaled(faces_of(4e4), 0))
        ]
        assert_scaled(frames[0], 0, frames[1])


def test_display_of_dim_light_is_that_of_bright_light(lookup_device):
    pictures = [
        burnish.render(
            scene_under(scaled(faces_of(0.0), power), power),
            size=(8, 8),
            output="display",
            display_exposure=float(-power),
            device=lookup_device,
        ).display
        for power in (0, -30)
    ]
    np.testing.assert_array_equal(pictures[0], pictures[1])


def test_error_of_a_reference_weighs_each_map_by_its_light(device):
    """Variances of two objects under maps of their own add up; one 2^20 times dimmer adds nothing."""
    material = burnish.Material(lobes=[burnish.KurtLobe(roughness=0.3)])
    errors, light = [], None
    for powers in [(0, 0), (0, -20), (-20, 0)]:
        scene = burnish.Scene.spheres([material] * 2, columns=2)
        for one, power in zip(scene.objects, powers, strict=True):
            one.reflects = scaled(faces_of(4e4), power)
        scene.environment = scaled(faces_of(0.0), 0)
        reference = burnish.Reference(0.001, "progressive", 1024)
        frame = burnish.render(scene, size=(12, 24), sampler=reference, device=device)
        errors.append(frame.report.standard_error)
        luminance = np.where(frame.alpha > 0, frame.color @ [0.2126, 0.7152, 0.0722], 0.0)
        light = np.array([luminance[:, :12].sum(), luminance[:, 12:].sum()]) if light is None else light
    both, *alone = errors
    assert (both * light.sum()) ** 2 == pytest.approx(np.sum((alone * light) ** 2), rel=1e-4)


def test_what_halves_cannot_hold_is_said_with_the_light_that_is_lost(device):
    faces = np.full((6, 8, 8, 3), 1.3, np.float32)
    faces[:2] = 1e12  # no small disc: nothing that could be taken out
    environment = burnish.Environment.from_faces(faces)
    assert environment.half_range.faint_texels == 4 * 64
    assert environment.half_range.faint_sphere == pytest.approx(2 / 3)
    assert 0 < environment.half_range.lost_light < 1e-11
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.3)]))
    scene.environment = environment
    for sampler in (burnish.Regular(8), burnish.Matched(8)):
        frame = burnish.render(scene, size=(4, 4), sampler=sampler, device=device)
        (warning,) = frame.report.warnings
        assert "256 texels, 66.6667 % of the sphere" in warning and "of the light" in warning


@pytest.mark.parametrize("sun", [1e9, 1e15])
def test_a_sun_of_any_size_leaves_the_rest_of_the_map_as_it_is(device, rng, sun):
    """Matched takes it out: where the lobe does not see it, light is that of the map without it."""
    normals, tangents, views = random_points(rng, 200)
    mirrored = 2 * np.sum(normals * views, axis=-1, keepdims=True) * normals - views
    away = mirrored @ SUN < -0.2
    points = [np.ascontiguousarray(one[away]) for one in (normals, tangents, views)]
    material = burnish.Material(lobes=[burnish.KurtLobe(roughness=0.05)])
    faces = faces_of(sun)
    with_sun, without = (
        burnish.shade(scaled(one, 0), material, burnish.Matched(8), *points, device=device)
        for one in (faces, faces_of(0.0))
    )
    np.testing.assert_allclose(with_sun, without, rtol=2e-3)
