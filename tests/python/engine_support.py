"""What the tests of the engine share: random surface points, and scenes as the oracle takes them."""

import numpy as np

from burnish.oracle.cube_map import border_indices
from burnish.oracle.raster import Camera, Object


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


# Hardware rounds the weights of a lookup, along x, along y and between levels, to 8 bits.
HARDWARE_WEIGHTS = 3 * 2.0**-9
# Hardware moves the corners of triangles to a grid of this many pixels, and what it interpolates with them.
HARDWARE_GRID = 2.0**-8


def lookup_error(device, brightest):
    """Most that rounded weights may add to a lookup of a map whose brightest texel is `brightest`."""
    is_exact = device.is_software or device.lookup == "software"
    return 0.0 if is_exact else HARDWARE_WEIGHTS * float(brightest)


def compare_radiance(got, expected, limit, share_beyond, factor_beyond):
    """Few points differ by over `limit` of their or the mean radiance, none by `factor_beyond` limits."""
    assert np.isfinite(got).all()
    error = np.abs(got - expected).max(axis=-1) / np.maximum(expected.max(axis=-1), expected.mean())
    worst, beyond = int(np.argmax(error)), int(np.sum(error > limit))
    assert error[worst] <= factor_beyond * limit and beyond <= share_beyond * len(error), (
        f"point {worst}: got {got[worst]}, expected {expected[worst]}; {beyond} of {len(error)} "
        f"points differ by more than {limit} of the mean radiance"
    )


def directions(array):
    """Return the array as `burnish.shade` takes it."""
    return np.ascontiguousarray(array, np.float32)


def random_points(rng, count, least_cos=0.05):
    """Normals, tangents and views of points seen from in front, (count, 3) float32 each."""
    normals = unit(rng.standard_normal((4 * count, 3)))
    views = unit(rng.standard_normal((4 * count, 3)))
    views *= np.where(np.sum(normals * views, axis=-1, keepdims=True) < 0, -1, 1)
    seen = np.flatnonzero(np.sum(normals * views, axis=-1) > least_cos)[:count]
    tangents = unit(rng.standard_normal((count, 3)))
    return directions(normals[seen]), directions(tangents), directions(views[seen])


def views_about_z(cosines, azimuths):
    """Normals +z, tangents +x and views of all pairs, (pairs, 3) float32 each; row-major in the cosine."""
    cosine, azimuth = (grid.ravel() for grid in np.meshgrid(cosines, azimuths, indexing="ij"))
    sine = np.sqrt(1 - cosine**2)
    views = np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), cosine], axis=-1)
    normals = np.broadcast_to([0.0, 0.0, 1.0], views.shape)
    tangents = np.broadcast_to([1.0, 0.0, 0.0], views.shape)
    return directions(normals), directions(tangents), directions(views)


def smooth_environment_faces(face_size, seed=3):
    """Radiance without edges, 0.2..5, different along every axis; (6, n, n, 3) float32."""
    from burnish.environments import cube_directions

    rng = np.random.default_rng(seed)
    d = cube_directions(face_size)
    waves = sum(np.sin(2 * (d @ rng.standard_normal((3, 3))) + rng.uniform(0, 6, 3)) for _ in range(3))
    return np.ascontiguousarray(np.exp(0.5 * waves), np.float32)


def edge_texels(face_size):
    """Of each of the 12 edges: the faces on both sides and the texels along it, in pairs."""
    inner, _ = border_indices(face_size, 1)
    flat = np.arange(6 * face_size**2).reshape(6, face_size, face_size)
    edges = {}
    for face in range(6):
        sides = {
            "left": (flat[face, :, 0], inner[face, 1:-1, 0]),
            "right": (flat[face, :, -1], inner[face, 1:-1, -1]),
            "top": (flat[face, 0], inner[face, 0, 1:-1]),
            "bottom": (flat[face, -1], inner[face, -1, 1:-1]),
        }
        for own, other in sides.values():
            edges[frozenset((face, int(other[0]) // face_size**2))] = (own, other)
    return edges


def oracle_objects(scene, materials=None):
    """Give the scene's objects as plain arrays; `materials` stand in for the scene's own."""
    materials = scene.materials if materials is None else materials
    objects = []
    for one in scene.objects:
        mesh = scene.meshes[one.mesh]
        objects.append(
            Object(
                mesh.positions,
                mesh.normals,
                mesh.indices,
                materials[one.material],
                mesh.tangents,
                one.world_from_object,
            )
        )
    return objects


def oracle_camera(camera):
    return Camera(
        camera.world_from_camera,
        camera.is_orthographic,
        camera.vertical_fov,
        camera.half_height,
        camera.near_plane,
        camera.far_plane,
    )
