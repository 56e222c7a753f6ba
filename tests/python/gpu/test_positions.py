"""Where the pixels' rays meet objects, in the world."""

import numpy as np
import pytest

import burnish

SIZE = (18, 31)
EYE = np.array([0.4, 2.0, 1.5])


def cameras(place):
    eye, target = EYE + place, np.array(place, np.float64)
    yield burnish.Camera.look_at(eye, target, vertical_fov=1.2)
    yield burnish.Camera.look_at(eye, target, vertical_fov=1.2, near_plane=0.7)
    yield burnish.Camera.orthographic(eye, target, half_height=0.8, near_plane=-2.0, far_plane=9.0)


@pytest.mark.parametrize("which", [0, 1, 2])
@pytest.mark.parametrize("place", [(0.0, 0.0, 0.0), (3e6, -2e6, 1e6)])
@pytest.mark.parametrize("spp", [1, 3])
def test_positions_lie_on_what_is_drawn(device, which, place, spp):
    """Those of a plane lie in it, those of a unit sphere 1 from its centre, also far from the origin."""
    camera = list(cameras(place))[which]
    shift = np.eye(4)
    shift[:3, 3] = place
    for mesh in (burnish.Mesh.plane(1.0), burnish.Mesh.sphere()):
        scene = burnish.Scene()
        scene.add(mesh, burnish.Material(diffuse=0.5, double_sided=True), shift)
        frame = burnish.render(scene, camera, SIZE, device=device, spp=spp)
        met = np.isfinite(frame.depth)
        assert met.any() and not met.all()
        assert frame.position.shape == (*SIZE, 3) and np.isnan(frame.position[~met]).all()
        local = frame.position[met] - place
        if mesh.positions[:, 1].any():
            # The mesh is inscribed in the sphere.
            assert (
                0.98 < np.linalg.norm(local, axis=-1).min() <= np.linalg.norm(local, axis=-1).max() < 1 + 1e-5
            )
        else:
            np.testing.assert_allclose(local[:, 1], 0.0, atol=1e-5)


def test_positions_project_onto_their_pixels(device):
    """Of one picture the ray passes through the pixel's centre."""
    scene = burnish.Scene.plane(burnish.Material(diffuse=0.5))
    camera = next(cameras((0, 0, 0)))
    frame = burnish.render(scene, camera, SIZE, device=device)
    row, column = np.nonzero(np.isfinite(frame.depth))
    local = (frame.position[row, column] - EYE) @ camera.world_from_camera[:3, :3]
    half = np.tan(0.5 * camera.vertical_fov)
    np.testing.assert_allclose(
        local[:, 0] / -local[:, 2] * SIZE[0] / (2 * half), column + 0.5 - SIZE[1] / 2, atol=1e-4
    )
    np.testing.assert_allclose(
        local[:, 1] / -local[:, 2] * SIZE[0] / (2 * half), SIZE[0] / 2 - row - 0.5, atol=1e-4
    )
    np.testing.assert_allclose(-local[:, 2], frame.depth[row, column], rtol=1e-6)
