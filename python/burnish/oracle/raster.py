"""Ray casting of triangle meshes: what a rasteriser must show, pixel by pixel."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .arrays import Array, BoolArray, IntArray, as_array, dot, normalize

_LEAF_TRIANGLES = 8
# A ray this close to a triangle's plane misses it: the edge-on triangle covers no pixel.
_PARALLEL = 1e-300


@dataclass(frozen=True)
class Object:
    """One mesh placed in the world, plain arrays only."""

    positions: Any  # (n, 3), object space
    normals: Any  # (n, 3)
    indices: Any  # three per triangle, counter-clockwise from the front
    material: Any  # a Material
    tangents: Any = None  # (n, 4), w = sign of the bitangent, or None
    world_from_object: Any = None  # (4, 4), None = identity


@dataclass(frozen=True)
class Camera:
    """A camera that looks along its own -z, y up, as cpp/burnish/scene/camera.h has it."""

    world_from_camera: Any
    is_orthographic: bool = False
    vertical_fov: float = 0.8
    half_height: float = 1.0
    near_plane: float = 0.01
    far_plane: float = 1000.0


def camera_rays(
    camera: Camera, size: tuple[int, int], offset_px: npt.ArrayLike = (0.0, 0.0)
) -> tuple[Array, Array]:
    """Origins and directions (height, width, 3) through the pixels, row 0 at the top.

    Directions have length 1 along the camera's axis, so that the ray parameter is the depth.

    Parameters
    ----------
    size : (height, width)
    offset_px : (2,)
        Of the rays from the pixel centres, x right, y down.
    """
    height, width = size
    matrix = as_array(camera.world_from_camera)
    right, down = as_array(offset_px)
    x = ((2 * (np.arange(width) + right) + 1) / width - 1) * (width / height)
    y = 1 - (2 * (np.arange(height) + down) + 1) / height
    x, y = np.broadcast_arrays(x[None, :], y[:, None])
    ones, zeros = np.ones_like(x), np.zeros_like(x)
    if camera.is_orthographic:
        origin = np.stack([x * camera.half_height, y * camera.half_height, zeros], axis=-1)
        direction = np.stack([zeros, zeros, -ones], axis=-1)
    else:
        reach = np.tan(camera.vertical_fov / 2)
        origin = np.zeros((height, width, 3))
        direction = np.stack([x * reach, y * reach, -ones], axis=-1)
    return origin @ matrix[:3, :3].T + matrix[:3, 3], direction @ matrix[:3, :3].T


@dataclass(frozen=True)
class Triangles:
    """All triangles of a scene in the world, with the boxes of a bounding volume hierarchy over them."""

    corners: Array  # (n, 3 corners, 3)
    normals: Array  # (n, 3 corners, 3), unit
    tangents: Array  # (n, 3 corners, 4), w = sign of the bitangent; 0, 0, 0, 1 where the mesh has none
    owner: IntArray  # (n,) index of the object
    cull: BoolArray  # (n,) invisible from behind
    order: IntArray  # (n,) triangles in the order of the leaves
    nodes: "list[tuple[Array, Array, int, int, int, int]]"  # low, high, first, end, left, right (-1: a leaf)


def gather_triangles(objects: list[Object], without: int | None = None) -> Triangles:
    """Bring all objects but number `without` into the world and sort their triangles into boxes.

    Normals go by the inverse transpose, tangents by the matrix itself; a mirroring matrix turns triangles
    around, which is undone so that their front stays their front, and makes right-handed frames left-handed.
    """
    parts: list[tuple[Array, Array, Array, IntArray, BoolArray]] = []
    for index, item in enumerate(objects):
        if index == without:
            continue
        matrix = np.eye(4) if item.world_from_object is None else as_array(item.world_from_object)
        linear = matrix[:3, :3]
        positions = as_array(item.positions) @ linear.T + matrix[:3, 3]
        mirrored = np.linalg.det(linear) < 0
        # The cofactor matrix is the inverse transpose times the determinant, whose sign must not matter.
        cofactor = np.stack([np.cross(linear[(i + 1) % 3], linear[(i + 2) % 3]) for i in range(3)])
        normals = normalize(as_array(item.normals) @ cofactor.T) * (-1 if mirrored else 1)
        tangents = np.tile([0.0, 0.0, 0.0, 1.0], (len(positions), 1))
        if item.tangents is not None:
            tangents[:, :3] = normalize(as_array(item.tangents)[:, :3] @ linear.T)
            tangents[:, 3] = as_array(item.tangents)[:, 3] * (-1 if mirrored else 1)
        faces = np.asarray(item.indices, dtype=np.int64).reshape(-1, 3)
        if mirrored:
            faces = faces[:, ::-1]
        count = len(faces)
        one_sided = not getattr(item.material, "double_sided", False)
        parts.append(
            (
                positions[faces],
                normals[faces],
                tangents[faces],
                np.full(count, index),
                np.full(count, one_sided),
            )
        )
    if not parts:
        empty = np.zeros((0, 3, 3))
        none = np.zeros(0, dtype=np.int64)
        return Triangles(empty, empty, np.zeros((0, 3, 4)), none, none.astype(bool), none, [])
    corners, normals, tangents, owner, cull = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
    order, nodes = _build_boxes(corners)
    return Triangles(corners, normals, tangents, owner, cull, order, nodes)


def _build_boxes(corners: Array) -> "tuple[IntArray, list[tuple[Array, Array, int, int, int, int]]]":
    order = np.arange(len(corners))
    centers = corners.mean(axis=1)
    nodes: list[tuple[Array, Array, int, int, int, int]] = []

    def build(first: int, end: int) -> int:
        inside = corners[order[first:end]]
        low, high = inside.min(axis=(0, 1)), inside.max(axis=(0, 1))
        node = len(nodes)
        nodes.append((low, high, first, end, -1, -1))
        if end - first > _LEAF_TRIANGLES:
            axis = int(np.argmax(np.ptp(centers[order[first:end]], axis=0)))
            middle = (first + end) // 2
            rank = np.argsort(centers[order[first:end], axis], kind="stable")
            order[first:end] = order[first:end][rank]
            left, right = build(first, middle), build(middle, end)
            nodes[node] = (low, high, first, end, left, right)
        return node

    if len(corners) > 0:
        build(0, len(corners))
    return order, nodes


@dataclass(frozen=True)
class Hits:
    """What each ray meets first; where it meets nothing, `triangle` is -1 and `depth` infinite."""

    triangle: IntArray
    depth: Array
    weights: Array  # (n, 3) barycentric


def cast_rays(
    triangles: Triangles, origins: Array, directions: Array, nearest: float = 0.0, farthest: float = np.inf
) -> Hits:
    """Nearest triangle along each ray with nearest < depth < farthest, in units of the direction's length.

    All rays walk the boxes together; each box hands on only the rays that meet it before what they have met.
    """
    count = len(origins)
    depth = np.full(count, farthest)
    triangle = np.full(count, -1)
    weights = np.zeros((count, 3))
    inverse = 1 / np.where(np.abs(directions) > 1e-12, directions, np.copysign(1e-12, directions))
    stack = [(0, np.arange(count))] if triangles.nodes else []
    while stack:
        node, rays = stack.pop()
        low, high, first, end, left, right = triangles.nodes[node]
        near, far = (low - origins[rays]) * inverse[rays], (high - origins[rays]) * inverse[rays]
        enter, leave = np.minimum(near, far).max(axis=1), np.maximum(near, far).min(axis=1)
        slack = 1e-9 * np.maximum(np.abs(leave), 1)  # flat boxes: rounding must not lose the ray
        rays = rays[(enter <= leave + slack) & (leave >= nearest - slack) & (enter < depth[rays] + slack)]
        if len(rays) == 0:
            continue
        if left >= 0:
            stack += [(right, rays), (left, rays)]
            continue
        members = triangles.order[first:end]
        t, bary = _moller_trumbore(origins[rays], directions[rays], triangles, members)
        t = np.where((t > nearest) & (t < depth[rays, None]), t, np.inf)
        best = np.argmin(t, axis=1)
        row = np.arange(len(rays))
        closer = np.isfinite(t[row, best])
        rays, best, row = rays[closer], best[closer], row[closer]
        depth[rays] = t[row, best]
        triangle[rays] = members[best]
        weights[rays] = bary[row, best]
    return Hits(triangle, np.where(triangle >= 0, depth, np.inf), weights)


def _moller_trumbore(
    origins: Array, directions: Array, triangles: Triangles, members: IntArray
) -> tuple[Array, Array]:
    a = triangles.corners[members, 0]
    edge1, edge2 = triangles.corners[members, 1] - a, triangles.corners[members, 2] - a
    p = np.cross(directions[:, None, :], edge2[None])
    determinant = dot(p, edge1)  # > 0 where the ray comes from the front
    crosses = np.where(triangles.cull[members], determinant > _PARALLEL, np.abs(determinant) > _PARALLEL)
    scale = 1 / np.where(crosses, determinant, 1.0)
    to_origin = origins[:, None, :] - a
    u = dot(to_origin, p) * scale
    q = np.cross(to_origin, edge1[None])
    v = dot(directions[:, None, :], q) * scale
    inside = crosses & (u >= 0) & (v >= 0) & (u + v <= 1)
    t = np.where(inside, dot(edge2, q) * scale, np.inf)
    return t, np.stack([1 - u - v, u, v], axis=-1)


def interpolate(values: npt.ArrayLike, hits: Hits) -> Array:
    """Corner values (n, 3 corners, c) at the hits, (rays, c); of no meaning where nothing is hit."""
    corners = as_array(values)[np.maximum(hits.triangle, 0)]
    result: Array = np.sum(corners * hits.weights[..., None], axis=1)
    return result
