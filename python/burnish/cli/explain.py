"""``burnish explain``: what rendering would do, without rendering."""

import argparse
from typing import TYPE_CHECKING, Any

from burnish.cli.arguments import add_scene_arguments

if TYPE_CHECKING:
    from burnish._core import Device

HELP = "print what rendering would do and why, without rendering"
EXAMPLES = """\
examples:
  burnish explain model.glb
  burnish explain spheres --sampler reference:0.002 --spp 16
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments.

    Parameters
    ----------
    parser : ArgumentParser
        Of the subcommand.
    """
    add_scene_arguments(parser)


def _device_at_hand() -> "Device | None":
    """Open the device that would be taken; none where there is none."""
    from burnish._core import Device, VulkanError

    try:
        return Device()
    except VulkanError:
        return None


def format_plan(plan: dict[str, Any]) -> str:
    """Lay out a plan: passes, effects on and off, pipelines, each with its reason.

    Parameters
    ----------
    plan : dict
        As `burnish.rendering.plan` gives it.
    """

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


def run(options: argparse.Namespace) -> int:
    """Print the plan; 0 when it is done.

    Parameters
    ----------
    options : Namespace
        As `add_arguments` declares them.
    """
    from burnish.cli.inputs import prepare_scene
    from burnish.rendering import plan
    from burnish.samplers import DEFAULT_SAMPLER, sampler_from_text

    sampler = sampler_from_text(options.sampler or DEFAULT_SAMPLER, "--sampler")
    scene, device = prepare_scene(options), _device_at_hand()
    print(format_plan(plan(scene, sampler, options.spp, options.filter, device=device)))
    return 0
