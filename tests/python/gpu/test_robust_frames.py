"""Thousands of frames keep memory flat; frames need no rights, display or second CPU; bad texels stay out."""

import json
import os
import subprocess
import sys
import textwrap

import numpy as np
import pytest

import burnish
from burnish.environments import spots

# Each runs in its own process: what this one has allocated before must not blur what is counted.
SMALL_FRAMES = """
    import gc, json, sys
    import burnish
    from burnish.environments import spots

    count = int(sys.argv[1])
    device = burnish.Device()
    lobe = burnish.KurtLobe(roughness=(0.2, 0.1))
    samplers = [burnish.Regular(), burnish.Importance(7), burnish.Regular(100)]
    scenes = [burnish.Scene.sphere(burnish.Material(diffuse=d, lobes=[lobe])) for d in (0.0, 0.5)]
    for seed, scene in enumerate(scenes):
        scene.environment = spots(seed=seed, face_size=8)

    def memory():
        gc.collect()
        with open("/proc/self/statm") as file:
            resident = int(file.read().split()[1]) * 4096
        return {"resident": resident, **device.memory_statistics()}

    def frames(first, last):
        for k in range(first, last):
            if k % 50 == 0:  # a scene and a map of their own: caches must let go of the old ones
                scenes[k // 50 % 2] = burnish.Scene.sphere(burnish.Material(diffuse=k % 7 / 7, lobes=[lobe]))
                scenes[k // 50 % 2].environment = spots(seed=k, face_size=8)
            size = (16, 16) if k % 10 else (8 + k % 24, 16)
            frame = burnish.render(scenes[k % 2], size=size, sampler=samplers[k % 3], device=device)
            assert frame.report.non_finite == 0
            if k % 500 == 0:
                print(f"frame {k}", file=sys.stderr, flush=True)

    frames(0, 400)
    before = memory()
    frames(400, count)
    print(json.dumps([before, memory()]))
"""


def run_python(code, *arguments, timeout=280, **options):
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path), "BURNISH_VALIDATION": "0"}
    environment |= options.pop("env", {})
    result = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(code), *arguments],
        capture_output=True,
        text=True,
        timeout=timeout,
        env={key: value for key, value in environment.items() if value is not None},
        **options,
    )
    assert result.returncode == 0, f"exit {result.returncode}: {result.stderr[-2000:]}"
    return result.stdout


def assert_memory_is_flat(count, timeout):
    before, after = json.loads(run_python(SMALL_FRAMES, str(count), timeout=timeout).splitlines()[-1])
    # A heap's fragments may grow by pages; one leaked 16 x 16 frame or 8 x 8 map each would be far more.
    assert after["resident"] - before["resident"] <= 4 << 20, f"{before} -> {after}"
    for name in before.keys() - {"resident"}:
        assert after[name] <= before[name] * 1.2 + 2, f"{name}: {before[name]} -> {after[name]}"


def test_a_thousand_small_frames_leave_memory_flat():
    assert_memory_is_flat(1400, 200)


@pytest.mark.slow
@pytest.mark.timeout(1500)
def test_ten_thousand_small_frames_leave_memory_flat():
    assert_memory_is_flat(10400, 1400)


ONE_FRAME = """
    import os
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    import numpy as np
    import burnish
    from burnish.environments import spots

    environment = spots(face_size=16)
    if os.getuid() == 0:  # only after the imports: nobody may not be able to read the package
        os.setgroups([])
        os.setgid(65534)
        os.setuid(65534)
    assert not os.access(os.environ["HOME"], os.W_OK)
    device = burnish.Device()
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe()]))
    scene.environment = environment
    frame = burnish.render(scene, size=(32, 32), spp=2, device=device)
    assert np.isfinite(frame.color).all() and frame.alpha.sum() > 100
    print("user", os.getuid(), "mean", float(frame.color.mean()))
"""


def test_frame_renders_on_one_cpu_without_rights_home_or_display(tmp_path):
    """As nobody where the tests run as root, with a home that cannot be written, no display and one CPU."""
    home = tmp_path / "home"
    home.mkdir()
    home.chmod(0o555)
    unset = ("DISPLAY", "WAYLAND_DISPLAY", "XDG_RUNTIME_DIR", "XDG_CACHE_HOME", "MESA_SHADER_CACHE_DIR")
    env = dict.fromkeys(unset) | {"HOME": str(home), "PYTHONDONTWRITEBYTECODE": "1"}
    mean = float(run_python(ONE_FRAME, env=env, cwd="/").split()[-1])
    # The same picture as here, on all CPUs with every right.
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe()]))
    scene.environment = spots(face_size=16)
    assert mean == pytest.approx(float(burnish.render(scene, size=(32, 32), spp=2).color.mean()), rel=1e-6)


def faulty_faces():
    faces = np.ones((6, 16, 16, 3), np.float32)
    faces[0, 3, 4] = np.nan
    faces[1, 5, 6, 1] = np.inf
    faces[2, 7, 8, 2] = -np.inf
    faces[3, 0, 0] = -5.0
    faces[4, 1, 1] = 1e30
    faces[5, 2, 2, 0] = np.nan
    return faces


@pytest.mark.parametrize(
    "sampler",
    [burnish.Regular(), burnish.Regular(100), burnish.Importance(), burnish.Reference(0.05)],
    ids=["written out", "loop", "importance", "reference"],
)
def test_faulty_texels_are_counted_and_stay_out_of_the_picture(device, sampler):
    environment = burnish.Environment.from_faces(faulty_faces())
    counts = environment.texel_report
    assert (counts.not_a_number, counts.infinite, counts.negative, counts.above_half) == (2, 2, 1, 1)
    lobes = [burnish.KurtLobe(roughness=0.1, r0=0.5, alpha=0.5), burnish.KurtLobe(roughness=1.0, alpha=1.0)]
    scene = burnish.Scene.sphere(burnish.Material(diffuse=0.3, lobes=lobes))
    scene.environment = environment
    frame = burnish.render(scene, size=(40, 40), sampler=sampler, device=device)
    assert np.isfinite(frame.color).all() and (frame.color >= 0).all()
    assert frame.report.non_finite == 0
    assert any(
        "2 not a number" in warning and "2 infinite" in warning for warning in frame.report.warnings
    ), frame.report.warnings
    captured = scene.capture(point=(0, 3, 0), face_size=16, device=device)
    assert np.isfinite(captured.faces).all() and captured.texel_report.count == 0


@pytest.mark.parametrize("radiance", [0.0, 6e-8, 65504.0])
def test_pictures_are_finite_at_the_ends_of_half_precision(device, radiance):
    scene = burnish.Scene.shader_ball(
        burnish.Material(
            lobes=[burnish.KurtLobe(roughness=m, r0=0.04, alpha=a) for m, a in ((1e-3, 1.0), (1.0, 0.5))]
        )
    )
    scene.environment = burnish.environments.uniform(radiance, face_size=4)
    for sampler in (burnish.Regular(), burnish.Importance(), burnish.Reference(0.1)):
        frame = burnish.render(scene, size=(24, 32), sampler=sampler, device=device)
        assert np.isfinite(frame.color).all() and frame.report.non_finite == 0
        assert frame.color.max() <= 20 * max(radiance, 1e-30)


def test_scene_without_objects_or_light_is_black_or_background(device):
    scene = burnish.Scene()
    frame = burnish.render(scene, size=(5, 7), device=device)
    assert not frame.color.any() and not frame.alpha.any() and np.isinf(frame.depth).all()
    assert any("no environment" in warning for warning in frame.report.warnings)


def test_degenerate_geometry_makes_finite_pictures(device, spots64):
    """Triangles without area, tiny or as long as the world, and objects shrunk to nothing."""
    positions = np.float32(
        [[0, 0, 0], [0, 0, 0], [1, 0, 0], [-1e6, 0, 0], [1e6, 0, 0], [0, 1e6, 1], [1e-6, 0, 0], [0, 1e-6, 0]]
    )
    indices = np.uint32([[0, 1, 2], [3, 4, 5], [0, 6, 7]])
    normals = np.float32([[0, 0, 1]] * len(positions))
    scene = burnish.Scene()
    material = burnish.Material(diffuse=0.5, lobes=[burnish.KurtLobe(roughness=(0.5, 0.1))])
    scene.add(burnish.Mesh(positions, indices, normals), material)
    scene.add(burnish.Mesh.sphere(), material, np.diag([1e-6, 1e-6, 1e-6, 1.0]))
    scene.add(burnish.Mesh.sphere(), material, np.diag([1.0, 1e-4, 1.0, 1.0]))
    scene.environment = spots64
    camera = burnish.Camera.look_at((0, 1, 4), (0, 0, 0))
    for sampler in (burnish.Regular(), burnish.Importance()):
        frame = burnish.render(scene, camera, (32, 32), sampler, device=device)
        assert np.isfinite(frame.color).all() and np.isfinite(frame.normal).all()
        assert frame.report.non_finite == 0


def test_scenes_that_take_turns_keep_their_pictures(device):
    """More scenes than stay on the device, each with a mesh of its own; the last one's mesh then changes."""
    radii = (0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
    view = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.0, near_plane=0.1, far_plane=10)
    material = burnish.Material(emissive=1.0)

    def covered(radius):
        scene = burnish.Scene()
        scene.add(burnish.Mesh.sphere(radius, segments=32), material)
        return float(burnish.render(scene, view, (32, 32), device=device).alpha.sum())

    first = [covered(radius) for radius in radii]
    assert first == sorted(set(first))
    assert [covered(radius) for radius in (*radii, *reversed(radii))] == [*first, *reversed(first)]


@pytest.mark.parametrize(
    ("sampler", "tolerance"),
    [
        (burnish.Regular(1, normalization="published"), 1e-3),
        # Eight batches, which are added up: a tile that is shaded twice in each has twice the light.
        (burnish.Reference(standard_error=0.5, method="progressive"), 0.2),
    ],
)
def test_every_tile_of_a_picture_of_more_than_one_row_of_groups_is_shaded_once(device, sampler, tolerance):
    """2048 x 1040 pixels are 33280 tiles; a plane straight ahead is the same everywhere."""
    scene = burnish.Scene()
    upright = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], np.float32)
    scene.add(burnish.Mesh.plane(size=8.0), burnish.Material(lobes=[burnish.KurtLobe()]), upright)
    scene.environment = burnish.environments.uniform(1.0, 4)
    view = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.0, near_plane=0.1, far_plane=10)
    frame = burnish.render(scene, view, (1040, 2048), sampler, device)
    assert frame.alpha.min() == 1 and frame.color.min() > 0
    np.testing.assert_allclose(frame.color, frame.color[500, 500, 0], rtol=tolerance)
