"""Nothing that is not finite leaves a pass: the report says how many became black, where, in which pass."""

import numpy as np
import pytest

import burnish

# Of the lobe: with the light of `bright` it is more than float32 holds, alone it is not.
OVERFLOWS = 1e36
SAMPLERS = [
    burnish.Regular(5),
    burnish.Importance(5),
    burnish.Matched(5),
    burnish.Prefiltered(),
    burnish.Reference(method="quadrature"),
]


@pytest.fixture
def bright():
    return burnish.Environment.from_faces(np.full((6, 16, 16, 3), 2e3, np.float32))


def overflowing():
    return burnish.Material(lobes=[burnish.KurtLobe(roughness=0.1, weight=OVERFLOWS)])


def pass_of(sampler):
    return "reference" if isinstance(sampler, burnish.Reference) else "shade"


@pytest.mark.parametrize("sampler", SAMPLERS, ids=repr)
def test_guard_counts_points_and_names_the_first(bright, sampler, device):
    faces = bright.faces.copy()
    faces[5] = 0  # -z: nothing is stopped where points look there
    normals = np.float32([[0, 0, -1]] * 2 + [[0, 0, 1]] * 3)
    tangents = np.float32([[1, 0, 0]] * 5)
    environment = burnish.Environment.from_faces(faces)
    arguments = (environment, overflowing(), sampler, normals, tangents, normals)
    text = f"pass {pass_of(sampler)}: 3 values were not finite and became black, the first at point 2"
    with pytest.warns(RuntimeWarning, match=text):
        radiance = burnish.shade(*arguments, device=device)
    assert np.isfinite(radiance).all() and not radiance[2:].any()
    with pytest.raises(FloatingPointError, match=text):
        burnish.shade(*arguments, device=device, strict=True)


@pytest.mark.parametrize("sampler", SAMPLERS, ids=repr)
def test_guard_counts_pixels_and_names_the_first(bright, sampler, device):
    scene = burnish.Scene.sphere(overflowing())
    scene.environment = bright
    frame = burnish.render(scene, size=(20, 24), sampler=sampler, device=device)
    covered = frame.alpha > 0
    assert np.isfinite(frame.color).all() and not frame.color[covered].any()
    [stopped] = frame.report.stopped
    assert stopped["pass"] == pass_of(sampler) and tuple(stopped["first"]) == tuple(np.argwhere(covered)[0])
    assert stopped["count"] == frame.report.non_finite == covered.sum()
    assert any("the first at row" in warning for warning in frame.report.warnings)
    with pytest.raises(FloatingPointError, match=f"pass {pass_of(sampler)}: {covered.sum()} values"):
        burnish.render(scene, size=(20, 24), sampler=sampler, device=device, strict=True)


def test_finite_pictures_stop_nothing_in_strict_mode(bright, device):
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)]))
    scene.environment = bright
    frame = burnish.render(scene, size=(16, 16), sampler=burnish.Regular(5), device=device, strict=True)
    assert frame.report.stopped == [] and frame.report.non_finite == 0
