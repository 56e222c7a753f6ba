"""What ``scripts/demo`` runs: glossy objects in a real place, what the picture cost, and how wrong it is."""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from burnish import (
    Camera,
    Environment,
    Frame,
    Matched,
    Material,
    Mesh,
    Reference,
    Scene,
    builtin,
    render,
    study,
)
from burnish._progress import progress_bar
from burnish.builtin import COPPER, GOLD, STEEL, lacquer, metal

WORLD = Path("/usr/share/blender/datafiles/studiolights/world/courtyard.exr")
"""From Debian's package blender-data; the built-in studio stands in where it is absent."""

WORLD_TURN_DEGREES = 70.0
TEAL = (0.3, 0.6, 0.58)
COMPARED_SIZE = (135, 240)
COMPARED_SAMPLERS = (
    "matched:5",
    "matched:14",
    "matched:30",
    "regular:14",
    "regular:30",
    "importance:14:fibonacci",
    "importance:30:fibonacci",
    "prefiltered",
)
# A fifth of the error that it judges, reached in some ten seconds on two cores.
REFERENCE_STANDARD_ERROR = 0.02


def make_environment(path: Path) -> Environment:
    """Load the world, or make the built-in studio where there is no such file."""
    if path.is_file():
        environment = Environment.from_file(path, rotation=WORLD_TURN_DEGREES)
        print(f"environment: {path}")
        return environment
    print(f"environment: the built-in studio, since {path} is absent (sudo apt-get install blender-data)")
    studio = builtin.make_environment("studio")
    studio.exposure = -1.5  # its lamps are made for darker materials
    return studio


def _at(x: float, y: float, z: float, scale: float = 1.0, tilt: float = 0.0) -> NDArray[np.float64]:
    """Place at a point: scale, then tilt by radians about the x axis."""
    matrix = np.diag([scale, scale, scale, 1.0])
    c, s = np.cos(tilt), np.sin(tilt)
    matrix[1:3, 1:3] = scale * np.array([[c, -s], [s, c]])
    matrix[:3, 3] = (x, y, z)
    return matrix


def make_scene() -> Scene:
    """Arrange a brushed shader ball among spheres and rings, isotropic and brushed."""
    scene = Scene()
    ball = Scene.shader_ball(Material()).meshes[0]
    sphere, ring = Mesh.sphere(), Mesh.torus(1.0, 0.3)
    scene.add(ball, metal(COPPER, (0.3, 0.06)), _at(0.0, -1.1, 0.0), "brushed ball")
    scene.add(sphere, metal(GOLD, (0.12, 0.12)), _at(-2.35, 0.55, 0.2, 0.85), "gold")
    scene.add(sphere, lacquer((0.42, 0.015, 0.02), 0.05), _at(2.35, 0.55, 0.2, 0.85), "red lacquer")
    scene.add(sphere, metal(STEEL, (0.04, 0.04)), _at(-1.4, -0.75, 0.9, 0.45), "steel")
    scene.add(sphere, lacquer((0.015, 0.06, 0.3), 0.2), _at(1.4, -0.75, 0.9, 0.45), "blue lacquer")
    scene.add(ring, metal(STEEL, (0.4, 0.05)), _at(-3.25, -0.65, -0.4, 0.62, 1.1), "brushed ring")
    scene.add(ring, metal(TEAL, (0.22, 0.22)), _at(3.25, -0.65, -0.4, 0.62, 1.1), "teal ring")
    scene.add_camera(Camera.look_at((0.0, 0.5, 9.0), (0.0, 0.02, 0.0), vertical_fov=0.5))
    return scene


def draw(scene: Scene, size: tuple[int, int], sampler: Matched | Reference, spp: int, what: str) -> Frame:
    """Render with a progress bar."""
    with progress_bar(what) as advance:
        return render(scene, size=size, sampler=sampler, spp=spp, progress=advance)


def main(arguments: Sequence[str] | None = None) -> int:
    """Render the demo.

    Parameters
    ----------
    arguments : sequence of str or None
        None: those of the process.
    """
    parser = argparse.ArgumentParser(prog="burnish.demo", description=__doc__)
    parser.add_argument(
        "--out", type=Path, default=Path("out"), help="folder for demo.exr, demo.png and demo-study.html"
    )
    parser.add_argument("--env", type=Path, default=WORLD, help=f"environment (default: {WORLD})")
    parser.add_argument("--spp", type=int, default=4, help="jittered frames to accumulate (default: 4)")
    options = parser.parse_args(arguments)

    options.out.mkdir(parents=True, exist_ok=True)
    scene = make_scene()
    scene.environment = make_environment(options.env)
    frame = draw(scene, (540, 960), Matched(samples=14), options.spp, "rendering")
    for name in ("demo.exr", "demo.png"):
        frame.save(options.out / name)
        print(f"wrote {options.out / name}")
    print(f"\n{frame.report}\n")

    height, width = COMPARED_SIZE
    truth = draw(scene, COMPARED_SIZE, Reference(REFERENCE_STANDARD_ERROR), 1, "reference, small")
    compared = study.accuracy(scene, COMPARED_SAMPLERS, reference=truth, size=COMPARED_SIZE, repeats=3)
    print(
        f"every sampler against the reference at {width} x {height}, 1 spp, where objects are; "
        f"the reference's own standard error is {truth.report.standard_error:.4f}:\n"
    )
    print(compared.format_table())
    page = options.out / "demo-study.html"
    compared.save_html(page)
    print(
        f"\nwrote {page}: the same with pictures to compare, curves and false colours; open it in a browser"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
