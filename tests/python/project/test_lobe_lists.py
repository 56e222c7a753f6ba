"""Models of lobes: C++, GLSL, the oracle, Python's names and the tests know the same ones."""

import re
from pathlib import Path

from burnish import lobes
from burnish.oracle.lobe import models

REPOSITORY = Path(__file__).resolve().parents[3]


def read(path):
    return (REPOSITORY / path).read_text()


def cpp_models():
    """Names in the list of lobe.h, without "Lobe"."""
    listed = re.search(r"using Lobe = std::variant<([^>]*)>;", read("cpp/burnish/lobe/lobe.h"))
    return [name.strip().removesuffix("Lobe").lower() for name in listed[1].split(",")]


def test_every_list_has_the_models_of_cpp():
    numbers = dict(re.findall(r"MODEL_(\w+) = (\d+)u;", read("glsl/shared/constants.h")))
    bits = int(numbers.pop("BITS"))
    assert [name.lower() for name in numbers] == cpp_models()
    assert [int(number) for number in numbers.values()] == list(range(len(numbers)))
    assert len(numbers) <= 2**bits
    assert list(lobes.MODELS) == cpp_models()
    assert [name.removesuffix("Lobe").lower() for name in models.MODELS] == cpp_models()


def test_every_model_is_a_file_of_each_language():
    for name in cpp_models():
        for path in (
            f"cpp/burnish/lobe/{name}.h",
            f"cpp/burnish/lobe/{name}.cpp",
            f"glsl/lobe/{name}.glsl",
            f"python/burnish/oracle/lobe/{name}.py",
            f"glsl/probe/{name}_lobe.comp.glsl",
        ):
            assert (REPOSITORY / path).is_file(), path


def test_every_model_names_itself_by_its_number():
    for name in cpp_models():
        assert f".id = shared::MODEL_{name.upper()}," in read(f"cpp/burnish/lobe/{name}.cpp")


def test_every_model_of_the_oracle_answers_the_same():
    asked = {
        name
        for model in models.MODELS.values()
        for name in vars(model)
        if re.search(rf"model(_of\(lobe\))?\.{name}\b", all_of_the_oracle())
    }
    assert {"DENSITY", "FILTER_SLOPE", "reflect", "stretch", "linear_map", "albedo", "values"} <= asked
    of_half_vectors, of_others = {"widened_d", "rest"}, {"under_light"}
    assert of_half_vectors | of_others <= asked
    for name, model in models.MODELS.items():
        assert asked - (of_others if model.HAS_HALF_VECTORS else of_half_vectors) <= set(vars(model)), name


def all_of_the_oracle():
    return "".join(path.read_text() for path in (REPOSITORY / "python/burnish/oracle").glob("*.py"))


def test_every_model_is_tested_on_every_sampler():
    listed = re.findall(r'^    "(\w+)": \{', read("tests/python/gpu/test_lobe_models.py"), re.MULTILINE)
    assert [name.lower() for name in listed] == cpp_models()


def test_kernels_that_are_not_a_models_own_name_none():
    """The switch between models and the mapping of glTF's material to one are the only ones to know them."""
    allowed = {"lobe", "probe", "shared"}
    for path in (REPOSITORY / "glsl").rglob("*.glsl"):
        folder = path.relative_to(REPOSITORY / "glsl").parts[0]
        if folder in allowed or path.stem == "metallic_roughness":
            continue
        for name in cpp_models():
            assert not re.search(rf"{name}", path.read_text(), re.IGNORECASE), path
