"""The device under test, and what cases share: maps, what the device made of them, the float64 twin."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from burnish import _core
from burnish.hardcases.driver import ROUNDED_WEIGHTS, driver_class
from burnish.hardcases.inputs import LIGHTS, Float32, Points
from burnish.oracle.cube_map import PaddedCube, pad_cube
from burnish.oracle.matched import MatchedMap
from burnish.oracle.prefiltered import shade_prefiltered
from burnish.oracle.pyramid import hold_in_halves
from burnish.oracle.reference import quadrature_parts, shade_reference
from burnish.oracle.shading import energy_scale, shade_lobe, shade_matched_lobes
from burnish.oracle.sun_split import split_suns
from burnish.rendering import shade
from burnish.samplers import Sampler

Array = NDArray[np.float64]

#: What the names of samplers in the table stand for. The reference sums over every texel: the one of its two
#: ways that has a twin to the last digit.
MAKERS: dict[str, Any] = {
    "regular": _core.Regular,
    "importance": _core.Importance,
    "matched": _core.Matched,
    "prefiltered": lambda samples=14: _core.Prefiltered(),
    "reference": lambda samples=14: _core.Reference(method="quadrature"),
}


def make_sampler(name: str, samples: int = 14, **settings: Any) -> Sampler:
    """Make the sampler of a row; settings that only some have are given to those by their cases."""
    sampler: Sampler = MAKERS[name](samples=samples, **settings)
    return sampler


@dataclass
class Bench:
    """A device, and maps that several cases use.

    Parameters
    ----------
    device : Device
        The device under test.
    """

    device: _core.Device
    #: Values that were not finite and that the engine made black, so far.
    stopped: int = 0
    _maps: dict[str, _core.Environment] = field(default_factory=dict)
    _twins: dict[tuple[str, str], Any] = field(default_factory=dict)

    def light(self, name: str) -> _core.Environment:
        """Return the map of that name in `LIGHTS`, made once."""
        if name not in self._maps:
            self._maps[name] = _core.Environment.from_faces(LIGHTS[name]())
        return self._maps[name]

    def lookup_slack(self, light: str) -> float:
        """Most that rounded weights may add to a lookup of the map of that name: of its brightest texel."""
        if driver_class(self.device) != "rounded":
            return 0.0
        return ROUNDED_WEIGHTS * float(self.light(light).faces.max())

    def shade(
        self, light: str | _core.Environment, lobes: list[_core.KurtLobe], sampler: Sampler, points: Points
    ) -> Float32:
        """Shade points on the device, lobes alone."""
        environment = self.light(light) if isinstance(light, str) else light
        material = _core.Material(lobes=lobes)
        radiance, report = shade(environment, material, sampler, *points, device=self.device, report=True)
        self.stopped += report.non_finite
        return radiance

    def twin(self, light: str, lobes: list[_core.KurtLobe], sampler: Sampler, points: Points) -> Array:
        """Shade the same points in float64, on the levels that the device made of the map."""
        normals, tangents, views = (p.astype(np.float64) for p in points)
        total = np.zeros(normals.shape)
        kind = type(sampler).__name__
        prepared = self._prepared(light, kind)
        if isinstance(sampler, _core.Matched):
            material = _core.Material(lobes=lobes)
            return shade_matched_lobes(prepared, material, sampler.samples, normals, tangents, views)
        for lobe in lobes:
            if kind == "Reference":
                parts = quadrature_parts(prepared.shape[1])
                part = shade_reference(prepared, normals, tangents, views, lobe, parts)
            elif kind == "Prefiltered":
                part = shade_prefiltered(prepared, normals, tangents, views, lobe)
            else:
                part = shade_lobe(prepared, normals, tangents, views, lobe, sampler)
            total += part * energy_scale(normals, tangents, views, lobe)
        return total

    def _prepared(self, light: str, kind: str) -> Any:
        """What the twin of a sampler reads: the device's own levels, so that only the shading is judged."""
        key = (light, kind if kind in ("Matched", "Prefiltered", "Reference") else "pyramid")
        if key not in self._twins:
            self._twins[key] = self._prepare(self.light(light), key[1])
        return self._twins[key]

    def _prepare(self, environment: _core.Environment, kind: str) -> "PaddedCube | MatchedMap | Array":
        if kind == "Reference":
            return hold_in_halves(environment.faces)
        if kind == "Prefiltered":
            levels = _core.environment_prefiltered(self.device, environment, "gauss6")
            return pad_cube([level for _, level in levels])
        if kind == "Matched":
            suns, filled = split_suns(environment.faces)
            if suns:
                environment = _core.Environment.from_faces(np.ascontiguousarray(filled, np.float32))
            return MatchedMap(pad_cube(_core.environment_spherical(self.device, environment, "gauss6")), suns)
        return pad_cube(_core.environment_pyramid(self.device, environment, "gauss6"))
