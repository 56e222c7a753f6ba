"""The inverse question: the cheapest sampler and count that meet an error, and how sure that is."""

import math
import time

import numpy as np

from burnish import _core, rendering
from burnish._device import default_device
from burnish.advice.advice import Advice
from burnish.advice.contrast import measure_spectrum
from burnish.advice.cost_model import CostModel, traits_of_class
from burnish.advice.error_model import ErrorModel, diffuse_share_of, lobes_of
from burnish.advice.families import FAMILIES, sampler_text
from burnish.advice.frame_cost import FrameCost, equal_shares, learn_frame_cost
from burnish.advice.last_resort import predict_reference, with_last_resort
from burnish.advice.probe import COVERED_PIXELS, MOST_TERMS, Probe
from burnish.advice.search import Candidate, find_cheapest
from burnish.rendering import Filter, Progress

SMALLEST_TARGET, LARGEST_TARGET = 1e-4, 1.0
VERIFY_FACTOR = 4
"""Covered pixels of the picture that verifies, in those of the probe."""


def require_target(target_error: float) -> None:
    """Raise ValueError unless it is a relative error that can be asked for."""
    is_number = isinstance(target_error, int | float | np.number) and not isinstance(target_error, bool)
    if not is_number or not SMALLEST_TARGET <= target_error <= LARGEST_TARGET:
        raise ValueError(
            f"target_error: expected a relative error in {SMALLEST_TARGET:g}..{LARGEST_TARGET:g}, "
            f"got {target_error!r}"
        )


def predict_errors(scene: _core.Scene, model: ErrorModel | None = None) -> dict[tuple[str, int], float]:
    """Predict the error of every family and count from the scene's materials and environments, by the model.

    Parameters
    ----------
    scene : Scene
        Its objects count alike; one that reflects a map of its own sees that one.
    model : ErrorModel or None
        None: the committed one.

    Returns
    -------
    errors : dict
        Relative RMSE by family and count.
    """
    model = model or ErrorModel()
    parts: dict[int, tuple[_core.Environment, list[_core.Material]]] = {}
    for one in scene.objects:
        environment = one.reflects or scene.environment
        if environment is not None:
            material = scene.materials[one.material]
            parts.setdefault(id(environment), (environment, []))[1].append(material)
    lit = [
        (
            measure_spectrum(environment),
            [lobe for one in materials for lobe in lobes_of(one)],
            [diffuse_share_of(one) for one in materials],
        )
        for environment, materials in parts.values()
    ]
    count = sum(len(diffuse) for *_, diffuse in lit)

    def predict(family: str, n: int) -> float:
        squares = 0.0
        for spectrum, lobes, diffuse in lit:
            error = model.predict(family, n, lobes, spectrum, diffuse_shares=diffuse)
            squares += len(diffuse) / count * error**2
        return math.sqrt(squares)

    return {(family, n): predict(family, n) for family, settings in FAMILIES.items() for n in settings.counts}


def price_candidates(errors: dict[tuple[str, int], float], price: FrameCost) -> list[Candidate]:
    """Put predicted errors and prices together.

    Parameters
    ----------
    errors : dict
        As `predict_errors` gives them.
    price : FrameCost
        Of the picture.
    """
    return [
        Candidate(sampler_text(family, n), family, n, error, price.frame_ms(family, n))
        for (family, n), error in errors.items()
    ]


def measure_reached(
    scene: _core.Scene,
    camera: _core.Camera | None,
    size: tuple[int, int],
    filter: Filter,
    device: _core.Device,
    sampler: str,
) -> float:
    """Measure an error on a picture of more pixels than the one that chose it.

    Parameters
    ----------
    scene, camera, size, filter, device
        As for `Probe`.
    sampler : str
        As text.
    """
    judge = Probe(
        scene, camera, size, filter, device, VERIFY_FACTOR * COVERED_PIXELS, VERIFY_FACTOR * MOST_TERMS
    )
    judge.survey(sampler)
    return judge.error(sampler)


def advise(
    scene: _core.Scene,
    target_error: float = 0.02,
    size: tuple[int, int] = (540, 960),
    camera: _core.Camera | None = None,
    filter: Filter = "gauss6",
    device: _core.Device | None = None,
    probe: bool = True,
    verify: bool = False,
    progress: Progress | None = None,
) -> Advice:
    """Find the cheapest sampler and count that meet an error.

    Errors are first predicted by a model (lobes, angles, and the contrast of the environment at the scale of
    the lookups; its coefficients come from studies), then measured on a small picture of the scene itself,
    for the few candidates that matter, which corrects the model for the others. Prices come from rates
    measured on this device, which are kept in the user's cache folder.

    Parameters
    ----------
    scene : Scene
        Objects, materials and the environment that lights them. While the small picture's truth is drawn it
        holds reduced maps; no other thread may use it then.
    target_error : float
        Relative RMSE of linear radiance where objects are, as `Frame.error` measures it: .02 is 2 %.
    size : (height, width)
        Of the picture that is to be priced.
    camera : Camera or None
        None: the scene's first, or one that sees all of it.
    filter : "box", "gauss4" or "gauss6"
        Reduction filter of the environment's pyramid.
    device : Device or None
        None: the best one, opened once.
    probe : bool
        False: rely on the model alone, which may be off by a factor of three (docs/targets.md).
    verify : bool
        Also measure the error that the choice really reaches: on a larger picture, four times the probe's
        pixels, against its own truth.
    progress : callable or None
        Called with the share done, 0..1, and the step's name; an exception that it raises stops the work.

    Returns
    -------
    advice : Advice
        ``advice.sampler`` is what to render with; ``print(advice)`` shows why.

    Raises
    ------
    ValueError
        If an argument is out of its range.
    """
    require_target(target_error)
    rendering.require_filter(filter)
    size = rendering.require_size(size)
    began = time.perf_counter()
    device = device or default_device()
    advance = progress or (lambda share, step: None)
    if camera is None and scene.cameras:
        camera = scene.cameras[0]

    advance(0.0, "contrast of the environment")
    errors = predict_errors(scene)
    advance(0.1, "prices on this device")
    costs = CostModel(device)
    traits = [traits_of_class(one["values"]) for one in rendering.plan(scene, _core.Matched())["classes"]]
    guess = price_candidates(errors, equal_shares(costs, traits, size[0] * size[1]))
    favourite = find_cheapest(guess, target_error).chosen
    small = Probe(scene, camera, size, filter, device)
    survey = small.survey(favourite.sampler)
    price = learn_frame_cost(costs, survey, favourite.family, favourite.count, size)
    candidates = price_candidates(errors, price)

    is_lit = bool(np.any(survey.color[survey.alpha > 0]))
    notes = [] if is_lit else ["nothing that is lit is seen: every sampler does"]
    done = [0]

    def measure(sampler: str) -> float:
        done[0] += 1
        advance(1.0 - 0.8 * 0.8 ** done[0], f"{sampler} on a small picture")
        return small.error(sampler)

    choice = find_cheapest(candidates, target_error, measure if probe and is_lit else None)
    chosen, meets_target = choice.chosen, choice.meets_target
    if probe and is_lit:
        height, width = small.size
        notes.append(f"measured on {width} x {height} pixels against {small.truth_text}")
        if not meets_target:
            advance(0.95, "the reference on a small picture")
            last = predict_reference(small, target_error, size[0] * size[1])
            chosen, is_reference = with_last_resort(choice.candidates, chosen, last)
            meets_target = is_reference and last.predicted_error <= target_error
    reached = None
    if verify and is_lit:
        advance(0.97, "the error really reached")
        reached = measure_reached(scene, camera, size, filter, device, chosen.sampler)
    advance(1.0, "advice")
    return Advice(
        float(target_error),
        size,
        device.name,
        choice.candidates,
        chosen,
        meets_target,
        notes,
        1e3 * (time.perf_counter() - began),
        reached,
    )
