"""``burnish render``: a picture, and what it cost."""

import argparse
from pathlib import Path
from typing import Any

from burnish._progress import progress_bar
from burnish.cli.arguments import TARGET_HELP, add_scene_arguments, add_view_arguments, parse_target

HELP = "render a scene and print what the picture cost"
EXAMPLES = """\
examples:
  burnish render spheres -o spheres.png
  burnish render model.glb --env world.exr --size 1080x1920 --spp 4 -o out.exr -o out.png
  burnish render model.glb --env sky --rotate-env 90 --sampler importance:30:fibonacci -o out.png
  burnish render spheres --env sky --target-error 0.02 --verify --error-estimate -o out.exr
  burnish render shaderball --sampler regular:30 --compare --report out.json -o out.exr
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Parameters
    ----------
    parser : ArgumentParser
        Of the subcommand.
    """
    add_scene_arguments(parser)
    parser.add_argument(
        "-o", "--output", metavar="FILE", action="append", default=[], help=".exr or .png; may be given again"
    )
    add_view_arguments(parser)
    parser.add_argument("--exposure", type=float, default=0.0, metavar="STOPS", help="for .png (default: 0)")
    parser.add_argument("--report", metavar="FILE", help="write the report as JSON")
    parser.add_argument(
        "--target-error",
        type=parse_target,
        metavar="E",
        help=f"take the cheapest sampler that is predicted to meet it, in place of --sampler: {TARGET_HELP}",
    )
    parser.add_argument(
        "--verify", action="store_true", help="with --target-error: also measure the error really reached"
    )
    parser.add_argument(
        "--error-estimate", action="store_true", help="estimate every pixel's error; channel error.Y of .exr"
    )
    parser.add_argument(
        "--strict", action="store_true", help="fail where a value is not finite, instead of a black pixel"
    )
    parser.add_argument("--compare", action="store_true", help="also render the reference, print the error")
    parser.add_argument("-q", "--quiet", action="store_true", help="do not print the report")


def _require_outputs(options: argparse.Namespace) -> None:
    """Find out before the work that a file could not be written."""
    for path in [*map(Path, options.output), *([Path(options.report)] if options.report else [])]:
        if not path.parent.is_dir():
            raise ValueError(f"{path}: expected an existing folder, got {path.parent}")
    for name in options.output:
        if Path(name).suffix.lower() not in (".exr", ".png"):
            raise ValueError(f"--output: expected a name ending in .exr or .png, got {name!r}")


def run(options: argparse.Namespace) -> int:
    """Render, save, and print what it cost; 0 when it is done.

    Parameters
    ----------
    options : Namespace
        As `add_arguments` declares them.
    """
    from burnish import Device, Frame, Reference, render
    from burnish.cli.inputs import prepare_scene
    from burnish.samplers import DEFAULT_SAMPLER, Sampler, sampler_from_text
    from burnish.scenes import find_camera

    _require_outputs(options)
    if options.target_error is not None and options.sampler is not None:
        raise ValueError("--target-error: expected no --sampler beside it, it chooses one")
    if options.verify and options.target_error is None:
        raise ValueError("--verify: expected a --target-error beside it")
    sampler = None
    if options.target_error is None:
        sampler = sampler_from_text(options.sampler or DEFAULT_SAMPLER, "--sampler")
    device = Device(name=options.device) if options.device else None
    scene = prepare_scene(options)
    camera = find_camera(scene, options.camera)

    def draw(what: str, sampler: Sampler | None, **extras: Any) -> Frame:
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
