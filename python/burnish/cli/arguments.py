"""Arguments that several commands take."""

import argparse
from typing import NoReturn

from burnish._extension import load_failure
from burnish.filters import FILTERS

SCENE_HELP = "a .gltf or .glb file, or a built-in scene: sphere, spheres, plane, shaderball"
TARGET_HELP = "relative RMSE of linear radiance where objects are: 0.02 is 2 %%"


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


def parse_target(text: str) -> float:
    """Read an error such as ``0.02``."""
    try:
        value = float(text.removesuffix("%")) / (100.0 if text.endswith("%") else 1.0)
    except ValueError:
        value = 0.0
    if not 1e-4 <= value <= 1.0:
        raise argparse.ArgumentTypeError(f"expected an error such as 0.02 or 2%, in 0.0001..1, got {text!r}")
    return value


def sampler_help() -> str:
    """Say how samplers are written; no command but the doctor runs without the compiled part."""
    if load_failure() is not None:
        return "a sampler"
    from burnish.samplers import DEFAULT_SAMPLER, grammar

    return f"{grammar()} (default: {DEFAULT_SAMPLER})"


def add_scene_arguments(parser: argparse.ArgumentParser, has_sampler: bool = True) -> None:
    """Declare what names a scene and its light, and by which sampler it is seen.

    Parameters
    ----------
    parser : ArgumentParser
        Of the subcommand.
    has_sampler : bool
        False: the command chooses the sampler.
    """
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
        parser.add_argument("--sampler", metavar="S", default=None, help=sampler_help())
        parser.add_argument(
            "--spp", type=int, default=1, metavar="N", help="frames to accumulate (default: 1)"
        )
    parser.add_argument(
        "--filter",
        choices=FILTERS,
        default="gauss6",
        help="reduction filter of the environment's pyramid (default: gauss6)",
    )
    parser.add_argument(
        "--rotate-env", type=float, default=0.0, metavar="DEG", help="turn the light about +y"
    )
    parser.add_argument("--face-size", type=int, metavar="N", help="texels along a cube face, a power of two")
    parser.add_argument(
        "--model",
        choices=("ggx", "kurt"),
        default="ggx",
        help="lobes of a glTF file's materials: ggx in layers, as glTF means it, or kurt's that add up",
    )
    parser.add_argument("--no-background", action="store_true", help="leave black where no object is")


def add_view_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the picture's size, its camera and the device.

    Parameters
    ----------
    parser : ArgumentParser
        Of the subcommand.
    """
    parser.add_argument(
        "--size", type=parse_size, default=(540, 960), metavar="HxW", help="height x width (default: 540x960)"
    )
    parser.add_argument("--camera", metavar="NAME|INDEX", help="a camera of the scene (default: the first)")
    parser.add_argument("--device", metavar="NAME", help="part of a Vulkan device's name (default: the best)")
