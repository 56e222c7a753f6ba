import json

import pytest

from burnish.report import Report

DATA = {
    "version": "0.1.0",
    "device": {"name": "llvmpipe", "driver": "Mesa", "is_software": True},
    "size": [540, 960],
    "spp": 4,
    "filter": "gauss6",
    "sampler": {"name": "regular", "requested": "regular:14", "used": "19 (s1, 3 circles)"},
    "passes": [{"name": "surface", "milliseconds": 5.0}, {"name": "shade", "milliseconds": 15.0}],
    "compile_ms": 61.0,
    "wall_ms": 132.4,
    "effects": [
        {"name": "fresnel", "on": True, "reason": "r0 below 1 in gold"},
        {"name": "anisotropy", "on": False, "reason": "both slopes of every lobe are equal"},
    ],
    "classes": [],
    "stopped": [
        {"pass": "shade", "count": 2, "first": [4, 7]},
        {"pass": "background", "count": 1, "first": [0, 0]},
    ],
    "warnings": ["the lobe of gold gains energy", "pass shade: 2 values were not finite"],
    "ignored_extensions": ["KHR_materials_sheen"],
}


def test_report_gives_its_parts():
    report = Report(DATA)
    assert [entry["name"] for entry in report.passes] == ["surface", "shade"]
    assert report.total_ms == 20.0
    assert report.samples_used == "19 (s1, 3 circles)"
    assert report.size == (540, 960)
    assert (report.spp, report.filter, report.non_finite) == (4, "gauss6", 3)
    assert (report.wall_ms, report.compile_ms) == (132.4, 61.0)
    assert report.standard_error == 0.0 and Report({"standard_error": 0.01}).standard_error == 0.01
    assert report.warnings == DATA["warnings"]
    assert report.ignored_extensions == ["KHR_materials_sheen"]


def test_report_cannot_be_changed_through_its_source():
    source = {**DATA, "warnings": []}
    report = Report(source)
    source["warnings"].append("late")
    assert report.warnings == []


def test_printed_report_is_a_price_list():
    text = str(Report(DATA))
    lines = text.splitlines()
    assert lines[0] == "960 x 540, 4 spp, regular:14, samples used: 19 (s1, 3 circles)"
    assert "llvmpipe" in lines[1]
    shade = next(line for line in lines if line.strip().startswith("shade"))
    assert shade.split() == ["shade", "15.00", "75.0", "%"]
    total = next(line for line in lines if line.strip().startswith("total"))
    assert total.split() == ["total", "20.00", "100.0", "%"]
    assert "wall clock 132 ms, of which compiling 61.00 ms" in text
    assert "on: fresnel" in lines
    assert "  anisotropy  both slopes of every lobe are equal" in lines
    assert "warning: the lobe of gold gains energy" in lines
    assert "warning: pass shade: 2 values were not finite" in lines
    assert "ignored glTF extensions: KHR_materials_sheen" in lines


def test_price_list_lines_up():
    table = [line for line in str(Report(DATA)).splitlines() if line.startswith("  ") and "%" in line]
    assert len(table) == 3
    assert len({line.rindex("%") for line in table}) == 1


def test_report_without_times_prints():
    text = str(Report({**DATA, "passes": [{"name": "shade", "milliseconds": 0.0}]}))
    assert "0.0 %" in text
    assert "total" in str(Report({}))


@pytest.mark.parametrize("indent", [None, 2])
def test_json_holds_everything(indent):
    assert json.loads(Report(DATA).to_json(indent)) == DATA


def test_saved_report_reads_back(tmp_path):
    path = tmp_path / "report.json"
    Report(DATA).save(path)
    assert json.loads(path.read_text()) == DATA
