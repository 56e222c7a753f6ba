"""One rendered picture with its report."""

import math
import os
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from burnish.report import Report

if TYPE_CHECKING:  # the compiled part may be missing where this module is imported
    from burnish._core import Camera

FloatArray = NDArray[np.float32]


def relative_rmse(color: FloatArray, reference: FloatArray) -> float:
    """Relative root mean square error of linear radiance.

    ``sqrt(mean((color - reference)**2) / mean(reference**2))``, over all values, in double precision.

    Parameters
    ----------
    color, reference : (..., 3) float32
        Equal shapes.

    Returns
    -------
    error : float
        0 when equal; NaN when the reference is empty or black.
    """
    truth = np.asarray(reference, np.float64)
    energy = float(np.sum(truth**2))
    if energy == 0.0:
        return float("nan")
    return float(np.sqrt(np.sum((np.asarray(color, np.float64) - truth) ** 2) / energy))


def is_same_view(one: "Camera", other: "Camera") -> bool:
    """Whether two cameras see the same picture, to float32's rounding; near and far planes and names aside.

    Parameters
    ----------
    one, other : Camera
        To compare.
    """
    if one.is_orthographic != other.is_orthographic:
        return False
    extents = [c.half_height if c.is_orthographic else c.vertical_fov for c in (one, other)]
    return bool(
        np.isclose(extents[0], extents[1], rtol=1e-6, atol=0.0)
        and np.allclose(one.world_from_camera, other.world_from_camera, rtol=1e-6, atol=1e-6)
    )


def require_comparable(
    reference: "Frame", size: tuple[int, int], camera: "Camera | None", spp: int, stacklevel: int = 3
) -> None:
    """Refuse a reference that shows something else, and warn of one that averages more or fewer pictures.

    Parameters
    ----------
    reference : Frame
        The truth.
    size : (height, width)
        Of the picture that it is to judge, pixels.
    camera : Camera or None
        Of that picture; None: not known, and not compared.
    spp : int
        Of that picture.
    stacklevel : int
        Of the warning.

    Raises
    ------
    ValueError
        If size or camera differ.
    """
    got = reference.color.shape[:2]
    if got != tuple(size):
        raise ValueError(f"reference: expected a frame of shape {tuple(size)}, got {got}")
    if camera is not None and reference.camera is not None and not is_same_view(camera, reference.camera):
        raise ValueError(f"reference: expected a frame seen by {camera!r}, got another view")
    if reference.report.spp != spp:
        warnings.warn(
            f"reference: expected a frame of spp {spp}, got one of spp {reference.report.spp}: the error "
            "is also that of edges, which fewer pictures leave rougher",
            RuntimeWarning,
            stacklevel=stacklevel,
        )


class Frame:
    """Pixels of one picture, row 0 at the top, and what they cost.

    Parameters
    ----------
    color : (h, w, 3) float32
        Linear Rec. 709 radiance, the background included where the scene shows it. On a CPU device a view of
        the memory that it was drawn into, not contiguous.
    alpha : (h, w) float32
        Share of the pixel that objects cover, 0..1.
    depth : (h, w) float32, or a function that gives it when it is first asked for
        Distance along the camera's axis; infinite where no object is. Of several pictures, as of `normal`,
        that of the one whose rays pass nearest to the pixels' centres.
    normal : (h, w, 3) float32, or such a function
        World frame, unit length; 0 where no object is.
    report : Report
        Milliseconds per pass, effects and reasons, warnings.
    error_estimate : (h, w) float32 or None
        Where it was asked for: estimated error of every pixel, absolute linear radiance, root mean square
        over the three channels; 0 where no object is. Its own root mean square over the pixels with objects,
        over that of `color` there, predicts the relative RMSE: `estimated_error`.
    display : (h, w, 4) uint8 or None
        Of a frame rendered with ``output="display"``: 8-bit sRGB, and coverage as 0..255. Such a frame has
        neither `color` nor `alpha`: asking for them is a ValueError.
    camera : Camera or None
        That it was seen by; None where it is not known.
    position : (h, w, 3) float64, a function that gives it when it is first asked for, or None
        World frame, where the pixels' rays meet objects; NaN where no object is. As `depth`, of one picture.
    """

    def __init__(
        self,
        color: FloatArray | None,
        alpha: FloatArray | None,
        depth: FloatArray | Callable[[], FloatArray],
        normal: FloatArray | Callable[[], FloatArray],
        report: Report,
        error_estimate: FloatArray | None = None,
        display: NDArray[np.uint8] | None = None,
        camera: "Camera | None" = None,
        position: NDArray[np.float64] | Callable[[], NDArray[np.float64]] | None = None,
    ) -> None:
        self._color = color
        self._alpha = alpha
        self._depth = depth
        self._normal = normal
        self.report = report
        self.error_estimate = error_estimate
        self._display = display
        self.camera = camera
        self._position = position

    @property
    def color(self) -> FloatArray:
        """Linear radiance, (h, w, 3) float32. Raises ValueError for a frame of display output."""
        if self._color is None:
            raise ValueError('color: expected a frame rendered with output="linear", got one of "display"')
        return self._color

    @property
    def alpha(self) -> FloatArray:
        """Share covered by objects, (h, w) float32. Raises ValueError for a frame of display output."""
        if self._alpha is None:
            raise ValueError('alpha: expected a frame rendered with output="linear", got one of "display"')
        return self._alpha

    @property
    def display(self) -> NDArray[np.uint8]:
        """8-bit sRGB and coverage, (h, w, 4) uint8. Raises ValueError for a frame of linear output."""
        if self._display is None:
            raise ValueError('display: expected a frame rendered with output="display", got one of "linear"')
        return self._display

    @property
    def depth(self) -> FloatArray:
        """Distance along the camera's axis, (h, w) float32; infinite where no object is."""
        if callable(self._depth):
            self._depth = self._depth()
        return self._depth

    @property
    def normal(self) -> FloatArray:
        """Shading normals in the world frame, (h, w, 3) float32; 0 where no object is."""
        if callable(self._normal):
            self._normal = self._normal()
        return self._normal

    @property
    def position(self) -> NDArray[np.float64]:
        """Where the pixels' rays meet objects, world frame, (h, w, 3) float64; NaN where no object is.

        Raises ValueError for a frame that was made without it.
        """
        if self._position is None:
            raise ValueError("position: expected a frame that burnish rendered, got one made without it")
        if callable(self._position):
            self._position = self._position()
        return self._position

    def __repr__(self) -> str:
        height, width = (self.color if self._display is None else self._display).shape[:2]
        return f"Frame({width}x{height}, {self.report.total_ms:.1f} ms)"

    def save(self, path: str | os.PathLike[str], exposure: float = 0.0) -> None:
        """Write the picture.

        Parameters
        ----------
        path : path
            ``.exr``: float32 linear radiance and coverage (R, G, B, A), depth (Z), normals (N.X, N.Y, N.Z),
            the error estimate where there is one (error.Y), and the report as JSON in the header attribute
            ``burnish``. ``.png``: 8-bit sRGB, clipped, without alpha; all that a frame of display output has.
        exposure : float
            Stops, for ``.png`` only: radiance is multiplied by 2**exposure. OpenEXR files keep the radiance.
            0 for display output, which has its exposure already.

        Raises
        ------
        ValueError
            If the name ends otherwise, or the frame of display output cannot give what is asked for.
        FileError
            If the file cannot be written.
        """
        from burnish import images

        suffix = Path(path).suffix.lower()
        if suffix == ".exr":
            channels = {"RGB": self.color, "A": self.alpha, "Z": self.depth}
            channels |= {f"N.{axis}": self.normal[..., i] for i, axis in enumerate("XYZ")}
            if self.error_estimate is not None:
                channels["error.Y"] = self.error_estimate
            images.write_exr(path, channels, metadata={"burnish": self.report.to_json(indent=None)})
        elif suffix == ".png":
            if self._display is not None and exposure != 0:
                raise ValueError(f"exposure: expected 0 for a frame of display output, got {exposure!r}")
            pixels = self.color if self._display is None else self._display[..., :3]
            images.write_png(path, pixels, exposure=exposure)
        else:
            raise ValueError(f"path: expected a name ending in .exr or .png, got {os.fspath(path)!r}")

    def error(self, reference: "Frame") -> float:
        """Measure how far this picture is from another one of the same view.

        The `relative_rmse` of linear radiance where the reference shows objects (alpha > 0). The background
        is left out: no sampler touches it.

        Parameters
        ----------
        reference : Frame
            Same size and camera; usually rendered with ``Reference()``, and of the same `spp`: then the error
            is the sampler's. Against a truth of more pictures it is also that of edges and of all else that
            varies within a pixel, which may be what is asked for; hence a warning and no refusal.

        Returns
        -------
        error : float
            0 when equal; NaN when the reference shows no object, or only black ones.

        Warns
        -----
        RuntimeWarning
            If the two average unlike numbers of pictures.

        Raises
        ------
        ValueError
            If the reference has another size or camera.
        """
        require_comparable(reference, self.color.shape[:2], self.camera, self.report.spp)
        covered = reference.alpha > 0
        return relative_rmse(self.color[covered], reference.color[covered])

    def estimated_error(self) -> float:
        """Predict the relative RMSE where objects are from `error_estimate`, without a reference.

        Returns
        -------
        error : float
            As `error` would measure it, roughly; NaN where no object is lit.

        Raises
        ------
        ValueError
            If the frame was rendered without ``error_estimate=True``.
        """
        if self.error_estimate is None:
            raise ValueError("error_estimate: expected a frame rendered with error_estimate=True, got None")
        covered = self.alpha > 0
        energy = float(np.sum(np.square(self.color[covered], dtype=np.float64)))
        if energy == 0.0:
            return float("nan")
        square = 3.0 * float(np.sum(np.square(self.error_estimate[covered], dtype=np.float64)))
        return math.sqrt(square / energy)
