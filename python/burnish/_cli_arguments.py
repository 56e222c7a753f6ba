"""What the command line takes, and its help."""

import argparse
from typing import TYPE_CHECKING, NoReturn, cast

from burnish import __version__
from burnish._cli_advise import ADVISE_EXAMPLES, ADVISE_HELP, TARGET_HELP, add_advise_arguments, parse_target
from burnish._cli_study import STUDY_EXAMPLES, STUDY_HELP, add_study_arguments

if TYPE_CHECKING:
    from burnish.rendering import Sampler

RENDER_EXAMPLES = """\
examples:
  burnish render spheres -o spheres.png
  burnish render model.glb --env world.exr --size 1080x1920 --spp 4 -o out.exr -o out.png
  burnish render model.glb --env sky --rotate-env 90 --sampler importance:30:fibonacci -o out.png
  burnish render spheres --env sky --target-error 0.02 --verify --error-estimate -o out.exr
  burnish render shaderball --sampler regular:30 --compare --report out.json -o out.exr
"""
EXPLAIN_EXAMPLES = """\
examples:
  burnish explain model.glb
  burnish explain spheres --sampler reference:0.002 --spp 16
"""
DOCTOR_EXAMPLES = """\
examples:
  burnish doctor
  burnish doctor --device llvmpipe
  burnish doctor --hard-cases --lookup both -o hard-cases.md
"""
DEFAULT_SAMPLER = "matched:14"
SAMPLER_HELP = (
    "matched[:COUNT], regular[:COUNT[:published]], importance[:COUNT[:hammersley|fibonacci]], prefiltered "
    "or reference[:STANDARD_ERROR], and KEY=VALUE for its other parameters, as matched:14:diffuse=harmonics "
    f"(default: {DEFAULT_SAMPLER})"
)
SCENE_HELP = "a .gltf or .glb file, or a built-in scene: sphere, spheres, plane, shaderball"


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message: str) -> NoReturn:
        """Exit with code 2."""
        self.exit(2, f"{self.prog}: error: {message}; see {self.prog} --help\n")


def parse_size(text: str) -> tuple[int, int]:
    """Read ``HEIGHTxWIDTH``."""
    height, _, width = text.lower().partition("x")
    if not (height.isdecimal() and width.isdecimal() and int(height) and int(width)):
        raise argparse.ArgumentTypeError(f"expected HEIGHTxWIDTH such as 1080x1920, got {text!r}")
    return int(height), int(width)


def parse_sampler(text: str) -> "Sampler":
    """Read a sampler such as ``matched:14``, ``importance:30:fibonacci`` or ``reference:0.002``."""
    from burnish import Importance, Matched, Prefiltered, Reference, Regular

    if "=" in text:
        from burnish.study.sampler_text import sampler_from_text

        try:
            return cast("Sampler", sampler_from_text(text))
        except ValueError as error:
            raise ValueError(f"--sampler: {str(error).removeprefix('--sampler: ')}") from error
    name, *options = text.split(":")
    try:
        if name == "regular" and len(options) <= 2:
            count = int(options[0]) if options else 14
            if len(options) < 2:
                return Regular(samples=count)
            if options[1] == "published":
                return Regular(samples=count, footprint="published", normalization="published")
        elif name == "importance" and len(options) <= 2:
            count = int(options[0]) if options else 14
            if len(options) < 2 or options[1] == "hammersley":
                return Importance(samples=count)
            if options[1] == "fibonacci":
                return Importance(samples=count, points="fibonacci")
        elif name == "matched" and len(options) <= 1:
            return Matched(samples=int(options[0])) if options else Matched()
        elif name == "prefiltered" and not options:
            return Prefiltered()
        elif name == "reference" and len(options) <= 1:
            return Reference(standard_error=float(options[0])) if options else Reference()
    except (ValueError, TypeError) as error:
        raise ValueError(f"--sampler: expected {SAMPLER_HELP}, got {text!r}: {error}") from error
    raise ValueError(f"--sampler: expected {SAMPLER_HELP}, got {text!r}")


def _add_scene_arguments(parser: argparse.ArgumentParser, has_sampler: bool = True) -> None:
    parser.add_argument("scene", metavar="SCENE", help=SCENE_HELP)
    parser.add_argument(
        "--env",
        metavar="FILE",
        default="studio",
        help="environment: a picture file, .hdr or .exr, or built-in: studio, sky, spots, uniform "
        "(default: studio)",
    )
    parser.add_argument("--env-part", metavar="NAME|INDEX", help="a part of an .exr file with several")
    parser.add_argument("--env-layer", metavar="NAME", help="a layer of an .exr file: NAME.R, NAME.G, NAME.B")
    if has_sampler:
        parser.add_argument("--sampler", metavar="S", default=None, help=SAMPLER_HELP)
        parser.add_argument(
            "--spp", type=int, default=1, metavar="N", help="frames to accumulate (default: 1)"
        )
    parser.add_argument(
        "--filter",
        choices=("box", "gauss4", "gauss6"),
        default="gauss6",
        help="reduction filter of the environment's pyramid (default: gauss6)",
    )
    parser.add_argument(
        "--rotate-env", type=float, default=0.0, metavar="DEG", help="turn the light about +y"
    )
    parser.add_argument("--face-size", type=int, metavar="N", help="texels along a cube face, a power of two")
    parser.add_argument("--no-background", action="store_true", help="leave black where no object is")


def make_parser() -> argparse.ArgumentParser:
    """Build the parser of all subcommands."""
    parser = Parser(prog="burnish", description="Glossy materials under environment light.")
    parser.add_argument("--version", action="version", version=f"burnish {__version__}")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)

    def command(name: str, help: str, examples: str) -> argparse.ArgumentParser:
        layout = argparse.RawDescriptionHelpFormatter
        return commands.add_parser(name, help=help, description=help, epilog=examples, formatter_class=layout)

    render = command("render", "render a scene and print what the picture cost", RENDER_EXAMPLES)
    _add_scene_arguments(render)
    render.add_argument(
        "-o", "--output", metavar="FILE", action="append", default=[], help=".exr or .png; may be given again"
    )
    render.add_argument(
        "--size", type=parse_size, default=(540, 960), metavar="HxW", help="height x width (default: 540x960)"
    )
    render.add_argument("--camera", metavar="NAME|INDEX", help="a camera of the scene (default: the first)")
    render.add_argument("--device", metavar="NAME", help="part of a Vulkan device's name (default: the best)")
    render.add_argument("--exposure", type=float, default=0.0, metavar="STOPS", help="for .png (default: 0)")
    render.add_argument("--report", metavar="FILE", help="write the report as JSON")
    render.add_argument(
        "--target-error",
        type=parse_target,
        metavar="E",
        help=f"take the cheapest sampler that is predicted to meet it, in place of --sampler: {TARGET_HELP}",
    )
    render.add_argument(
        "--verify", action="store_true", help="with --target-error: also measure the error really reached"
    )
    render.add_argument(
        "--error-estimate", action="store_true", help="estimate every pixel's error; channel error.Y of .exr"
    )
    render.add_argument(
        "--strict", action="store_true", help="fail where a value is not finite, instead of a black pixel"
    )
    render.add_argument("--compare", action="store_true", help="also render the reference, print the error")
    render.add_argument("-q", "--quiet", action="store_true", help="do not print the report")

    explain = command("explain", "print what rendering would do and why, without rendering", EXPLAIN_EXAMPLES)
    _add_scene_arguments(explain)

    advise = command("advise", ADVISE_HELP, ADVISE_EXAMPLES)
    _add_scene_arguments(advise, has_sampler=False)
    add_advise_arguments(advise)

    add_study_arguments(command("study", STUDY_HELP, STUDY_EXAMPLES))

    doctor = command("doctor", "say what is missing here and how to install it", DOCTOR_EXAMPLES)
    doctor.add_argument("--device", metavar="NAME", help="part of a Vulkan device's name (default: the best)")
    doctor.add_argument(
        "--hard-cases",
        action="store_true",
        help="measure the worst inputs against their bounds: takes minutes on a CPU",
    )
    doctor.add_argument(
        "--lookup",
        choices=("auto", "sampler", "software", "both"),
        help="how the hard cases read maps (default: auto)",
    )
    doctor.add_argument(
        "-o", "--output", metavar="FILE", help="also write the table of hard cases as Markdown"
    )
    return parser
