"""Alpha-masked textures keep their coverage when they are minified."""

import numpy as np
import pytest

import burnish
from gltf_support import LINEAR, NEAREST, GltfFile

PIXELS, SIDE = 64, 256
LINEAR_MIPMAP_LINEAR, LINEAR_MIPMAP_NEAREST = 9987, 9985


def fence(rng):
    """Bars of 5 in 16 texels across bars of 2 in 16: 40 % are covered, and far levels are all one grey."""
    bars = np.arange(SIDE) % 16
    return np.maximum((bars < 5)[None, :], (bars < 2)[:, None]).astype(float)


def leaves(rng):
    """Discs of all sizes with soft edges."""
    row, column = np.indices((SIDE, SIDE))
    alpha = np.zeros((SIDE, SIDE))
    for x, y, radius in zip(*rng.uniform([[0], [0], [3]], [[SIDE], [SIDE], [14]], (3, 150)), strict=True):
        dx, dy = (np.abs(v) for v in (column - x, row - y))
        distance = np.hypot(np.minimum(dx, SIDE - dx), np.minimum(dy, SIDE - dy))
        alpha = np.maximum(alpha, np.clip((radius - distance) / 3 + 0.5, 0, 1))
    return alpha


def grass(rng):
    """Blades a texel and a half wide: the first average leaves none above a cutoff of one half."""
    column = np.arange(SIDE)
    shift = rng.integers(0, 9, SIDE // 8).repeat(8)
    return np.clip(1.25 - np.abs((column[None, :] + shift[:, None]) % 9 - 4), 0, 1)


PATTERNS = {"fence": fence, "leaves": leaves, "grass": grass}


def masked_square(
    path,
    alpha,
    repeats,
    cutoff,
    min_filter=LINEAR_MIPMAP_LINEAR,
    mag_filter=LINEAR,
    factor=1.0,
    vertex_alpha=None,
    **more,
):
    """A square twice as large as the picture, so that no pixel of it sees past an edge."""
    file = GltfFile()
    texels = np.concatenate([np.full((SIDE, SIDE, 3), 0.5), np.round(alpha * 255)[..., None] / 255], -1)
    texture = file.texture(texels, magFilter=mag_filter, minFilter=min_filter)
    pbr = {"baseColorTexture": {"index": texture}, "baseColorFactor": [1, 1, 1, factor]}
    material = {"pbrMetallicRoughness": pbr, "alphaMode": "MASK", "alphaCutoff": cutoff} | more
    uv = np.float32([[0, 1], [1, 1], [1, 0], [0, 0]]) * 2 * repeats
    colors = {} if vertex_alpha is None else {"COLOR_0": np.tile(np.float32([1, 1, 1, vertex_alpha]), (4, 1))}
    file.document["nodes"] = [{"mesh": file.square(material, TEXCOORD_0=uv, **colors), "scale": [2, 2, 1]}]
    scene = burnish.Scene.from_file(file.write(path))
    scene.environment = burnish.Environment.from_faces(np.ones((6, 1, 1, 3), np.float32))
    scene.show_background = False
    return scene


def coverage_of(device, scene, spp=1):
    camera = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.0, far_plane=10.0)
    return burnish.render(
        scene, camera, (PIXELS, PIXELS), burnish.Prefiltered(), spp=spp, device=device
    ).alpha


def truth(alpha, repeats, cutoff):
    """Share of each pixel where alpha, read between texels, reaches the cutoff: 32 x 32 places a pixel.

    A place lies anywhere in its row and column, so that none falls in step with the texels.
    """
    places = 32
    count = PIXELS * places
    # The middle of the square is the middle of its texture coordinates, 2 repeats wide.
    jitter = np.random.default_rng(1).random((2, count))
    at = ((np.arange(count) + jitter) / count * repeats + repeats / 2) * SIDE - 0.5
    low = np.floor(at).astype(int)
    share = at - low
    rows = alpha[low[0] % SIDE] * (1 - share[0])[:, None] + alpha[(low[0] + 1) % SIDE] * share[0][:, None]
    read = rows[:, low[1] % SIDE] * (1 - share[1]) + rows[:, (low[1] + 1) % SIDE] * share[1]
    covered = read >= cutoff
    return covered.reshape(PIXELS, places, PIXELS, places).mean(axis=(1, 3))


@pytest.mark.parametrize("repeats", [0.5, 1, 3, 4, 16], ids=lambda repeats: f"{4 * repeats:g} texels a pixel")
@pytest.mark.parametrize("cutoff", [0.25, 0.5, 0.75])
@pytest.mark.parametrize("pattern", PATTERNS)
def test_minified_mask_keeps_its_coverage(device, rng, tmp_path, pattern, cutoff, repeats):
    """Of the whole picture to 2 %, root mean square over its 64 blocks of 8 x 8 pixels to 8 %."""
    alpha = np.round(PATTERNS[pattern](rng) * 255) / 255
    got = coverage_of(device, masked_square(tmp_path / "mask.gltf", alpha, repeats, cutoff))
    expected = truth(alpha, repeats, cutoff)
    assert 0.05 < expected.mean() < 0.95
    assert abs(got.mean() - expected.mean()) < 0.02
    blocks = [picture.reshape(8, 8, 8, 8).mean(axis=(1, 3)) for picture in (got, expected)]
    assert np.sqrt(np.mean((blocks[0] - blocks[1]) ** 2)) < 0.08


def test_averaged_pictures_converge_to_each_pixels_coverage(device, rng, tmp_path):
    alpha = np.round(leaves(rng) * 255) / 255
    scene = masked_square(tmp_path / "mask.gltf", alpha, 1, 0.5)
    expected = truth(alpha, 1, 0.5)
    errors = {spp: np.sqrt(np.mean((coverage_of(device, scene, spp) - expected) ** 2)) for spp in (1, 16)}
    # What is left is the levels' and the pictures' filters, which are wider than a pixel.
    assert errors[16] < 0.12 < 0.2 < errors[1]


def test_factor_and_vertex_alpha_move_the_cutoff(device, rng, tmp_path):
    """Alpha is the product of all three; where texels are 0 or 1 and sharp, any cutoff cuts the same."""
    alpha = fence(rng)
    rows = [(0.6, None, 0.5, 1), (0.9, 0.7, 0.6, 1), (0.9, 0.7, 0.65, 0), (0.4, None, 0.5, 0)]
    for factor, vertex_alpha, cutoff, share in rows:
        alphas = {"factor": factor, "vertex_alpha": vertex_alpha}
        scene = masked_square(tmp_path / "mask.gltf", alpha, 4, cutoff, mag_filter=NEAREST, **alphas)
        assert abs(coverage_of(device, scene).mean() - share * alpha.mean()) < 0.02
    soft = np.round(leaves(rng) * 255) / 255
    scene = masked_square(tmp_path / "soft.gltf", soft, 4, 0.45, factor=0.6)
    assert abs(coverage_of(device, scene).mean() - truth(soft, 4, 0.75).mean()) < 0.02


def test_blended_materials_and_nearest_levels_keep_their_coverage(device, rng, tmp_path):
    alpha = fence(rng)
    expected = truth(alpha, 4, 0.5).mean()
    for more in ({"alphaMode": "BLEND"}, {"min_filter": LINEAR_MIPMAP_NEAREST}):
        scene = masked_square(tmp_path / "mask.gltf", alpha, 4, 0.5, **more)
        assert abs(coverage_of(device, scene).mean() - expected) < 0.02


def test_a_texture_without_levels_is_read_as_its_file_asks(device, rng, tmp_path):
    alpha = grass(rng)
    got = coverage_of(device, masked_square(tmp_path / "mask.gltf", alpha, 0.75, 0.5, min_filter=NEAREST))
    at = (
        np.floor((np.arange(PIXELS) + 0.5) * 3 + 0.375 * SIDE).astype(int) % SIDE
    )  # the middle of every third texel
    np.testing.assert_array_equal(got, np.round(alpha[np.ix_(at, at)] * 255) / 255 >= 0.5)


def test_the_same_texture_under_two_cutoffs(device, rng, tmp_path):
    """The levels belong to the texture and the cutoff: two materials may read one picture."""
    alpha = np.round(leaves(rng) * 255) / 255
    scene = masked_square(tmp_path / "mask.gltf", alpha, 4, 0.25)
    for cutoff in (0.25, 0.75):
        other = masked_square(tmp_path / "other.gltf", alpha, 4, cutoff)
        assert abs(coverage_of(device, other).mean() - truth(alpha, 4, cutoff).mean()) < 0.02
    assert abs(coverage_of(device, scene).mean() - truth(alpha, 4, 0.25).mean()) < 0.02
