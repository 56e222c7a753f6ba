"""The command line: ``burnish render``, ``explain``, ``advise``, ``study`` and ``doctor``."""

import argparse
import os
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from burnish._cli_advise import run_advise
from burnish._cli_arguments import DEFAULT_SAMPLER, make_parser, parse_sampler
from burnish._cli_study import run_study
from burnish._extension import load_failure
from burnish._progress import progress_bar

if TYPE_CHECKING:
    from burnish import Camera, Device, Environment, Frame, Scene
    from burnish.rendering import Sampler


def load_scene(name: str) -> "Scene":
    """Load a glTF file, or make the built-in scene of that name."""
    from burnish import Scene, builtin

    if name in builtin.SCENES:
        return builtin.make_scene(name)
    if Path(name).suffix == "" and not Path(name).exists():
        raise ValueError(f"SCENE: expected a file or one of {', '.join(builtin.SCENES)}, got {name!r}")
    with progress_bar(f"loading {Path(name).name}"):
        return Scene.from_file(name)


def load_environment(
    name: str,
    face_size: int | None,
    rotation_degrees: float,
    part: str | None = None,
    layer: str | None = None,
) -> "Environment":
    """Load an environment file, or make the built-in environment of that name, turned about the y axis."""
    from burnish import Environment, builtin

    if name in builtin.ENVIRONMENTS:
        if part is not None or layer is not None:
            raise ValueError(f"--env-part, --env-layer: expected a file as --env beside them, got {name!r}")
        environment = builtin.make_environment(name, face_size or 256)
    elif Path(name).suffix == "" and not Path(name).exists():
        raise ValueError(f"--env: expected a file or one of {', '.join(builtin.ENVIRONMENTS)}, got {name!r}")
    else:
        with progress_bar(f"loading {Path(name).name}"):
            environment = Environment.from_file(name, face_size=face_size, part=part, layer=layer)
    if rotation_degrees:
        environment.rotation = rotation_degrees
    return environment


def find_camera(scene: "Scene", key: str | None) -> "Camera | None":
    """Find a camera by name, or by index where no name fits; None for no key."""
    if key is None:
        return None
    cameras = scene.cameras
    for camera in cameras:
        if camera.name == key:
            return camera
    if key.isdecimal() and int(key) < len(cameras):
        return cameras[int(key)]
    names = ", ".join(f"{i} ({camera.name or 'no name'})" for i, camera in enumerate(cameras))
    raise ValueError(f"--camera: expected one of {names or 'none: the scene has no camera'}, got {key!r}")


def prepare_scene(options: argparse.Namespace) -> "Scene":
    """Load the scene and the environment that the arguments name."""
    scene = load_scene(options.scene)
    scene.environment = load_environment(
        options.env, options.face_size, options.rotate_env, options.env_part, options.env_layer
    )
    if options.no_background:
        scene.show_background = False
    return scene


def _require_outputs(options: argparse.Namespace) -> None:
    """Find out before the work that a file could not be written."""
    for path in [*map(Path, options.output), *([Path(options.report)] if options.report else [])]:
        if not path.parent.is_dir():
            raise ValueError(f"{path}: expected an existing folder, got {path.parent}")
    for name in options.output:
        if Path(name).suffix.lower() not in (".exr", ".png"):
            raise ValueError(f"--output: expected a name ending in .exr or .png, got {name!r}")


def run_render(options: argparse.Namespace) -> int:
    """``burnish render``."""
    from burnish import Device, Reference, render

    _require_outputs(options)
    if options.target_error is not None and options.sampler is not None:
        raise ValueError("--target-error: expected no --sampler beside it, it chooses one")
    if options.verify and options.target_error is None:
        raise ValueError("--verify: expected a --target-error beside it")
    sampler = None if options.target_error is not None else parse_sampler(options.sampler or DEFAULT_SAMPLER)
    device = Device(name=options.device) if options.device else None
    scene = prepare_scene(options)
    camera = find_camera(scene, options.camera)

    def draw(what: str, sampler: "Sampler | None", **extras: Any) -> "Frame":
        view = (scene, camera, options.size, sampler, device, options.spp, options.filter)
        with progress_bar(what) as advance:
            return render(*view, progress=advance, **extras)

    frame = draw(
        "rendering",
        sampler,
        target_error=options.target_error,
        verify=options.verify,
        error_estimate=options.error_estimate,
        strict=options.strict,
    )
    for name in options.output:
        frame.save(name, exposure=options.exposure)
    if options.report:
        frame.report.save(options.report)
    if not options.quiet:
        print(frame.report)
    if options.error_estimate and not options.quiet:
        estimate = frame.estimated_error()
        print(f"estimated error: {estimate:.5f} relative RMSE, linear radiance, where objects are")
    if options.compare:
        reference = draw("reference", Reference())
        error = frame.error(reference)
        print(f"error against the reference: {error:.5f} relative RMSE, linear radiance, where objects are")
        print(f"the reference's own standard error: {reference.report.standard_error:.5f}")
    if not options.quiet:
        for name in [*options.output, *([options.report] if options.report else [])]:
            print(f"wrote {name}")
    return 0


def _device_at_hand() -> "Device | None":
    """Open the device that would be taken; none where there is none."""
    from burnish import Device, VulkanError

    try:
        return Device()
    except VulkanError:
        return None


def format_plan(plan: dict[str, Any]) -> str:
    """Lay out a plan: passes, effects on and off, pipelines, each with its reason."""

    def lines(title: str, rows: list[tuple[str, str]]) -> list[str]:
        width = max((len(name) for name, _ in rows), default=0)
        return [f"{title}:", *(f"  {name:<{width}}  {reason}" for name, reason in rows)] if rows else []

    effects = plan["effects"]
    classes = [
        (f"{', '.join(entry['effects']) or 'plain'}; {entry['table']}", entry["reason"])
        for entry in plan["classes"]
    ]
    blocks = [
        lines("passes", [(entry["name"], entry["reason"]) for entry in plan["passes"]]),
        lines("on", [(entry["name"], entry["reason"]) for entry in effects if entry["on"]]),
        lines("off", [(entry["name"], entry["reason"]) for entry in effects if not entry["on"]]),
        lines("shade pipelines", classes),
        [f"warning: {warning}" for warning in plan["warnings"]],
    ]
    return "\n\n".join("\n".join(block) for block in blocks if block)


def run_explain(options: argparse.Namespace) -> int:
    """``burnish explain``."""
    from burnish.rendering import plan

    sampler = parse_sampler(options.sampler or DEFAULT_SAMPLER)
    scene, device = prepare_scene(options), _device_at_hand()
    print(format_plan(plan(scene, sampler, options.spp, options.filter, device=device)))
    return 0


def run_doctor(options: argparse.Namespace) -> int:
    """``burnish doctor``: 0 when this machine can render, else 1."""
    from burnish.doctor import examine

    if (options.output or options.lookup) and not options.hard_cases:
        raise ValueError("--hard-cases: expected it beside --output and --lookup")
    path = Path(options.output) if options.output else None
    if path is not None and not path.parent.is_dir():
        raise ValueError(f"{path}: expected an existing folder, got {path.parent}")
    wanted = (options.lookup or "auto") if options.hard_cases else ""
    with progress_bar("hard cases") as advance:
        report = examine(options.device or "", hard_cases=wanted, progress=advance)
    print(report)
    if path is not None and report.hard_cases:
        from burnish.hardcases import CASES, page
        from burnish.images.files import write_text

        write_text(path, page(report.hard_cases, CASES))
        print(f"wrote {path}")
    return 0 if report.can_render else 1


COMMANDS = {
    "render": run_render,
    "explain": run_explain,
    "advise": run_advise,
    "study": run_study,
    "doctor": run_doctor,
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : sequence of str or None
        None: those of the process.

    Returns
    -------
    code : int
        0 done; 1 this machine cannot render (doctor), or no sampler meets the error (advise); 2 an error, in
        one line on stderr; 130 interrupted.
    """
    given = sys.argv[1:] if arguments is None else list(arguments)
    options = make_parser().parse_args(given)
    options.command_line = shlex.join(["burnish", *given])  # what is written says how it was made
    try:
        reason = load_failure()
        if reason is not None and options.command != "doctor":
            raise ImportError(reason)
        code: int = COMMANDS[options.command](options)
        return code
    except KeyboardInterrupt:
        print(f"burnish {options.command}: interrupted", file=sys.stderr)
        return 130
    except BrokenPipeError:
        # The reader, such as head, has seen enough. What is still buffered must not raise again at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    except (ValueError, OSError, RuntimeError, ImportError, MemoryError, FloatingPointError) as error:
        text = " ".join(str(error).split()) or type(error).__name__
        print(f"burnish {options.command}: error: {text}", file=sys.stderr)
        return 2
