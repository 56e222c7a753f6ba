"""``burnish advise``: the cheapest sampler that meets an error."""

import argparse
import json
from pathlib import Path

from burnish._progress import progress_bar
from burnish.cli.arguments import TARGET_HELP, add_scene_arguments, add_view_arguments, parse_target

HELP = "say which sampler and count meet an error, at what price"

DESCRIPTION = """\
Find the cheapest sampler and count whose error stays below a target, before the large picture is rendered.

Errors are first predicted by a model (lobes, angles, contrast of the environment), then measured on a small
picture of this very scene for the few candidates that matter. Prices are predicted from rates of this device,
which are measured when they are first needed and kept in the cache folder; --measure-again takes them anew.

The error is the relative RMSE of linear radiance where objects are. The table shows the candidates around the
choice, those that were measured, and the best of every other sampler; "Pareto" marks what nothing else beats.
"""

EXAMPLES = """\
examples:
  burnish advise sphere --env spots --target-error 0.02
  burnish advise model.glb --env world.exr --target-error 0.01 --size 1080x1920 --verify
  burnish advise spheres --env sky --target-error 0.05 --no-probe

The same --target-error makes "burnish render" render with what is advised.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Parameters
    ----------
    parser : ArgumentParser
        Of the subcommand.
    """
    add_scene_arguments(parser, has_sampler=False)
    parser.add_argument(
        "--target-error", type=parse_target, default=0.02, metavar="E", help=f"{TARGET_HELP} (default: 0.02)"
    )
    add_view_arguments(parser)
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


def run(options: argparse.Namespace) -> int:
    """Print the advice; 0 where a sampler meets the target, 1 where none is predicted to.

    Parameters
    ----------
    options : Namespace
        As `add_arguments` declares them.
    """
    from burnish._core import Device
    from burnish._device import default_device
    from burnish.advice import advise
    from burnish.advice.cost_model import CostModel
    from burnish.cli.inputs import prepare_scene
    from burnish.images.files import write_text
    from burnish.scenes import find_camera

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
