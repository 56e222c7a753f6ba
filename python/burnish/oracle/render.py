"""Whole pictures and captured maps."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .arrays import Array, as_array, dot, normalize
from .cube_map import pad_cube, sample_cube, texel_directions
from .filter_offsets import filter_offsets
from .frame import facing_normal
from .irradiance import diffuse_light
from .raster import Camera, Hits, Object, Triangles, camera_rays, cast_rays, gather_triangles, interpolate
from .shading import shade


@dataclass(frozen=True)
class Picture:
    """Linear radiance, coverage 0..1, depth along the camera's axis (infinite: nothing), world normal.

    Depth and normal are those of the ray nearest to the pixel's centre.
    """

    color: Array
    alpha: Array
    depth: Array
    normal: Array


def _surface(triangles: Triangles, hits: Hits, views: Array) -> tuple[Array, Array]:
    """Unit shading normals, and tangents (n, 4), at the hits.

    Seen from behind, the normal turns to the eye. Tangent and bitangent stay, so that the frame's handedness
    changes.
    """
    normals = normalize(interpolate(triangles.normals, hits))
    corners = triangles.corners[np.maximum(hits.triangle, 0)]
    face = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    side = np.where(dot(face, views) < 0, -1.0, 1.0)[:, None]
    tangents = interpolate(triangles.tangents, hits)
    tangents[:, 3:] *= side
    return side * normals, tangents


def render(
    objects: list[Object],
    camera: Camera,
    size: tuple[int, int],
    env_levels: Sequence[npt.ArrayLike],
    sampler: Any,
    rotation: npt.ArrayLike | None = None,
    exposure: float = 0.0,
    show_background: bool = True,
    spp: int = 1,
) -> Picture:
    """Average pictures of equal weight whose rays pass the pixels at `filter_offsets`.

    Parameters
    ----------
    size : (height, width)
    env_levels : list of (6, n, n, 3)
        From `build_pyramid`; every object reflects this map.
    rotation : (3, 3), optional
        world_from_environment: a world direction w reads the map at transpose(rotation) w.
    exposure : float
        Stops: the map's radiance is multiplied by 2^exposure.
    spp : int
        Pictures.
    """
    triangles = gather_triangles(objects)
    pictures = [
        _cast_picture(
            objects,
            triangles,
            camera,
            size,
            offset,
            env_levels,
            sampler,
            rotation,
            exposure,
            show_background,
        )
        for offset in filter_offsets(spp)
    ]
    color, alpha = (np.mean([getattr(one, name) for one in pictures], axis=0) for name in ("color", "alpha"))
    return Picture(color, alpha, pictures[0].depth, pictures[0].normal)


def _cast_picture(
    objects: list[Object],
    triangles: Triangles,
    camera: Camera,
    size: tuple[int, int],
    offset_px: Array,
    env_levels: Sequence[npt.ArrayLike],
    sampler: Any,
    rotation: npt.ArrayLike | None,
    exposure: float,
    show_background: bool,
) -> Picture:
    """Cast one ray through each pixel and shade what it meets."""
    origins, directions = (a.reshape(-1, 3) for a in camera_rays(camera, size, offset_px))
    far = camera.far_plane if camera.is_orthographic else np.inf
    hits = cast_rays(triangles, origins, directions, camera.near_plane, far)
    turn = np.eye(3) if rotation is None else as_array(rotation)
    gain = 2.0**exposure
    color = np.zeros((len(origins), 3))
    normal = np.zeros((len(origins), 3))
    met = hits.triangle >= 0
    if show_background:
        color[~met] = gain * sample_cube(env_levels, directions[~met] @ turn)
    seen = np.flatnonzero(met)
    if len(seen) > 0:
        views = -normalize(directions[seen])
        part = Hits(hits.triangle[seen], hits.depth[seen], hits.weights[seen])
        normal[seen], tangents = _surface(triangles, part, views)
        owner = triangles.owner[part.triangle]
        for index in np.unique(owner):
            own = owner == index
            material = objects[index].material
            pixels = seen[own]
            facing = facing_normal(normal[pixels], views[own])
            tangent = np.concatenate([tangents[own, :3] @ turn, tangents[own, 3:]], axis=1)
            lit = shade(env_levels, material, sampler, facing @ turn, tangent, views[own] @ turn)
            emitted = as_array(getattr(material, "emissive", 0.0))
            color[pixels] = gain * (lit - emitted) + emitted
    alpha = met.astype(np.float64).reshape(size)
    return Picture(color.reshape(*size, 3), alpha, hits.depth.reshape(size), normal.reshape(*size, 3))


def capture(
    objects: list[Object],
    point: npt.ArrayLike,
    face_size: int,
    env_levels: Sequence[npt.ArrayLike],
    without: int | None = None,
) -> Array:
    """Radiance that arrives at a point, (6, N, N, 3): one ray through each texel centre.

    Objects show their diffuse part and what they emit; their lobes do not appear in a captured map.

    Parameters
    ----------
    without : int, optional
        The object left out: the one whose map this is.
    """
    directions = texel_directions(face_size).reshape(-1, 3)
    origins = np.broadcast_to(as_array(point), directions.shape)
    triangles = gather_triangles(objects, without)
    hits = cast_rays(triangles, origins, directions)
    radiance = sample_cube(pad_cube(env_levels), directions)
    seen = np.flatnonzero(hits.triangle >= 0)
    if len(seen) > 0:
        part = Hits(hits.triangle[seen], hits.depth[seen], hits.weights[seen])
        normals, _ = _surface(triangles, part, -directions[seen])
        owner = triangles.owner[part.triangle]
        for index in np.unique(owner):
            own, material = owner == index, objects[index].material
            light = diffuse_light(env_levels[0], normals[own], "cube")
            diffuse = as_array(material.diffuse) * light
            radiance[seen[own]] = diffuse + as_array(getattr(material, "emissive", 0.0))
    return radiance.reshape(6, face_size, face_size, 3)
