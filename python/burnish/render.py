"""Pictures that are asked for by their error, and pictures that estimate it."""

import warnings

from burnish import _core
from burnish.advice.advise import advise
from burnish.advice.error_estimate import companion, estimate_frame_errors
from burnish.frame import Frame
from burnish.rendering import (
    Filter,
    Output,
    Progress,
    draw,
    require_filter,
    require_size,
    require_spp,
    view_of,
)
from burnish.samplers import Sampler


def render(
    scene: _core.Scene,
    camera: _core.Camera | None = None,
    size: tuple[int, int] = (540, 960),
    sampler: Sampler | None = None,
    device: _core.Device | None = None,
    spp: int = 1,
    filter: Filter = "gauss6",
    progress: Progress | None = None,
    target_error: float | None = None,
    verify: bool = False,
    error_estimate: bool = False,
    strict: bool = False,
    output: Output = "linear",
    display_exposure: float = 0.0,
) -> Frame:
    """Render one frame.

    Parameters
    ----------
    scene : Scene
        Objects, materials and the environment that lights them.
    camera : Camera or None
        None: the scene's first camera, or one that sees all of it.
    size : (height, width)
        Pixels, 1..16384 each.
    sampler : Regular, Importance, Matched, Prefiltered, Reference or None
        None: ``Matched()``, 14 samples.
    device : Device or None
        None: the best one, opened once.
    spp : int
        Jittered frames that are accumulated, 1..65536: the mean over a filter 3 pixels wide around the
        pixel's centre, which one frame looks at.
    filter : "box", "gauss4" or "gauss6"
        Reduction filter of the environment's pyramid.
    progress : callable or None
        Called with the share done, 0..1, and the step's name; an exception that it raises stops the frame.
        With a target the shares of the advice come first.
    target_error : float or None
        Relative RMSE of linear radiance where objects are: the cheapest sampler and count that are predicted
        to meet it are taken, as `burnish.advise` finds them, and ``frame.report.prediction`` says which,
        why, and at what price. Then `sampler` must be None.
    verify : bool
        Also measure the error that the chosen sampler really reaches, against a reference on a picture of
        reduced size; it is in the prediction. Only with a target.
    error_estimate : bool
        Also estimate the error of every pixel, without a reference: ``frame.error_estimate``. It takes a
        second frame of fewer samples.
    strict : bool
        Raise where a value was not finite, instead of a black pixel and a line in the report.
    output : "linear" or "display"
        "display": the device stores 8-bit sRGB with coverage, ``frame.display``, as
        `images.display_image` makes it of linear radiance, within one code; no linear picture is made.
    display_exposure : float
        Stops, -64..64, with "display" only: radiance is multiplied by 2**display_exposure.

    Returns
    -------
    frame : Frame
        Linear radiance and coverage, or pixels for a display; depth and normals, and the report that prices
        them.

    Warns
    -----
    RuntimeWarning
        If no sampler is predicted to meet the target; the closest is taken.

    Raises
    ------
    ValueError
        If an argument or the scene is out of its documented range.
    FloatingPointError
        If `strict` and a value was not finite; it says how many, where, and in which pass.
    VulkanError
        If no device can do it.
    """
    require_filter(filter)
    require_spp(spp)
    size = require_size(size)
    if target_error is not None and sampler is not None:
        raise ValueError(f"sampler: expected None beside a target_error, got {sampler!r}")
    if verify and target_error is None:
        raise ValueError("verify: expected a target_error beside it, got None")
    if error_estimate and output == "display":
        raise ValueError("error_estimate: expected False beside display output (no radiance), got True")
    camera = view_of(scene, camera)
    prediction = None
    if target_error is not None:
        advice = advise(scene, target_error, size, camera, filter, device, verify=verify, progress=progress)
        sampler, prediction = advice.sampler, advice.to_dict()
        if advice.warning is not None:
            warnings.warn(advice.warning, RuntimeWarning, stacklevel=2)
    sampler = _core.Matched() if sampler is None else sampler
    if error_estimate:
        companion(sampler)  # refuses a sampler that has none before any work is done
    view = (scene, camera, size)
    how = (device, spp, filter)
    frame = draw(*view, sampler, *how, progress, strict, output, display_exposure)
    if prediction is not None:
        frame.report = frame.report.with_prediction(prediction)
    if error_estimate:
        frame.error_estimate = estimate_frame_errors(
            frame, sampler, lambda other: draw(*view, other, *how, strict=strict).color
        )
    return frame
