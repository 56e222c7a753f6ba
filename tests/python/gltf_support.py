"""glTF files made by code: accessors over one buffer, pictures as data URIs, all else as plain dicts."""

import base64
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

COMPONENT_TYPES = {"b": 5120, "B": 5121, "h": 5122, "H": 5123, "I": 5125, "f": 5126}
SHAPES = {(): "SCALAR", (2,): "VEC2", (3,): "VEC3", (4,): "VEC4", (4, 4): "MAT4"}
NEAREST, LINEAR = 9728, 9729

# A square of edge 2 in the plane z = 0, its rows along those of pictures.
SQUARE = {
    "POSITION": np.float32([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]),
    "NORMAL": np.float32([[0, 0, 1]] * 4),
    "TANGENT": np.float32([[1, 0, 0, 1]] * 4),
    "TEXCOORD_0": np.float32([[0, 1], [1, 1], [1, 0], [0, 0]]),
}
SQUARE_INDICES = np.uint16([0, 1, 2, 0, 2, 3])


def data_uri(mime: str, data: bytes) -> str:
    return f"data:{mime};base64,{base64.b64encode(data).decode()}"


class GltfFile:
    """A document in the making; `document` may be changed freely until it is written."""

    def __init__(self) -> None:
        self._data = b""
        self.document: dict[str, Any] = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": []}

    def add(self, array: str, item: dict[str, Any]) -> int:
        """Append to one of the top-level arrays; its index."""
        items = self.document.setdefault(array, [])
        items.append(item)
        return len(items) - 1

    def accessor(self, values: np.ndarray, **fields: Any) -> int:
        """Numbers as they are; matrices [i] are stored by columns, as glTF has them."""
        stored = values.swapaxes(1, 2) if values.ndim == 3 else values
        data = np.ascontiguousarray(stored).tobytes()
        self._data += bytes(-len(self._data) % 4)
        view = {"buffer": 0, "byteOffset": len(self._data), "byteLength": len(data)}
        self._data += data
        accessor = {"bufferView": self.add("bufferViews", view), "count": len(values), **fields}
        accessor["componentType"] = COMPONENT_TYPES[values.dtype.char]
        accessor["type"] = SHAPES[values.shape[1:]]
        return self.add("accessors", accessor)

    def texture(self, texels: np.ndarray, **sampler: int) -> int:
        """Texels (h, w, 3 or 4) in 0..1, rounded to 8 bits."""
        file = io.BytesIO()
        Image.fromarray(np.round(np.asarray(texels) * 255).astype(np.uint8)).save(file, "PNG")
        image = self.add("images", {"uri": data_uri("image/png", file.getvalue())})
        return self.add("textures", {"source": image, "sampler": self.add("samplers", sampler)})

    def mesh(
        self, attributes: dict[str, np.ndarray], indices: np.ndarray, material: int | None = None
    ) -> int:
        """A mesh of one primitive; integers in weights and colours are normalized."""
        accessors = {
            name: self.accessor(
                values,
                **(
                    {"normalized": True}
                    if name[:5] in ("WEIGH", "COLOR") and values.dtype.kind == "u"
                    else {}
                ),
            )
            for name, values in attributes.items()
        }
        primitive: dict[str, Any] = {"attributes": accessors, "indices": self.accessor(indices)}
        if material is not None:
            primitive["material"] = material
        return self.add("meshes", {"primitives": [primitive]})

    def square(self, material: dict[str, Any] | None = None, **attributes: np.ndarray | None) -> int:
        """The square as a mesh; attributes replace or, where they are None, take away its own."""
        arrays = {name: values for name, values in (SQUARE | attributes).items() if values is not None}
        return self.mesh(
            arrays, SQUARE_INDICES, None if material is None else self.add("materials", material)
        )

    def write(self, path: Path) -> Path:
        """Write as .gltf, with its buffer inside; extensionsUsed lists every extension that is there."""
        document = self.document | {
            "buffers": [
                {"byteLength": len(self._data), "uri": data_uri("application/octet-stream", self._data)}
            ]
        }
        names = sorted(_extensions(document) | set(document.get("extensionsUsed", [])))
        document = {name: value for name, value in document.items() if value != []} | (
            {"extensionsUsed": names} if names else {}
        )
        if not self._data:
            del document["buffers"]
        path.write_text(json.dumps(document))
        return path


def _extensions(value: Any) -> set[str]:
    if isinstance(value, list):
        return set().union(*map(_extensions, value))
    if not isinstance(value, dict):
        return set()
    return set(value.get("extensions", {})).union(*map(_extensions, value.values()))
