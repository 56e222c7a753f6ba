"""Hypothesis strategies for what Burnish takes: lobes, materials, points, environments, scenes."""

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import burnish

EXTREME_SIZES = (0.0, 1e-44, 1e-30, 1e-12, 0.1, 1.0, 1.001, 1e12, 3e38)


def ends_or(low: float, high: float):
    """Give the ends of a range as often as what lies between."""
    low, high = float(np.float32(low)), float(np.float32(high))
    return st.one_of(st.sampled_from([low, high]), st.floats(low, high, width=32))


def lobes(least_roughness: float = 1e-3, largest_weight: float = 4.0):
    return st.builds(
        lambda wide, narrow, is_turned, **rest: burnish.KurtLobe(
            roughness=(narrow, wide) if is_turned else (wide, narrow), **rest
        ),
        ends_or(least_roughness, 1.0),
        ends_or(least_roughness, 1.0),
        st.booleans(),
        r0=st.one_of(ends_or(0.0, 1.0), st.tuples(*[ends_or(0.0, 1.0)] * 3)),
        alpha=st.one_of(st.just(0.5), ends_or(0.0, 1.0)),
        weight=st.one_of(st.just(1.0), st.tuples(*[ends_or(0.0, largest_weight)] * 3)),
        rotation=st.floats(-100, 100, width=32),
        conserve_energy=st.booleans(),
    )


def materials(**lobe_options):
    return st.builds(
        burnish.Material,
        diffuse=st.one_of(st.just(0.0), st.tuples(*[ends_or(0.0, 1.0)] * 3)),
        lobes=st.lists(lobes(**lobe_options), max_size=4),
        emissive=st.one_of(st.just(0.0), ends_or(0.0, 1e3)),
    )


@st.composite
def directions(draw, count: int):
    """Draw unit vectors: along axes, through edges and corners of the cube, and anywhere."""
    exact = draw(hnp.arrays(np.int8, (count, 3), elements=st.integers(-2, 2))).astype(np.float64)
    tilt = draw(hnp.arrays(np.float32, (count, 3), elements=st.floats(-1, 1, width=32)))
    vectors = exact + draw(st.sampled_from([0.0, 1e-7, 1e-3, 1.0])) * tilt
    vectors[np.linalg.norm(vectors, axis=1) < 1e-12] = (0.0, 0.0, -1.0)
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


@st.composite
def hostile_points(draw, count: int = 8):
    """Draw normals, tangents and views of any finite length, in any position to one another."""
    normals, tangents, views = (draw(directions(count)) for _ in range(3))
    across = np.cross(normals, tangents)
    tilt = draw(st.sampled_from([-1e-3, -1e-7, 0.0, 1e-7, 1e-3]))
    views = draw(st.sampled_from([views, normals, -normals, across + tilt * normals]))
    tangents = draw(st.sampled_from([tangents, normals, normals + 1e-7 * tangents]))
    sizes = hnp.arrays(np.float64, (count, 1), elements=st.sampled_from(EXTREME_SIZES))
    return tuple(
        np.ascontiguousarray(vectors * draw(sizes), np.float32) for vectors in (normals, tangents, views)
    )


@st.composite
def faces(draw, largest_exponent: int = 4, **elements):
    """Draw texels of a cube map; every float32 there is where no range is given."""
    size = 2 ** draw(st.integers(0, largest_exponent))
    fill = st.floats(width=32, **elements)
    return draw(hnp.arrays(np.float32, (6, size, size, 3), elements=fill, fill=fill))


@st.composite
def meshes(draw):
    """Draw triangles over shared corners: slivers, doubles, single points; normals to any side or none."""
    corner_count = draw(st.integers(3, 8))
    coordinate = st.floats(-2, 2, width=32)
    positions = draw(hnp.arrays(np.float32, (corner_count, 3), elements=coordinate))
    corner = st.integers(0, corner_count - 1)
    indices = draw(hnp.arrays(np.uint32, st.tuples(st.integers(1, 6), st.just(3)), elements=corner))
    normals = None
    if draw(st.booleans()):
        normals = np.ascontiguousarray(draw(directions(corner_count)), np.float32)
    return burnish.Mesh(positions, indices, normals=normals)
