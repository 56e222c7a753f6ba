import numpy as np
import pytest

from burnish.oracle.arrays import normalize
from burnish.oracle.cube_map import sample_cube, texel_directions
from burnish.oracle.estimator import Regular
from burnish.oracle.lobe.kurt import KurtLobe
from burnish.oracle.metallic_roughness import Material
from burnish.oracle.pyramid import build_pyramid
from burnish.oracle.raster import Camera, Object, camera_rays, cast_rays, gather_triangles, interpolate
from burnish.oracle.render import capture, render
from burnish.oracle.shading import shade

WHITE = Material((1, 1, 1))


def cube_mesh():
    """A cube of half edge 1: 24 vertices, 12 triangles, counter-clockwise from outside."""
    positions, normals, indices = [], [], []
    for axis in range(3):
        for sign in (-1, 1):
            n = np.zeros(3)
            n[axis] = sign
            u = np.roll(np.abs(n), 1)
            v = np.cross(n, u)
            base = len(positions)
            positions += [n - u - v, n + u - v, n + u + v, n - u + v]
            normals += [n] * 4
            indices += [base, base + 1, base + 2, base, base + 2, base + 3]
    return np.array(positions), np.array(normals), np.array(indices)


def sphere_mesh(segments):
    theta, phi = np.meshgrid(
        np.linspace(0, np.pi, segments + 1), np.linspace(0, 2 * np.pi, 2 * segments + 1), indexing="ij"
    )
    p = np.stack([np.sin(theta) * np.cos(phi), np.cos(theta), -np.sin(theta) * np.sin(phi)], axis=-1).reshape(
        -1, 3
    )
    a = (np.arange(segments)[:, None] * (2 * segments + 1) + np.arange(2 * segments)).ravel()
    b = a + 2 * segments + 1
    return p, np.stack([a, b, b + 1, a, b + 1, a + 1], axis=-1)


def placed(matrix3=None, offset=(0, 0, 0)):
    matrix = np.eye(4)
    matrix[:3, :3] = np.eye(3) if matrix3 is None else matrix3
    matrix[:3, 3] = offset
    return matrix


def cube_object(matrix=None, material=WHITE):
    positions, normals, indices = cube_mesh()
    return Object(positions, normals, indices, material, world_from_object=matrix)


@pytest.fixture
def sky():
    d = texel_directions(16)
    return build_pyramid(1 + 0.5 * d + 0.2 * d[..., ::-1] ** 2, "gauss6")


def cube_entry(origins, directions):
    """Where rays enter the cube of half edge 1, by slabs."""
    with np.errstate(divide="ignore"):
        near = (-np.sign(directions) - origins) / directions
        far = (np.sign(directions) - origins) / directions
    enter, leave = near.max(axis=-1), far.min(axis=-1)
    return np.where((enter < leave) & (enter > 0), enter, np.inf)


def test_rays_meet_a_cube_where_its_slabs_say(rng):
    origins = 4 * normalize(rng.normal(size=(2000, 3)))
    directions = rng.uniform(-1.5, 1.5, (2000, 3)) - origins
    hits = cast_rays(gather_triangles([cube_object()]), origins, directions)
    expected = cube_entry(origins, directions)
    np.testing.assert_allclose(hits.depth, expected, rtol=1e-9)
    met = np.isfinite(expected)
    assert 500 < met.sum() < 2000
    triangles = gather_triangles([cube_object()])
    points = interpolate(triangles.corners, hits)[met]
    np.testing.assert_allclose(points, (origins + expected[:, None].clip(0, 9) * directions)[met], atol=1e-9)
    np.testing.assert_allclose(np.abs(points).max(axis=-1), 1, atol=1e-9)


def test_boxes_lose_no_triangle(rng):
    positions, indices = sphere_mesh(24)
    scene = gather_triangles([Object(positions, positions, indices, WHITE)])
    origins = 3 * normalize(rng.normal(size=(300, 3)))
    directions = normalize(rng.uniform(-1, 1, (300, 3)) - origins)
    hits = cast_rays(scene, origins, directions)
    # A polyhedron inside the unit sphere: hits lie between its flattest and its farthest points.
    met = hits.triangle >= 0
    radius = np.linalg.norm(origins + np.where(met, hits.depth, 0)[:, None] * directions, axis=-1)[met]
    assert np.all((radius <= 1 + 1e-12) & (radius > np.cos(np.pi / 24) ** 2))
    # Every ray that passes well inside meets it, none that passes outside does.
    closest = np.linalg.norm(np.cross(origins, directions), axis=-1)
    assert np.all(met[closest < 0.98]) and not np.any(met[closest > 1])


def test_triangles_are_invisible_from_behind_unless_double_sided():
    positions, normals = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]]), np.array([[0, 0, 1]] * 3)
    origins, directions = np.array([[0, 0, 2.0], [0, 0, -2.0]]), np.array([[0, 0, -1.0], [0, 0, 1.0]])
    one = cast_rays(gather_triangles([Object(positions, normals, [0, 1, 2], WHITE)]), origins, directions)
    both = Material((1, 1, 1), double_sided=True)
    two = cast_rays(gather_triangles([Object(positions, normals, [0, 1, 2], both)]), origins, directions)
    assert list(one.depth) == [2, np.inf] and list(two.depth) == [2, 2]


@pytest.mark.parametrize("scale", [(1, 1, 1), (-1, 1, 1), (2, 0.5, 1), (-1, -2, -0.5)])
def test_normals_point_outward_under_any_matrix(scale, rng):
    matrix3 = np.linalg.qr(rng.normal(size=(3, 3)))[0] @ np.diag(scale)
    scene = gather_triangles([cube_object(placed(matrix3, (1, 2, 3)))])
    face = normalize(
        np.cross(scene.corners[:, 1] - scene.corners[:, 0], scene.corners[:, 2] - scene.corners[:, 0])
    )
    outward = scene.corners.mean(axis=1) - [1, 2, 3]
    assert np.all(np.sum(face * outward, axis=-1) > 0)
    np.testing.assert_allclose(scene.normals, np.repeat(face[:, None], 3, axis=1), atol=1e-12)


def test_pinhole_rays_pass_pixel_centres():
    origins, directions = camera_rays(Camera(placed(offset=(1, 2, 3)), vertical_fov=np.pi / 2), (2, 4))
    np.testing.assert_array_equal(origins, np.broadcast_to([1, 2, 3], (2, 4, 3)))
    np.testing.assert_allclose(directions[0, 0], [-1.5, 0.5, -1])
    np.testing.assert_allclose(directions[1, 3], [1.5, -0.5, -1])


def test_orthographic_rays_are_parallel():
    camera = Camera(placed(), is_orthographic=True, half_height=3.0)
    origins, directions = camera_rays(camera, (2, 2))
    np.testing.assert_allclose(origins[0, 1], [1.5, 1.5, 0])
    np.testing.assert_allclose(directions, np.broadcast_to([0, 0, -1], (2, 2, 3)))


def test_sphere_covers_its_disc(sky):
    positions, indices = sphere_mesh(64)
    camera = Camera(placed(offset=(0, 0, 4)), is_orthographic=True, half_height=2.0)
    picture = render([Object(positions, positions, indices, WHITE)], camera, (100, 100), sky, Regular())
    assert picture.alpha.mean() == pytest.approx(np.pi / 16, rel=0.01)
    assert picture.depth.min() == pytest.approx(3, abs=1e-3)
    seen = picture.alpha > 0
    np.testing.assert_allclose(np.linalg.norm(picture.normal[seen], axis=-1), 1, rtol=1e-12)
    assert np.all(np.isinf(picture.depth[~seen])) and np.all(picture.normal[~seen] == 0)
    # Along the axis every pixel of the background looks at -z.
    np.testing.assert_allclose(
        picture.color[~seen], np.broadcast_to(sample_cube(sky, [0, 0, -1]), (np.sum(~seen), 3))
    )


def test_picture_is_shaded_as_its_points_are(sky):
    material = Material((0.2, 0.1, 0.3), [KurtLobe((0.3, 0.1), 0.5, 0.5)], emissive=(0, 0.5, 0))
    positions, indices = sphere_mesh(32)
    tangents = np.concatenate([np.cross([0, 1, 0], positions), np.ones((len(positions), 1))], axis=1)
    item = Object(positions, positions, indices, material, tangents)
    camera = Camera(placed(offset=(0, 0, 4)))
    picture = render([item], camera, (16, 16), sky, Regular(14))
    at = (6, 9)
    n = picture.normal[at]
    direction = normalize(camera_rays(camera, (16, 16))[1][at])
    scene = gather_triangles([item])
    hits = cast_rays(scene, np.array([[0, 0, 4.0]]), direction[None])
    expected = shade(sky, material, Regular(14), n, interpolate(scene.tangents, hits)[0], -direction)
    np.testing.assert_allclose(picture.color[at], expected, rtol=1e-10)


def test_rotated_and_brighter_map_is_looked_up_turned(sky):
    # Turned by 90 degrees about y, what lay at +x comes to lie at -z, where the camera looks.
    turn = np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]], dtype=float)
    picture = render(
        [], Camera(placed(), vertical_fov=1e-3), (1, 1), sky, Regular(), rotation=turn, exposure=1
    )
    np.testing.assert_allclose(picture.color[0, 0], 2 * sample_cube(sky, [1, 0, 0]), rtol=1e-9)


def test_emission_does_not_follow_the_maps_exposure(sky):
    item = cube_object(material=Material(emissive=(3, 2, 1)))
    picture = render(
        [item], Camera(placed(offset=(0, 0, 5)), vertical_fov=1e-3), (1, 1), sky, Regular(), exposure=-4
    )
    np.testing.assert_allclose(picture.color[0, 0], [3, 2, 1])


def test_captured_map_of_nothing_is_the_map_itself(sky):
    np.testing.assert_allclose(capture([], (0, 5, 0), 16, sky), sky[0], atol=1e-12)


def test_captured_map_shows_surroundings_but_not_its_owner(sky):
    wall = cube_object(placed(offset=(4, 0, 0)), Material(emissive=(7, 8, 9)))
    own = cube_object(placed(np.eye(3) * 0.5))
    with_owner = capture([own, wall], (0, 0, 0), 16, sky)
    without = capture([own, wall], (0, 0, 0), 16, sky, without=0)
    # From inside, the owner's triangles are seen from behind and thus not at all.
    np.testing.assert_array_equal(with_owner, without)
    shown = np.all(without == [7, 8, 9], axis=-1)
    # The near face of the wall, at x = 3, fills a third of +X's face in u and v.
    at = (2 * np.arange(16) + 1) / 16 - 1
    np.testing.assert_array_equal(shown[0], (np.abs(at)[:, None] < 1 / 3) & (np.abs(at)[None, :] < 1 / 3))
    assert not np.any(shown[1:])


def test_captured_diffuse_is_irradiance_over_pi():
    light = build_pyramid(np.full((6, 8, 8, 3), 2.0), "box")
    wall = cube_object(placed(offset=(0, 4, 0)), Material((0.5, 0.25, 0), [KurtLobe(0.1)]))
    seen = capture([wall], (0, 0, 0), 9, light)[2, 4, 4]
    np.testing.assert_allclose(seen, [1, 0.5, 0], rtol=5e-3)


def test_captured_diffuse_follows_the_normal():
    # Light from above: the top of a block below the point is bright, its shade as `shade` gives it.
    d = texel_directions(16)
    light = build_pyramid(1 + 0.9 * d[..., [1, 1, 1]], "box")
    material = Material((0.5, 0.25, 1))
    block = cube_object(placed(offset=(0, -4, 0)), material)
    seen = capture([block], (0, 0, 0), 9, light)[3, 4, 4]
    np.testing.assert_allclose(
        seen, shade(light, material, Regular(), [0, 1, 0], [1, 0, 0], [0, 1, 0]), rtol=1e-12
    )
    np.testing.assert_allclose(seen, np.array([0.5, 0.25, 1]) * (1 + 0.6), rtol=5e-3)
