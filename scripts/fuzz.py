"""Looks for inputs that break Burnish: hostile files, shading points, materials, environments, scenes."""

import argparse
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tqdm import tqdm

REPOSITORY = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(REPOSITORY / "tests" / "python" / "fuzz"), str(REPOSITORY / "tests" / "python")]

import hostile_points  # noqa: E402
from file_seeds import write_seeds  # noqa: E402

CORPUS = REPOSITORY / "build" / "fuzz" / "corpus"
BAD_INPUT = REPOSITORY.parent / "shared" / "data" / "bad-input"
HELP = """\
files (coverage-guided; what was found is kept in build/fuzz/corpus and is where the next run starts):
  gltf     scenes, .gltf and .glb, through Scene.from_file's reader         C++, needs clang
  hdr      Radiance pictures                                                C++, needs clang
  png      PNG textures of scenes                                           C++, needs clang
  jpeg     JPEG textures of scenes                                          C++, needs clang
  exr      OpenEXR pictures, through read_image                             Python, needs atheris
  pillow   PNG and JPEG environments, through read_image                    Python, needs atheris
  all      each of them; one whose tool is missing is left out, and why is said

numbers:
  points   shades random hostile points and counts values that are negative or not finite; --count
  shade    Hypothesis over materials, points, environments and scenes against the oracle; --examples

A file that breaks a reader is written to build/fuzz/corpus/TARGET and named at the end; the same command with
--replay FILE runs it alone. A failing block of points is named by its seed: --seed N --count 1 runs it alone.

  scripts/fuzz gltf --seconds 60
  scripts/fuzz exr --runs 1000000
  scripts/fuzz points --count 10000000
  scripts/fuzz shade --examples 2000

clang:    apt-get install clang libclang-rt-14-dev
atheris:  .venv/bin/python -m pip install atheris
"""


@dataclass
class Target:
    """A reader, and folders of other files beside the seeds that are made here."""

    program: str  # of the preset fuzz; empty: a Python target
    folders: tuple[Path, ...] = ()


TARGETS = {
    "gltf": Target(
        "fuzz_gltf",
        (
            BAD_INPUT / "assimp",
            BAD_INPUT / "gltf-validator",
            BAD_INPUT / "tinygltf",
            Path("/usr/share/assimp/models/glTF2"),
        ),
    ),
    "hdr": Target("fuzz_hdr", (BAD_INPUT / "image-rs/hdr", BAD_INPUT / "openimageio/hdr")),
    "png": Target("fuzz_picture", (BAD_INPUT / "image-rs/png", BAD_INPUT / "openimageio/png-damaged")),
    "jpeg": Target("fuzz_picture", (BAD_INPUT / "image-rs/jpg", BAD_INPUT / "openimageio/jpeg-corrupt")),
    "exr": Target("", (BAD_INPUT / "openexr",)),
    "pillow": Target("", (BAD_INPUT / "image-rs", BAD_INPUT / "openimageio/png-damaged")),
}


def missing_tool(target: Target) -> str:
    """Say what the target needs and is not there; empty where nothing is missing."""
    if not target.program:
        found = subprocess.run([sys.executable, "-c", "import atheris"], capture_output=True, check=False)
        return "" if found.returncode == 0 else "atheris is missing: .venv/bin/python -m pip install atheris"
    if shutil.which("clang++") is None:
        return "clang is missing: apt-get install clang libclang-rt-14-dev"
    probe = 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }'
    linked = subprocess.run(
        ["clang++", "-fsanitize=fuzzer,address,undefined", "-x", "c++", "-", "-o", os.devnull],
        input=probe.encode(),
        capture_output=True,
        check=False,
    )
    return "" if linked.returncode == 0 else "clang has no libFuzzer: apt-get install libclang-rt-14-dev"


def program_of(target: Target, name: str) -> list[str]:
    """Build the target; give the command that runs it."""
    if not target.program:
        return [sys.executable, str(REPOSITORY / "tests/python/fuzz/picture_target.py"), name]
    for command in (["cmake", "--preset", "fuzz"], ["cmake", "--build", "--preset", "fuzz"]):
        subprocess.run(command, cwd=REPOSITORY, check=True, stdout=subprocess.DEVNULL)
    return [str(REPOSITORY / "build/fuzz/tests/fuzz" / target.program)]


def lines_with_progress(process: subprocess.Popen[str], name: str, runs: int | None) -> Iterator[str]:
    """Pass on what libFuzzer prints, and show how far it is."""
    assert process.stderr is not None
    with tqdm(total=runs, desc=name, unit=" runs", disable=None) as bar:
        for line in process.stderr:
            if done := re.match(r"#(\d+)\s", line):
                bar.update(int(done[1]) - bar.n)
            yield line


def fuzz_file_reader(name: str, arguments: argparse.Namespace) -> bool:
    """Run one target; print what it did; say whether nothing broke."""
    target, folder = TARGETS[name], CORPUS / name
    write_seeds(name, folder / "seeds")
    (folder / "found").mkdir(exist_ok=True)
    command = [*program_of(target, name), "-timeout=25", "-rss_limit_mb=4096", f"-artifact_prefix={folder}/"]
    if arguments.replay is not None:
        return subprocess.run([*command, str(arguments.replay)], check=False).returncode == 0
    limit = f"-runs={arguments.runs}" if arguments.runs else f"-max_total_time={arguments.seconds}"
    corpora = [folder / "found", folder / "seeds", *(other for other in target.folders if other.is_dir())]
    command += [limit, "-max_len=8192", "-print_final_stats=1", *map(str, corpora)]
    # The readers open files: in memory that is quick.
    shared_memory = Path("/dev/shm")
    environment = os.environ | ({"TMPDIR": str(shared_memory)} if shared_memory.is_dir() else {})
    began = time.monotonic()
    process = subprocess.Popen(
        command,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        errors="replace",
        env=environment,
    )
    lines = list(lines_with_progress(process, name, arguments.runs))
    is_good = process.wait() == 0
    seconds = time.monotonic() - began
    numbers = dict(re.findall(r"^stat::(\w+):\s+(\d+)$", "".join(lines), re.MULTILINE))
    runs = int(numbers.get("number_of_executed_units", 0))
    print(
        f"{name}: {runs} files in {seconds:.0f} s ({runs / max(seconds, 1e-3):.0f} per second), "
        f"the slowest took {numbers.get('slowest_unit_time_sec', '?')} s, "
        f"at most {numbers.get('peak_rss_mb', '?')} MB: {'no crash, no hang' if is_good else 'BROKEN'}"
    )
    if not is_good:
        sys.stderr.writelines(line for line in lines[-80:] if not line.startswith("#"))
        print(f"{name}: the file is named above; run it alone with: scripts/fuzz {name} --replay FILE")
    return is_good


def fuzz_shade(examples: int) -> bool:
    """Run the Hypothesis tests with more examples than CI gives them."""
    command = [sys.executable, "-m", "pytest", "tests/python/fuzz/test_random_inputs.py", "--timeout=0"]
    environment = os.environ | {"BURNISH_FUZZ_EXAMPLES": str(examples)}
    return subprocess.run(command, cwd=REPOSITORY, env=environment, check=False).returncode == 0


def parse(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        "scripts/fuzz", description=__doc__, epilog=HELP, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "what", choices=[*TARGETS, "all", "points", "shade"], metavar="WHAT", help="see below"
    )
    limits = parser.add_mutually_exclusive_group()
    limits.add_argument("--runs", type=int, metavar="N", help="files: stop after N")
    limits.add_argument(
        "--seconds", type=int, default=30, metavar="S", help="files: stop after S seconds (30)"
    )
    limits.add_argument(
        "--replay", type=Path, metavar="FILE", help="files: run this one and say what happens"
    )
    parser.add_argument("--count", type=int, default=100_000, metavar="N", help="points: at least so many")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="points: number of the first block")
    parser.add_argument("--examples", type=int, default=1000, metavar="N", help="shade: of each test")
    return parser.parse_args(arguments)


def main() -> int:
    arguments = parse(sys.argv[1:])
    if arguments.what == "points":
        return 0 if hostile_points.fuzz(arguments.count, arguments.seed) else 1
    if arguments.what == "shade":
        return 0 if fuzz_shade(arguments.examples) else 1
    is_good = True
    for name in TARGETS if arguments.what == "all" else [arguments.what]:
        if reason := missing_tool(TARGETS[name]):
            print(f"{name}: left out, {reason}")
            is_good &= arguments.what == "all"
        else:
            is_good &= fuzz_file_reader(name, arguments)
    return 0 if is_good else 1


if __name__ == "__main__":
    sys.exit(main())
