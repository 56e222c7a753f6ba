import numpy as np
import pytest

from burnish.oracle.cube_map import cube_direction
from burnish.oracle.pyramid import TAPS, build_pyramid, reduce_level, round_to_half


@pytest.mark.parametrize("filter", ["box", "gauss4", "gauss6"])
@pytest.mark.parametrize("size", [1, 2, 16])
def test_constant_light_stays_constant(filter, size):
    for level in build_pyramid(np.full((6, size, size, 3), 0.7), filter):
        np.testing.assert_allclose(level, 0.7, rtol=1e-14)


@pytest.mark.parametrize("filter", ["box", "gauss4", "gauss6"])
def test_levels_halve_down_to_one_texel(filter, rng):
    sizes = [level.shape for level in build_pyramid(rng.random((6, 32, 32, 3)), filter)]
    assert sizes == [(6, n, n, 3) for n in (32, 16, 8, 4, 2, 1)]


def test_box_keeps_the_mean_of_each_face(rng):
    faces = rng.random((6, 16, 16, 3))
    np.testing.assert_allclose(build_pyramid(faces, "box")[-1][:, 0, 0], faces.mean(axis=(1, 2)), rtol=1e-13)


def test_spread_of_one_texel_is_the_filter():
    # Away from edges a lone texel at an even place lands on the coarse texels whose taps read it.
    faces = np.zeros((6, 16, 16, 1))
    faces[0, 8, 8] = 1
    for filter, along in (("box", [1]), ("gauss4", [1, 3]), ("gauss6", [1, 10, 5])):
        coarse = reduce_level(faces, filter)[0, ..., 0]
        scale = {"box": 2, "gauss4": 8, "gauss6": 32}[filter]
        row = np.array(along if filter != "box" else [1]) / scale
        found = coarse[coarse.sum(axis=1) > 0][:, coarse.sum(axis=0) > 0]
        np.testing.assert_allclose(np.sort(found.ravel()), np.sort(np.outer(row, row).ravel()), rtol=1e-14)


class Walker:
    """Steps from texel to texel over the cube's surface, by directions alone: an independent way across edges."""

    def __init__(self, size, face, row, column, heading):
        self.size, self.face, self.row, self.column, self.heading = size, face, row, column, heading

    def direction(self, face, row, column):
        return cube_direction(face, (2 * column + 1) / self.size - 1, (2 * row + 1) / self.size - 1)

    def turn_left(self):
        self.heading = (-self.heading[1], self.heading[0])

    def turn_right(self):
        self.heading = (self.heading[1], -self.heading[0])

    def step(self):
        row, column = self.row + self.heading[0], self.column + self.heading[1]
        if not (0 <= row < self.size and 0 <= column < self.size):
            row, column = self.cross_edge()
        self.row, self.column = row, column

    def cross_edge(self):
        middle = self.direction(self.face, (self.size - 1) / 2, (self.size - 1) / 2)
        # The nearest texel of another face that this edge, and not the one beside it, leads to.
        ahead = self.direction(self.face, self.row + 0.7 * self.heading[0], self.column + 0.7 * self.heading[1])
        candidates = [
            (face, row, column)
            for face in range(6)
            for row in range(self.size)
            for column in range(self.size)
            if face != self.face
        ]
        nearest = max(candidates, key=lambda c: float(self.direction(*c) @ ahead))
        self.face, row, column = nearest
        # Go on away from the face we left.
        self.heading = min(
            [(0, 1), (0, -1), (1, 0), (-1, 0)],
            key=lambda h: float(self.direction(self.face, row + 0.1 * h[0], column + 0.1 * h[1]) @ middle),
        )
        return row, column


def tap(faces, face, row, column):
    """Texel of a face's plane continued over its edges; beyond two edges the mean of both ways round."""
    size = faces.shape[1]
    inside_row, inside_column = min(max(row, 0), size - 1), min(max(column, 0), size - 1)
    steps = {"row": abs(row - inside_row), "column": abs(column - inside_column)}
    headings = {"row": (-1 if row < 0 else 1, 0), "column": (0, -1 if column < 0 else 1)}
    values = []
    for first, second in (("row", "column"), ("column", "row")):
        walker = Walker(size, face, inside_row, inside_column, headings[first])
        left_of_first = (-headings[first][1], headings[first][0])
        for _ in range(steps[first]):
            walker.step()
        if steps[first] == 0:
            walker.heading = headings[second]
        elif left_of_first == headings[second]:
            walker.turn_left()
        else:
            walker.turn_right()
        for _ in range(steps[second]):
            walker.step()
        values.append(faces[walker.face, walker.row, walker.column])
    return np.mean(values, axis=0)


@pytest.mark.parametrize("filter", ["gauss4", "gauss6"])
@pytest.mark.parametrize("size", [2, 4])
def test_filter_equals_walking_over_the_surface(filter, size, rng):
    faces = rng.random((6, size, size, 1))
    coarse = reduce_level(faces, filter)
    taps = TAPS[filter]
    first = 1 - len(taps) // 2
    for face in range(6):
        for row in range(size // 2):
            for column in range(size // 2):
                expected = sum(
                    wr * wc * tap(faces, face, 2 * row + first + r, 2 * column + first + c)
                    for r, wr in enumerate(taps)
                    for c, wc in enumerate(taps)
                )
                np.testing.assert_allclose(coarse[face, row, column], expected, rtol=1e-12, err_msg=f"{face} {row} {column}")


def test_half_levels_are_rounded_to_nearest_even():
    assert round_to_half(1 + 2.0**-11) == 1
    assert round_to_half(1 + 3 * 2.0**-11) == 1 + 2.0**-9
    assert round_to_half(2e-8) == 0
    assert round_to_half(65504.0) == 65504


def test_half_levels_build_on_rounded_ones(rng):
    levels = build_pyramid(rng.random((6, 8, 8, 3)) * 1000, "gauss6", half=True)
    for fine, coarse in zip(levels[:-1], levels[1:], strict=True):
        np.testing.assert_array_equal(fine, fine.astype(np.float16).astype(np.float64))
        np.testing.assert_array_equal(coarse, round_to_half(reduce_level(fine, "gauss6")))


def test_wrong_arguments_are_refused():
    with pytest.raises(ValueError, match=r"faces: expected shape \(6, N, N, c\), N a power of two, got"):
        build_pyramid(np.zeros((6, 3, 3, 3)))
    with pytest.raises(ValueError, match="filter: expected"):
        reduce_level(np.zeros((6, 2, 2, 3)), "sinc")
