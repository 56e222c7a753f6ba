"""Whole pictures against the ray caster of the oracle: colour, coverage, depth, normals.

The engine packs normals in 2 x 16 bits, 8e-5 off at most; under discs of 3000 that is most of what its
pictures differ by.
"""

import numpy as np
import pytest

import burnish
from burnish.oracle.render import render as oracle_render
from engine_support import HARDWARE_GRID, oracle_camera, oracle_objects
from image_compare import assert_pictures_match

SIZE = (96, 128)
# Of float32 vertices that round to other sides of a pixel's centre: pixels of the silhouette, one in fifty.
SILHOUETTE_SHARE = 0.02
# Hardware moves what it interpolates by a share of a pixel, and rounds the weights of its lookups: under
# discs of 3000 that is this much of a picture.
HARDWARE_RMSE = 1e-2
HARDWARE_RIM = 2e-2  # of a normal, where a triangle is thinner than a pixel
ROUND = burnish.KurtLobe(roughness=(0.1, 0.1))
BRUSHED = burnish.KurtLobe(roughness=(0.2, 0.075))
SYMMETRIC = burnish.Regular(normalization="published")


def silhouette(coverage):
    """Covered pixels that touch an uncovered one."""
    padded = np.pad(coverage, 1, constant_values=True)
    inner = padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
    return coverage & ~inner


def change_beside(values):
    """Largest change from each pixel to its four neighbours, of those that are covered; (h, w)."""
    padded = np.pad(values, ((1, 1), (1, 1), (0, 0)), constant_values=np.nan)
    beside = [padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]]
    change = np.stack([np.linalg.norm(np.nan_to_num(other - values), axis=-1) for other in beside])
    return change.max(axis=0)


def compare_frames(name, frame, expected, rmse, scale=1.0):
    """Colour where both agree on what is covered, and the rest of the frame; `scale`: size of the scene."""
    covered, wanted = frame.alpha > 0, expected.alpha > 0
    assert set(np.unique(frame.alpha)) <= {0.0, 1.0}
    moved = np.sum(covered != wanted)
    assert moved <= SILHOUETTE_SHARE * np.sum(silhouette(wanted)) + 1, f"{moved} pixels change coverage"
    both = covered & wanted
    assert both.sum() > 200
    # Meshes that overlap in the picture may swap at a pixel: those show in the depth and are few.
    grid = 0.0 if frame.report.device["is_software"] else HARDWARE_GRID
    shift = grid * change_beside(np.where(wanted, expected.depth, np.nan)[..., None])[both]
    off = np.abs(frame.depth[both] - expected.depth[both]) > 1e-4 * scale + shift
    assert off.sum() <= 0.002 * both.sum() + 1, f"{off.sum()} of {both.sum()} depths are off"
    same = both.copy()
    same[both] = ~off
    turned = np.linalg.norm(frame.normal[same] - expected.normal[same], axis=-1)
    # Rasterisers move vertices by up to 1/512 pixel: it shows at the rims of small triangles.
    shift = grid * change_beside(np.where(wanted[..., None], expected.normal, np.nan))[same]
    assert np.mean(turned > 2e-4 + shift) <= 1e-3, f"{np.sum(turned > 2e-4 + shift)} normals are off"
    assert turned.max() <= (HARDWARE_RIM if grid > 0 else 2e-3), f"a normal is off by {turned.max()}"
    rmse = max(rmse, HARDWARE_RMSE) if grid > 0 else rmse
    assert np.isinf(frame.depth[~covered]).all() and not frame.normal[~covered].any()
    assert_pictures_match(frame.color, expected.color, name, rmse, where=same | ~(covered | wanted))
    assert_pictures_match(frame.color, expected.color, name + " objects", rmse, where=same)
    assert frame.report.non_finite == 0


def both_ways(device, scene, sampler, camera=None, size=SIZE, **rest):
    camera = scene.default_camera() if camera is None else camera
    frame = burnish.render(scene, camera, size, sampler, device=device)
    environment = scene.environment
    if isinstance(sampler, burnish.Prefiltered):
        levels = [level for _, level in environment.prefiltered(device=device)]
    else:
        levels = environment.pyramid(device=device)
    expected = oracle_render(
        oracle_objects(scene),
        oracle_camera(camera),
        size,
        levels,
        sampler,
        environment.rotation,
        environment.exposure,
        scene.show_background,
        **rest,
    )
    return frame, expected


@pytest.mark.parametrize("lobe", [ROUND, BRUSHED], ids=["round", "brushed"])
@pytest.mark.parametrize(
    "sampler",
    [
        burnish.Regular(footprint="published", normalization="published"),
        burnish.Importance(),
        burnish.Prefiltered(),
    ],
    ids=["regular", "importance", "prefiltered"],
)
def test_picture_of_a_sphere_under_spots_equals_oracle(device, spots128, lobe, sampler, request):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[lobe]))
    scene.environment = spots128
    compare_frames(request.node.name, *both_ways(device, scene, sampler), rmse=1e-3)


@pytest.mark.parametrize("lobe", [ROUND, BRUSHED], ids=["round", "brushed"])
def test_reference_picture_of_a_sphere_equals_the_sum_over_all_texels(device, spots64, lobe, request):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[lobe]))
    scene.environment = spots64
    sampler = burnish.Reference(method="quadrature")
    frame, expected = both_ways(device, scene, sampler, size=(24, 32))
    assert_pictures_match(
        frame.color, expected.color, request.node.name, 5e-3, where=(frame.alpha > 0) & (expected.alpha > 0)
    )


def box(half=1.0):
    """Mesh of a cube with flat faces; every face has the tangent its texture would have."""
    positions, normals, indices = [], [], []
    for axis in range(3):
        for sign in (1, -1):
            normal = np.zeros(3)
            normal[axis] = sign
            u = np.roll(normal, 1)
            v = np.cross(normal, u)
            first = len(positions)
            positions += [half * (normal + a * u + b * v) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            normals += [normal] * 4
            indices += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
    return burnish.Mesh(np.float32(positions), np.uint32(indices), np.float32(normals))


def placed(scale, translation):
    matrix = np.diag([*np.broadcast_to(scale, 3), 1.0])
    matrix[:3, 3] = translation
    return matrix


def still_life(environment, double_sided=False):
    """Objects that overlap, one of them mirrored and stretched."""
    scene = burnish.Scene()
    satin = burnish.KurtLobe(roughness=0.3, r0=(0.9, 0.6, 0.3), alpha=0.5)
    scene.add(burnish.Mesh.sphere(), burnish.Material(lobes=[satin]), placed(0.8, (-1, 0.1, 0)), "ball")
    scene.add(
        burnish.Mesh.torus(),
        burnish.Material(diffuse=(0.6, 0.2, 0.1), lobes=[burnish.KurtLobe(roughness=(0.4, 0.15))]),
        placed((-0.7, 0.5, 1.1), (0.9, 0, 0.3)),
        "mirrored torus",
    )
    scene.add(box(), burnish.Material(emissive=(0.2, 1.0, 3.0)), placed(0.3, (0, 0.9, -0.4)), "lamp")
    scene.add(burnish.Mesh.plane(6.0), burnish.Material(diffuse=0.5), placed(1, (0, -0.7, 0)), "ground")
    scene.environment = environment
    return scene


@pytest.mark.parametrize("sampler", [SYMMETRIC, burnish.Importance()], ids=["symmetric", "importance"])
def test_picture_of_several_objects_equals_oracle(device, smooth64, sampler):
    """The pattern of `Importance` is not its own mirror image: it tells the mirrored object's frame."""
    camera = burnish.Camera.look_at((2.5, 2.0, 4.0), (0, 0, 0))
    frame, expected = both_ways(device, still_life(smooth64), sampler, camera)
    compare_frames("several objects", frame, expected, 1e-3, scale=6)


def test_orthographic_picture_equals_oracle(device, smooth64):
    camera = burnish.Camera.orthographic((2.5, 2.0, 4.0), (0, 0, 0), half_height=1.6, far_plane=20.0)
    frame, expected = both_ways(device, still_life(smooth64), SYMMETRIC, camera)
    # One ray direction: the background is one texel's colour everywhere.
    compare_frames("orthographic", frame, expected, 1e-3, scale=20)


def test_turned_and_exposed_environment_equals_oracle(device):
    from engine_support import smooth_environment_faces

    angle = 0.9
    rotation = [[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]
    environment = burnish.Environment.from_faces(smooth_environment_faces(64), 1.5, rotation)
    camera = burnish.Camera.look_at((2.5, 2.0, 4.0), (0, 0, 0))
    frame, expected = both_ways(device, still_life(environment), SYMMETRIC, camera)
    compare_frames("turned and exposed", frame, expected, 1e-3, scale=6)


@pytest.mark.parametrize("is_double_sided", [True, False])
def test_plane_from_behind_shows_only_if_double_sided(device, smooth64, is_double_sided):
    lobe = burnish.KurtLobe(roughness=(0.3, 0.1), rotation=0.6)
    material = burnish.Material(diffuse=(0.3, 0.6, 0.1), lobes=[lobe], double_sided=is_double_sided)
    scene = burnish.Scene.plane(material)
    scene.environment = smooth64
    camera = burnish.Camera.look_at((0.7, -2.5, 1.2), (0, 0, 0))
    frame, expected = both_ways(device, scene, burnish.Importance(), camera)
    if is_double_sided:
        compare_frames("from behind", frame, expected, 1e-3)
    else:
        assert not frame.alpha.any() and not expected.alpha.any()


def test_hidden_background_is_black_and_uncovered(device, smooth64):
    scene = still_life(smooth64)
    scene.show_background = False
    camera = burnish.Camera.look_at((2.5, 4.0, 6.0), (0, 0, 0))
    frame, expected = both_ways(device, scene, SYMMETRIC, camera)
    assert not frame.color[frame.alpha == 0].any()
    compare_frames("hidden background", frame, expected, 1e-3, scale=6)


@pytest.mark.parametrize("size", [(1, 1), (1, 9), (9, 1), (7, 13), (65, 33)])
def test_pictures_of_odd_sizes_equal_oracle(device, smooth64, size):
    scene = still_life(smooth64)
    camera = burnish.Camera.look_at((2.5, 2.0, 4.0), (0, 0, 0))
    frame, expected = both_ways(device, scene, SYMMETRIC, camera, size)
    assert frame.color.shape == (*size, 3)
    # A rasteriser moves vertices by up to 1/512 pixel, which is much where one pixel sees the whole scene.
    limit = 3e-2 if min(size) < 5 else 1e-3
    same = np.isclose(frame.depth, expected.depth, rtol=limit)
    assert np.sum(~same) <= 0.01 * same.size
    assert_pictures_match(frame.color, expected.color, f"size {size}", limit, where=same)
