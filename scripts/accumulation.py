"""Show that accumulated pictures converge: every sampler's error against many pictures of its own, by spp."""

import argparse
import warnings

import burnish
from burnish import environments
from burnish.samplers import sampler_from_text

SAMPLERS = ("regular:14", "importance:14", "matched:14", "prefiltered", "reference:0.2")


def make_scene() -> burnish.Scene:
    """Round, brushed and lacquered spheres under spots."""
    materials = [
        burnish.Material(lobes=[burnish.KurtLobe(roughness=0.05)]),
        burnish.Material(lobes=[burnish.KurtLobe(roughness=(0.3, 0.1), rotation=0.4)]),
        burnish.Material(diffuse=(0.4, 0.02, 0.02), lobes=[burnish.KurtLobe(0.1, r0=0.04, alpha=0.5)]),
    ]
    scene = burnish.Scene.spheres(materials, columns=3)
    scene.environment = environments.spots(3, 256)
    return scene


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--size", default="960x540", help="width x height (default: 960x540)")
    parser.add_argument("--spp", type=int, nargs="+", default=[1, 4, 16, 64], help="(default: 1 4 16 64)")
    parser.add_argument("--truth", type=int, default=256, help="pictures of the truth (default: 256)")
    parser.add_argument("--samplers", nargs="+", default=list(SAMPLERS), help=" ".join(SAMPLERS))
    options = parser.parse_args()
    width, height = (int(edge) for edge in options.size.split("x"))
    scene = make_scene()
    # What is asked here is just what fewer pictures leave rough.
    warnings.filterwarnings("ignore", message="reference: expected a frame of spp")

    def draw(sampler: str, spp: int) -> burnish.Frame:
        return burnish.render(scene, size=(height, width), sampler=sampler_from_text(sampler), spp=spp)

    print(f"{width} x {height}, relative RMSE against {options.truth} pictures of the same sampler")
    print("| sampler | " + " | ".join(f"spp {spp}" for spp in options.spp) + " |")
    print("|---" * (len(options.spp) + 1) + "|")
    for sampler in options.samplers:
        truth = draw(sampler, options.truth)
        errors = [draw(sampler, spp).error(truth) for spp in options.spp]
        print(f"| {sampler} | " + " | ".join(f"{error:.4f}" for error in errors) + " |", flush=True)


if __name__ == "__main__":
    main()
