"""The pyramid's taps across edges and corners, against a walk over the cube's surface."""

import numpy as np
import pytest

from burnish.oracle.cube_map import cube_direction
from burnish.oracle.pyramid import TAPS, reduce_level


class Walker:
    """Steps from texel to texel over the cube's surface by directions alone: another way across edges."""

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
        ahead = self.direction(
            self.face, self.row + 0.7 * self.heading[0], self.column + 0.7 * self.heading[1]
        )
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
                np.testing.assert_allclose(
                    coarse[face, row, column], expected, rtol=1e-12, err_msg=f"{face} {row} {column}"
                )
