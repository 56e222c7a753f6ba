"""What all parts share: a device, alternating runs, and the record of all of them. Figures are ms."""

import statistics
import time
from collections.abc import Callable, Mapping
from datetime import date

from tqdm import tqdm

import burnish
from burnish import _core

Measure = Callable[[], Mapping[str, float]]
Times = dict[str, dict[str, float]]

SIZE = (1080, 1920)
PIXELS = SIZE[0] * SIZE[1]
ROUGHNESS = 0.1
PUBLISHED = burnish.Regular(samples=20, footprint="published", normalization="published")
# The driver's compiler places about one pipeline in forty badly, for good: where that matters each is made
# twice, the better one counts.
PIPELINES = 2
SMALL = (64, 64)
# On a CPU device every measure also has the time of all its threads: other load makes it no longer, but it
# holds all that the measure does.
CPU = "cpu"


def camera(half_height: float = 0.45) -> burnish.Camera:
    """View from +z; with the default height the unit sphere fills 16:9."""
    return burnish.Camera.orthographic(
        (0, 0, 3), (0, 0, 0), half_height=half_height, near_plane=0.1, far_plane=10
    )


def pass_times(report: dict) -> dict[str, float]:
    return {entry["name"]: entry["milliseconds"] for entry in report["passes"]}


def sphere_scene(
    lobe: burnish.KurtLobe, environment: burnish.Environment, segments: int = 128
) -> burnish.Scene:
    scene = burnish.Scene()
    scene.add(burnish.Mesh.sphere(segments=segments), burnish.Material(lobes=[lobe]))
    scene.environment = environment
    scene.show_background = False
    return scene


class Bench:
    """Runs measures in turn and keeps what they gave, by the name "part: measure: number"."""

    def __init__(self, device_name: str = "", repeats: int = 9) -> None:
        self.device_name = device_name
        self.device = burnish.Device(device_name)
        self.is_on_cpu = self.device.is_software
        self.repeats = repeats
        self.figures: dict[str, list[float]] = {}
        self.statements: dict[str, dict[str, float | None]] = {}
        self.curves: dict[str, dict] = {}

    def alternate(self, part: str, measures: Mapping[str, Measure], repeats: int = 0) -> Times:
        """Run each once as a warm-up, then all in turn; medians of every number they give."""
        return self._keep(part, self._run(part, measures, repeats or self.repeats))

    def best_of(self, part: str, makers: Mapping[str, Callable[[int], Measure]], repeats: int = 0) -> Times:
        """Like `alternate`, each with PIPELINES pipelines; the better counts, by its first number."""
        measures = {f"{name}|{k}": make(k) for name, make in makers.items() for k in range(PIPELINES)}
        runs = self._run(part, measures, repeats or self.repeats)

        def better(name: str) -> list[Mapping[str, float]]:
            return min(
                (runs[f"{name}|{k}"] for k in range(PIPELINES)),
                key=lambda rows: statistics.median(next(iter(row.values())) for row in rows),
            )

        return self._keep(part, {name: better(name) for name in makers})

    def state(self, text: str, value: float, target: float | None = None, at_least: bool = True) -> None:
        """Print a number that several figures make together, beside what is asked of it."""
        self.statements[text] = {"value": value, "target": target}
        wanted = "" if target is None else f" (asked for: at {'least' if at_least else 'most'} {target:g})"
        print(f"  {text}: {value:.3g}{wanted}")

    def _run(
        self, part: str, measures: Mapping[str, Measure], repeats: int
    ) -> dict[str, list[Mapping[str, float]]]:
        runs: dict[str, list[Mapping[str, float]]] = {name: [] for name in measures}
        with tqdm(total=(repeats + 1) * len(measures), desc=part, delay=2, leave=False) as bar:
            for k in range(repeats + 1):
                for name, measure in measures.items():
                    began = time.process_time()
                    row = measure()
                    if self.is_on_cpu:
                        row = {**row, CPU: row.get(CPU, 1e3 * (time.process_time() - began))}
                    if k > 0:
                        runs[name].append(row)
                    bar.update()
        return runs

    def _keep(self, part: str, runs: Mapping[str, list[Mapping[str, float]]]) -> Times:
        times: Times = {}
        for name, rows in runs.items():
            keys = dict.fromkeys(key for row in rows for key in row)
            columns = {key: [float(row.get(key, 0.0)) for row in rows] for key in keys}
            self.figures |= {f"{part}: {name}: {key}": column for key, column in columns.items()}
            times[name] = {key: statistics.median(column) for key, column in columns.items()}
        return times

    def to_dict(self) -> dict:
        return {
            "device": self.device.name,
            "driver": self.device.driver,
            "date": str(date.today()),
            "figures": self.figures,
            "statements": self.statements,
            "curves": self.curves,
        }


def frame_measure(
    device: burnish.Device,
    scene: burnish.Scene,
    sampler: object,
    view: burnish.Camera | None = None,
    size: tuple[int, int] = SIZE,
    spp: int = 1,
    first_size: tuple[int, int] | None = None,
) -> Measure:
    """Measure a frame brought to numpy: `wall`, and its passes, all shade passes together.

    A scene or size that takes turns with others is first brought back to the device, by a `first_size` frame.
    """
    view = view or camera()

    def measure() -> dict[str, float]:
        if first_size:
            _core.render(device, scene, view, *first_size, sampler, 1, "gauss6", None)
        cpu_began, began = time.process_time(), time.perf_counter()
        data = _core.render(device, scene, view, *size, sampler, spp, "gauss6", None)
        _ = data.color
        wall, cpu = 1e3 * (time.perf_counter() - began), 1e3 * (time.process_time() - cpu_began)
        times = pass_times(data.report)
        shade = sum(one["milliseconds"] for one in data.report["passes"] if one["kind"] == "shade")
        fixed = {name: times.get(name, 0.0) for name in ("surface", "tiles", "read back")}
        row = {"wall": wall, "shade": shade, **fixed, "rest": wall - shade}
        return row | ({CPU: cpu} if device.is_software else {})

    return measure
