"""Table 1 and Fig. 7: what pyramids and frames take."""

from collections.abc import Mapping
from functools import partial
from typing import Any

from burnish import _core
from burnish.samplers import sampler_from_text
from burnish.study.measure import Step, largest_count
from burnish.study.paper.scenes import glossy, wall_camera, wall_scene
from burnish.study.paper.settings import FILTERS, SHARES, PaperSettings
from burnish.study.subject import SceneSubject, Shot
from burnish.study.timing import AlternatingRuns, Timing

WALL_ROUGHNESS = (0.1, 0.1)


def _numbers(timing: Timing) -> dict[str, Any]:
    return {"ms": timing.median_ms, "deviation_ms": timing.deviation_ms, "runs": timing.runs}


def measure_pyramids(
    environments: Mapping[int, _core.Environment], settings: PaperSettings, device: _core.Device, step: Step
) -> list[dict[str, Any]]:
    """Time the making of pyramids; one row for each size and filter.

    Parameters
    ----------
    environments : mapping
        By face size.
    settings : PaperSettings
        Repeats.
    device : Device
        Makes them.
    step : callable
        Called after each pyramid.
    """
    rows = []
    for size, environment in environments.items():

        def build(name: str, environment: _core.Environment = environment) -> Mapping[str, float]:
            # Without the upload of the map, which no filter changes.
            return {"ms": dict(_core.pyramid_times(device, environment, name))["pyramid"]}

        def after(name: str, size: int = size) -> None:
            step(1, f"pyramid {size} {name}")

        runs = AlternatingRuns({name: partial(build, name) for name in FILTERS})
        for name in FILTERS:
            build(name)
            after(name)
        for _ in range(settings.repeats):
            runs.run_round(after)
        timings = runs.timings()
        rows += [{"face_size": size, "filter": name, **_numbers(timings[name]["ms"])} for name in FILTERS]
    return rows


def frame_samplers(settings: PaperSettings) -> list[tuple[str, str]]:
    """List role and text of the samplers whose frames are timed."""
    samplers = []
    for count in settings.frame_samples:
        samplers += [("published", f"regular:{count}:published"), ("importance", f"importance:{count}")]
        samplers += [("matched", f"matched:{count}")] if hasattr(_core, "Matched") else []
    return samplers + ([("prefiltered", "prefiltered")] if hasattr(_core, "Prefiltered") else [])


def frame_steps(settings: PaperSettings) -> int:
    """Count the frames that `measure_frames` draws."""
    return len(SHARES) * len(frame_samplers(settings)) * (1 + settings.repeats)


def measure_frames(
    environment: _core.Environment, settings: PaperSettings, device: _core.Device, step: Step
) -> list[dict[str, Any]]:
    """Time whole frames; one row for each sampler, count and share of the screen.

    Parameters
    ----------
    environment : Environment
        The light.
    settings : PaperSettings
        Size, counts and repeats.
    device : Device
        Draws.
    step : callable
        Called after each frame.
    """
    subjects: dict[tuple[float, str], SceneSubject] = {}
    shots: dict[tuple[float, str], Shot] = {}
    samplers = frame_samplers(settings)
    made = {text: sampler_from_text(text) for _, text in samplers}
    for share in SHARES:
        scene = wall_scene(share, settings.frame_size, glossy(WALL_ROUGHNESS), environment)
        subject = SceneSubject(scene, wall_camera(), settings.frame_size, device=device)
        for text in made:
            subjects[share, text] = subject
            shots[share, text] = subject.draw(made[text])
            step(1, f"{share:.0%} {text}")

    def run(key: tuple[float, str]) -> Mapping[str, float]:
        return subjects[key].draw(made[key[1]]).times

    runs = AlternatingRuns({key: partial(run, key) for key in subjects})
    for _ in range(settings.repeats):
        runs.run_round(lambda key: step(1, f"{key[0]:.0%} {key[1]}"))
    timings = runs.timings()
    return [
        {
            "role": role,
            "sampler": text,
            "samples": largest_count(shots[share, text].samples_used),
            "share": share,
            "covered": float(shots[share, text].covered.mean()),
            "frame": _numbers(timings[share, text]["frame_ms"]),
            "shade": _numbers(timings[share, text]["shade_ms"]),
        }
        for share in SHARES
        for role, text in samplers
    ]
