"""What a frame cost, what was on and off and why, and what went wrong."""

import json
import os
from collections.abc import Mapping
from copy import deepcopy
from typing import Any

Row = tuple[str, str, str]


def _table(rows: list[Row]) -> list[str]:
    """Left-aligned first column, right-aligned numbers; the first row is the heading, the last the total."""
    widths = [max(len(row[column]) for row in rows) for column in range(3)]
    lines = [f"  {a:<{widths[0]}}  {b:>{widths[1]}}  {c:>{widths[2]}}" for a, b, c in rows]
    rule = "  " + "-" * (sum(widths) + 4)
    return [lines[0], rule, *lines[1:-1], rule, lines[-1]]


def _milliseconds(value: float) -> str:
    return f"{value:.2f}" if value < 100 else f"{value:.0f}"


class Report:
    """The price list of one frame.

    ``print(frame.report)`` shows it; `to_json` and `save` keep it; the attributes give its parts.

    Parameters
    ----------
    data : mapping
        As the renderer fills it: version, device, size, spp, filter, sampler, passes, compile_ms, wall_ms,
        effects, classes, stopped, uploads, diffuse_error, standard_error, warnings, ignored_extensions;
        prediction where an error was asked for.
    """

    def __init__(self, data: Mapping[str, Any]) -> None:
        self._data: dict[str, Any] = deepcopy(dict(data))

    @property
    def passes(self) -> list[dict[str, Any]]:
        """``name``, ``kind`` and ``milliseconds`` of every pass that ran, by the device's clock, in order."""
        return list(self._data.get("passes", []))

    @property
    def effects(self) -> list[dict[str, Any]]:
        """``name``, ``on`` and ``reason`` of every effect the renderer knows."""
        return list(self._data.get("effects", []))

    @property
    def classes(self) -> list[dict[str, Any]]:
        """Specialised pipelines of the shade pass.

        ``effects`` in words, ``values`` of each effect as a number, ``table``, ``samples`` and ``reason``.
        """
        return list(self._data.get("classes", []))

    @property
    def sampler(self) -> dict[str, Any]:
        """``name``, ``requested`` and ``used`` of the sampler."""
        return dict(self._data.get("sampler", {}))

    @property
    def samples_used(self) -> str:
        """Samples per lobe and pixel that were really taken, as text such as "19 (s1, 3 circles)"."""
        return str(self.sampler.get("used", ""))

    @property
    def device(self) -> dict[str, Any]:
        """``name``, ``driver`` and ``is_software``."""
        return dict(self._data.get("device", {}))

    @property
    def size(self) -> tuple[int, int]:
        """Height and width in pixels."""
        height, width = self._data.get("size", (0, 0))
        return int(height), int(width)

    @property
    def points(self) -> int:
        """Number of shaded points; 0 of a picture."""
        return int(self._data.get("points", 0))

    @property
    def spp(self) -> int:
        """Jittered frames accumulated."""
        return int(self._data.get("spp", 1))

    @property
    def filter(self) -> str:
        """Reduction filter of the pyramid."""
        return str(self._data.get("filter", ""))

    @property
    def stopped(self) -> list[dict[str, Any]]:
        """Where values were not finite and became black: ``pass``, ``count``, ``first`` (row, column)."""
        return list(self._data.get("stopped", []))

    @property
    def non_finite(self) -> int:
        """Values that all passes stopped."""
        return sum(int(entry["count"]) for entry in self.stopped)

    @property
    def uploads(self) -> dict[str, int]:
        """What was brought to the device: counts of ``meshes``, ``textures`` and ``maps``.

        All 0 where an earlier picture left everything there. A texture read in two encodings counts twice.
        """
        return {name: int(count) for name, count in self._data.get("uploads", {}).items()}

    @property
    def diffuse_error(self) -> float:
        """Relative RMSE of the light on diffuse surfaces, the worst map's; 0 where it is exact or not there.

        Measured when the light was made: of the cube's lookups where they err most, in the middle of four
        texels, or of the harmonics over all normals.
        """
        return float(self._data.get("diffuse_error", 0.0))

    @property
    def standard_error(self) -> float:
        """Of a progressive reference: root mean square over the pixels, relative to their mean; else 0."""
        return float(self._data.get("standard_error", 0.0))

    @property
    def warnings(self) -> list[str]:
        """One sentence each; empty when nothing is to be said."""
        return list(self._data.get("warnings", []))

    @property
    def ignored_extensions(self) -> list[str]:
        """Optional glTF extensions of the scene's file that have no effect here."""
        return list(self._data.get("ignored_extensions", []))

    @property
    def prediction(self) -> dict[str, Any] | None:
        """What `burnish.advise` predicted for a target error, as ``Advice.to_dict`` gives it; else None."""
        prediction = self._data.get("prediction")
        return None if prediction is None else dict(prediction)

    def with_prediction(self, prediction: Mapping[str, Any]) -> "Report":
        """Give the same report with what was predicted for a target error.

        Parameters
        ----------
        prediction : dict
            As ``Advice.to_dict`` gives it.
        """
        return Report(self._data | {"prediction": dict(prediction)})

    @property
    def total_ms(self) -> float:
        """Sum over the passes, GPU time."""
        return float(sum(entry["milliseconds"] for entry in self.passes))

    @property
    def wall_ms(self) -> float:
        """From the call to the arrays, on the wall clock; includes compilation, uploads and read-back."""
        return float(self._data.get("wall_ms", 0.0))

    @property
    def compile_ms(self) -> float:
        """Making pipelines; 0 once they are cached. Not part of any pass."""
        return float(self._data.get("compile_ms", 0.0))

    def to_json(self, indent: int | None = 2) -> str:
        """Give everything as JSON text.

        Parameters
        ----------
        indent : int or None
            Spaces per level; None for one line.
        """
        return json.dumps(self._data, indent=indent)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the report as a JSON file.

        Parameters
        ----------
        path : path
            Its folder must exist.

        Raises
        ------
        FileError
            If it cannot be written; a file of that name is then as it was.
        """
        from burnish.images.files import write_text

        write_text(path, self.to_json() + "\n")

    def __repr__(self) -> str:
        height, width = self.size
        return f"Report({width}x{height}, {len(self.passes)} passes, {self.total_ms:.1f} ms)"

    def __str__(self) -> str:
        blocks = [
            self._heading(),
            self._prediction_list(),
            self._price_list(),
            self._effect_list(),
            self._notes(),
        ]
        return "\n\n".join("\n".join(block) for block in blocks if block)

    def _heading(self) -> list[str]:
        height, width = self.size
        device, sampler = self.device, self.sampler
        asked = sampler.get("requested", sampler.get("name", "no sampler"))
        picture = f"{width} x {height}, {self.spp} spp, {asked}"
        if self.points:
            picture = f"{self.points} points, {asked}"
        if self.samples_used:
            picture += f", samples used: {self.samples_used}"
        where = f"on {device.get('name', 'an unknown device')}, driver {device.get('driver', 'unknown')}"
        return [picture, where]

    def _prediction_list(self) -> list[str]:
        given = self.prediction
        if given is None:
            return []
        how = "measured on a small picture" if given["is_probed"] else "by the model"
        lines = [
            f"target error {100 * given['target_error']:.3g} %: {given['sampler']}, "
            f"predicted {100 * given['predicted_error']:.3g} % ({how}), "
            f"{_milliseconds(given['predicted_ms'])} ms",
        ]
        if given["error_reached"] is not None:
            lines.append(f"error really reached: {100 * given['error_reached']:.3g} %")
        return [*lines, f"  the advice took {_milliseconds(given['advice_ms'])} ms"]

    def _price_list(self) -> list[str]:
        total = self.total_ms
        rows: list[Row] = [("pass", "ms", "share")]
        for entry in self.passes:
            share = entry["milliseconds"] / total if total > 0 else 0.0
            rows.append((entry["name"], _milliseconds(entry["milliseconds"]), f"{100 * share:.1f} %"))
        rows.append(("total", _milliseconds(total), "100.0 %" if total > 0 else "-"))
        wall, compiling = _milliseconds(self.wall_ms), _milliseconds(self.compile_ms)
        outside = f"  wall clock {wall} ms, of which compiling {compiling} ms"
        return [*_table(rows), outside]

    def _effect_list(self) -> list[str]:
        on = [entry["name"] for entry in self.effects if entry["on"]]
        off = [entry for entry in self.effects if not entry["on"]]
        lines = [f"on: {', '.join(on) if on else 'nothing'}"]
        if off:
            width = max(len(entry["name"]) for entry in off)
            lines += ["off:", *(f"  {entry['name']:<{width}}  {entry['reason']}" for entry in off)]
        return lines

    def _notes(self) -> list[str]:
        lines = [f"warning: {warning}" for warning in self.warnings]
        if self.ignored_extensions:
            lines.append(f"ignored glTF extensions: {', '.join(self.ignored_extensions)}")
        return lines
