"""``burnish advise``: what it takes, its help, and what it does."""

import argparse

ADVISE_HELP = "say which sampler and count meet an error, at what price"

ADVISE_DESCRIPTION = """\
Find the cheapest sampler and count whose error stays below a target, before the large picture is rendered.

Errors are first predicted by a model (lobes, angles, contrast of the environment), then measured on a small
picture of this very scene for the few candidates that matter. Prices are predicted from rates of this device,
which are measured when they are first needed and kept in the cache folder; --measure-again takes them anew.

The error is the relative RMSE of linear radiance where objects are. The table shows the candidates around the
choice, those that were measured, and the best of every other sampler; "Pareto" marks what nothing else beats.
"""

ADVISE_EXAMPLES = """\
examples:
  burnish advise sphere --env spots --target-error 0.02
  burnish advise model.glb --env world.exr --target-error 0.01 --size 1080x1920 --verify
  burnish advise spheres --env sky --target-error 0.05 --no-probe

The same --target-error makes "burnish render" render with what is advised.
"""

TARGET_HELP = "relative RMSE of linear radiance where objects are: 0.02 is 2 %%"


def parse_target(text: str) -> float:
    """Read an error such as ``0.02``."""
    try:
        value = float(text.removesuffix("%")) / (100.0 if text.endswith("%") else 1.0)
    except ValueError:
        value = 0.0
    if not 1e-4 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"expected an error such as 0.02 or 2%, in 0.0001..1, got {text!r}")
    return value


def add_advise_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare what only this command takes; scene and light are declared by the caller.

    Parameters
    ----------
    parser : ArgumentParser
        Of the subcommand.
    """
    from burnish._cli_arguments import parse_size

    parser.description = ADVISE_DESCRIPTION
    parser.add_argument(
        "--target-error", type=parse_target, default=0.02, metavar="E", help=f"{TARGET_HELP} (default: 0.02)"
    )
    parser.add_argument(
        "--size", type=parse_size, default=(540, 960), metavar="HxW", help="height x width (default: 540x960)"
    )
    parser.add_argument("--camera", metavar="NAME|INDEX", help="a camera of the scene (default: the first)")
    parser.add_argument("--device", metavar="NAME", help="part of a Vulkan device's name (default: the best)")
    parser.add_argument(
        "--no-probe",
        action="store_true",
        help="rely on the model alone: quicker, and off by up to a factor of three",
    )
    parser.add_argument(
        "--verify", action="store_true", help="measure the error really reached, on a picture of reduced size"
    )
    parser.add_argument("--measure-again", action="store_true", help="take the prices of this device anew")
    parser.add_argument("--report", metavar="FILE", help="write the advice as JSON")


def run_advise(options: argparse.Namespace) -> int:
    """``burnish advise``: 0 where a sampler meets the target, 1 where none is predicted to."""
    import json
    from pathlib import Path

    from burnish import Device
    from burnish._device import default_device
    from burnish._progress import progress_bar
    from burnish.advice import advise
    from burnish.advice.cost_model import CostModel
    from burnish.cli import find_camera, prepare_scene
    from burnish.images.files import write_text

    if options.report and not Path(options.report).parent.is_dir():
        raise ValueError(f"{options.report}: expected an existing folder, got {Path(options.report).parent}")
    device = Device(name=options.device) if options.device else default_device()
    scene = prepare_scene(options)
    camera = find_camera(scene, options.camera)
    if options.measure_again:
        CostModel(device).forget()
    with progress_bar("advice") as advance:
        advice = advise(
            scene,
            options.target_error,
            options.size,
            camera,
            options.filter,
            device,
            probe=not options.no_probe,
            verify=options.verify,
            progress=advance,
        )
    print(advice)
    if options.report:
        write_text(options.report, json.dumps(advice.to_dict(), indent=2) + "\n")
        print(f"wrote {options.report}")
    return 0 if advice.meets_target else 1
