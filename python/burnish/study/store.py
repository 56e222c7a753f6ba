"""Pictures of a study: in memory, and beside the journal where there is one."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from burnish.images.files import replacing


@dataclass(frozen=True, eq=False)
class StoredPicture:
    """One picture.

    Parameters
    ----------
    color : (h, w, 3) or (n, 3) float32
        Linear radiance.
    covered : (h, w) or (n,) bool
        Where objects are.
    standard_error : float
        Of a progressive reference, relative; else 0.
    """

    color: NDArray[np.float32]
    covered: NDArray[np.bool_]
    standard_error: float = 0.0


@dataclass(eq=False)
class CellPictures:
    """The pictures of one scene under one light, as every sampler draws it.

    Parameters
    ----------
    cell : dict
        ``scene``, ``material``, ``environment``, ``filter`` as the rows have them.
    reference : StoredPicture
        The truth.
    pictures : dict
        Linear radiance, (h, w, 3) float32, by the text of the sampler.
    """

    cell: dict[str, Any]
    reference: StoredPicture
    pictures: dict[str, NDArray[np.float32]] = field(default_factory=dict)


class PictureStore:
    """Keeps pictures by key.

    Parameters
    ----------
    folder : Path or None
        Where they are also written, so that a study that takes up its journal has them again.
        It is made when the first picture comes.
    """

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = folder
        self._pictures: dict[str, StoredPicture] = {}

    def get(self, key: str) -> StoredPicture | None:
        """Give a picture, or None where there is none that can be read."""
        if key in self._pictures:
            return self._pictures[key]
        path = self._path(key)
        if path is None or not path.is_file():
            return None
        try:
            with np.load(path, allow_pickle=False) as data:
                picture = StoredPicture(data["color"], data["covered"], float(data["standard_error"]))
        except (OSError, ValueError, KeyError, EOFError, BadZipFile):
            return None  # whatever befell the file, the picture is drawn again
        self._pictures[key] = picture
        return picture

    def put(self, key: str, picture: StoredPicture) -> None:
        """Keep a picture under a key."""
        self._pictures[key] = picture
        path = self._path(key)
        if path is None:
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        with replacing(path) as temporary:
            np.savez(
                temporary,
                color=picture.color,
                covered=picture.covered,
                standard_error=np.float64(picture.standard_error),
            )

    def forget(self, key: str) -> None:
        """Drop a picture from memory; its file stays."""
        self._pictures.pop(key, None)

    def _path(self, key: str) -> Path | None:
        return None if self._folder is None else self._folder / f"{key}.npz"
