"""A square with textures, and what the oracle says of each of its texels."""

import base64
import io
import json

import numpy as np
from PIL import Image

import burnish
from burnish.oracle.shading import shade as oracle_shade
from engine_support import HARDWARE_WEIGHTS

# The G-buffer holds colours and slopes in half precision: 2^-11 each; the picture under smooth light no more.
LIMIT = 4e-3
# Lobes scaled to their albedo read it, where roughness varies, from a table over all roughnesses.
ALBEDO_LIMIT = 5e-3
SMOOTH_BRIGHTEST = 5.0
TEXELS, PIXELS = 4, 16
CENTERS = np.arange(PIXELS // TEXELS // 2, PIXELS, PIXELS // TEXELS)
NEAREST, REPEAT = 9728, 10497


def data_uri(mime, data):
    return f"data:{mime};base64,{base64.b64encode(data).decode()}"


def png(texels):
    file = io.BytesIO()
    Image.fromarray(np.round(np.asarray(texels) * 255).astype(np.uint8)).save(file, "PNG")
    return data_uri("image/png", file.getvalue())


def quantized(texels):
    return np.round(np.asarray(texels) * 255) / 255


def write_quad(
    path,
    material,
    images,
    extensions=(),
    tangent=(1, 0, 0, 1),
    node=None,
    attributes=(),
    model="ggx",
    leave_out_idle=False,
):
    """A square of edge 2 in the plane z = 0, rows of pictures along those of textures.

    `tangent` of None leaves TANGENT out; `node` holds the node's transform; `attributes` are more arrays of
    the corners, from the lower left counter-clockwise: name, glTF type, four rows; `model` is that of lobes.
    Textures of one value stay, unless they are asked to be left out.
    """
    positions = np.float32([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    named = {
        "POSITION": (positions, "VEC3"),
        "NORMAL": (np.float32([[0, 0, 1]] * 4), "VEC3"),
        "TEXCOORD_0": (np.float32([[0, 1], [1, 1], [1, 0], [0, 0]]), "VEC2"),
    }
    if tangent is not None:
        named["TANGENT"] = np.float32([tangent] * 4), "VEC4"
    named |= {name: (np.float32(array), kind) for name, kind, array in attributes}
    attributes = {name: k for k, name in enumerate(named)}
    data, views, accessors = b"", [], []
    for array, kind in [*named.values(), (np.uint16([0, 1, 2, 0, 2, 3]), "SCALAR")]:
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        accessor = {"bufferView": len(accessors), "type": kind, "count": len(array)}
        accessor["componentType"] = 5126 if array.dtype == np.float32 else 5123
        accessors.append(accessor)
        data += array.tobytes()
    accessors[0] |= {"min": positions.min(0).tolist(), "max": positions.max(0).tolist()}
    document = {
        "asset": {"version": "2.0"},
        "extensionsUsed": list(extensions),
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0} | (node or {})],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": len(named), "material": 0}]}],
        "materials": [material],
        "buffers": [{"uri": data_uri("application/octet-stream", data), "byteLength": len(data)}],
        "bufferViews": views,
        "accessors": accessors,
        "samplers": [{"magFilter": NEAREST, "minFilter": NEAREST, "wrapS": REPEAT, "wrapT": REPEAT}],
        "images": [{"uri": png(image)} for image in images],
        "textures": [{"source": k, "sampler": 0} for k in range(len(images))],
    }
    path.write_text(json.dumps(document))
    return burnish.Scene.from_file(path, model, leave_out_idle=leave_out_idle)


def srgb_to_linear(v):
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def texel_colors(device, scene, environment, sampler):
    """The picture of the square from straight above, at the middle of each texel; the frame too."""
    scene.environment = environment
    camera = burnish.Camera.orthographic((0, 0, 3), (0, 0, 0), half_height=1.0, far_plane=10.0)
    frame = burnish.render(scene, camera, (PIXELS, PIXELS), sampler, device=device)
    assert frame.alpha.all() and frame.report.non_finite == 0
    return frame.color[np.ix_(CENTERS, CENTERS)], frame


def middle_color(device, scene, environment, sampler, view):
    """Radiance (3,) of the square, all of one colour, seen from direction `view`; the frame too."""
    scene.environment = environment
    camera = burnish.Camera.orthographic(3 * np.asarray(view), (0, 0, 0), half_height=0.1, far_plane=10.0)
    frame = burnish.render(scene, camera, (8, 8), sampler, device=device)
    assert frame.alpha.all() and frame.report.non_finite == 0
    return frame.color[4, 4], frame


def levels_of(device, environment, sampler):
    """The map as the oracle's sampler takes it."""
    if isinstance(sampler, burnish.Prefiltered):
        return [level for _, level in environment.prefiltered(device=device)]
    return environment.pyramid(device=device)


def expected_colors(device, environment, materials, normals=None, sampler=None):
    """Oracle's radiance (4, 4, 3) of one material a texel, seen along +z."""
    sampler = burnish.Importance() if sampler is None else sampler
    levels = levels_of(device, environment, sampler)
    result = np.zeros((TEXELS, TEXELS, 3))
    for row, column in np.ndindex(TEXELS, TEXELS):
        normal = np.array([0.0, 0.0, 1.0]) if normals is None else normals[row, column]
        # Round lobes are sampled in the frame along growing longitude.
        tangent = np.array([normal[2], 0.0, -normal[0]])
        view = np.array([0.0, 0.0, 1.0])
        result[row, column] = oracle_shade(levels, materials(row, column), sampler, normal, tangent, view)
    return result


def assert_close(device, got, expected, limit=LIMIT):
    # Of materials' textures as well, which every device reads by its sampler.
    limit += 0.0 if device.is_software else HARDWARE_WEIGHTS * SMOOTH_BRIGHTEST / expected.mean()
    error = np.abs(got - expected) / expected.mean()
    worst = np.unravel_index(np.argmax(error), error.shape)
    assert error.max() <= limit, f"texel {worst}: got {got[worst]:.5f}, expected {expected[worst]:.5f}"


def is_on(frame, name):
    return next(line["on"] for line in frame.report.effects if line["name"] == name)
