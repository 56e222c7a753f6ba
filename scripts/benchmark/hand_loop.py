"""The engine against a loop by hand in C++ (tests/bench): same method, same map, table and normals."""

import subprocess
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import burnish
from burnish import _core, environments
from burnish.oracle.cube_map import pad_cube
from burnish.oracle.frame import octahedral_encode
from burnish.oracle.regular_pattern import choose_pattern

from .bench import CPU, PUBLISHED, ROUGHNESS, SIZE, Bench, Measure, camera, sphere_scene
from .workers import CoreWorker, core_count

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build/bench"
RUNS = 3
# In the mean of pixels; both are float32, but reciprocals and logarithms are not the same.
MOST_DIFFERENCE = 1e-4


def build_loop() -> Path:
    """Compile the loop for this processor; RuntimeError with the compiler's words where that fails."""
    switches = ("PYTHON=OFF", "TESTS=OFF", "BENCH=ON")
    configure = ["cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", *(f"-DBURNISH_{s}" for s in switches)]
    for command in (configure, ["cmake", "--build", BUILD, "--target", "shading_loop"]):
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError((done.stderr or done.stdout).strip())
    return BUILD / "tests/bench/shading_loop"


def sample_table(sampler: burnish.Regular, roughness: float, face_size: int) -> np.ndarray:
    """Slopes, weight and texel factor of a sample a row, (n, 4) float32: a round lobe, all as published."""
    half = choose_pattern(roughness, sampler.samples, sampler.threshold)
    hz = half[:, 2]
    slopes = half[:, :2] / hz[:, None]
    density = np.exp(-np.sum((slopes / roughness) ** 2, axis=1)) / hz**4
    sin_edge = np.sin(np.arctan(np.sqrt(-np.log(sampler.threshold)) * roughness))
    texels = face_size**2 * np.pi * sin_edge**2 / len(half) / hz
    return np.column_stack([slopes, density / density.sum(), texels]).astype(np.float32)


def pack_pairs(levels: list[np.ndarray]) -> np.ndarray:
    """Levels of a cube, (6, n, n, 3), as pairs of halves (render/texel_pairs.h), (pairs, 8) float16."""
    cube = pad_cube(levels)
    parts = []
    for size, begin in zip(cube.sizes, cube.offsets, strict=True):
        width = int(size) + 2
        faces = cube.texels[begin : begin + 6 * width * width].reshape(6, width, width, 3)
        # No axis is mirrored there.
        for face in (0, 5):
            faces[face] = faces[face, :, ::-1].copy()
        for face in (0, 1, 3, 4, 5):
            faces[face] = faces[face, ::-1].copy()
        pairs = np.zeros((6, width, width - 1, 4, 2), np.float16)
        pairs[..., :3, 0] = faces[:, :, :-1]
        pairs[..., :3, 1] = faces[:, :, 1:]
        parts.append(pairs.reshape(-1, 8))
    return np.concatenate(parts)


def write_input(path: Path, environment: burnish.Environment, normals: np.ndarray) -> None:
    """Write what the loop reads; `normals`: (h, w, 3), seen along -z by an orthographic camera."""
    levels = environment.pyramid("gauss6")
    table = sample_table(PUBLISHED, ROUGHNESS, len(levels[0][0]))
    height, width = normals.shape[:2]
    rays = np.array([[0, 0, -1], [0, 0, 0], [0, 0, 0]], np.float32)
    packed = np.rint(octahedral_encode(normals) * 32767).astype(np.int16)
    with path.open("wb") as file:
        for part in (
            np.array([width, height, len(levels) - 1, len(table)], np.uint32),
            rays,
            table,
            packed,
            pack_pairs(levels),
        ):
            file.write(np.ascontiguousarray(part).tobytes())


def bench_loop(bench: Bench) -> None:
    if not bench.device.is_software:
        print("\nC++ loop: left out, the device is no CPU")
        return
    try:
        program = build_loop()
    except RuntimeError as error:
        print(f"\nC++ loop: left out, it does not build here: {error}")
        return
    with TemporaryDirectory() as folder:
        _compare(bench, program, Path(folder))


def _compare(bench: Bench, program: Path, folder: Path) -> None:
    environment = environments.spots(1, 256)
    scene = sphere_scene(burnish.KurtLobe(roughness=ROUGHNESS), environment)
    device = burnish.Device(bench.device_name, lookup="software")
    frame = _core.render(device, scene, camera(), *SIZE, PUBLISHED, 1, "gauss6", None)
    write_input(folder / "input", environment, frame.normal)

    def loop(cores: int, *picture: Path) -> dict[str, float]:
        command = [program, folder / "input", str(cores), str(RUNS), *picture]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        runs = np.array([line.split() for line in done.stdout.splitlines()], float)
        return dict(zip(("ms", CPU), np.median(runs, axis=0), strict=True))

    loop(core_count(), folder / "picture")
    drawn = np.fromfile(folder / "picture", np.float32).reshape(*SIZE, 4)[..., :3]
    relative = np.abs(drawn - frame.color).mean(-1) / np.maximum(frame.color.mean(-1), 1e-6)

    if not relative.mean() < MOST_DIFFERENCE:
        raise RuntimeError(
            f"C++ loop: expected the engine's picture within {MOST_DIFFERENCE:g}, got {relative.mean():g}"
        )

    counts = sorted({1, core_count()})
    workers = {cores: CoreWorker(cores) for cores in counts}

    def by_engine(cores: int) -> Callable[[int], Measure]:
        return lambda k: lambda: workers[cores].shade(bench.device_name, "software", k)

    def by_loop(cores: int) -> Callable[[int], Measure]:
        return lambda _: lambda: loop(cores)

    makers: dict[str, Callable[[int], Measure]] = {}
    for cores in counts:
        makers |= {f"engine, {cores} cores": by_engine(cores), f"C++, {cores} cores": by_loop(cores)}
    times = bench.best_of("loop", makers)
    for worker in workers.values():
        worker.close()

    print(
        "\nsoftware lookup against a loop by hand in C++ (tests/bench), shade pass as above;"
        f"\npictures differ by {relative.mean():.2g} in the mean of pixels, {np.median(relative):.2g} in the"
        f" median, {np.percentile(relative, 99):.2g} in 99 of 100"
    )
    for name, row in times.items():
        print(f"  {name:<20}{row['ms']:8.1f} ms, of all threads {row[CPU]:8.1f} ms")
    for cores in counts:
        by_hand, engine = times[f"C++, {cores} cores"], times[f"engine, {cores} cores"]
        text = f"speed of the software lookup : C++ loop, {cores} cores"
        bench.state(text, by_hand["ms"] / engine["ms"], 0.5)
        bench.state(f"{text}, by the time of all threads, surface pass included", by_hand[CPU] / engine[CPU])
