"""What a study writes: JSON, tables, plots, and a page that needs no other file."""

import csv
import json
import re
from html.parser import HTMLParser

import numpy as np
import pytest
from PIL import Image

import burnish
from burnish.study.differences import difference_range, object_box
from burnish.study.findings import list_findings
from burnish.study.journal import Journal
from burnish.study.plots import wrap_title
from burnish.study.runner import run_cells
from burnish.study.store import PictureStore
from burnish.study.study import Study
from study_support import FakeSubject, make_cell

pytest.importorskip("matplotlib")


@pytest.fixture(scope="module")
def study():
    cells = [make_cell(FakeSubject("one")), make_cell(FakeSubject("two & <three>"))]
    result = run_cells(cells, Journal(), PictureStore(), True, False, command="burnish study <one> --env a&b")
    result.notes.append("the workers were in a hurry")
    return result


def test_json_keeps_everything_but_pictures(study, tmp_path):
    study.save_json(tmp_path / "study.json")
    again = Study.load_json(tmp_path / "study.json")
    assert (again.rows, again.command, again.notes) == (study.rows, study.command, study.notes)
    assert again.pictures == []
    assert again.pareto() == study.pareto()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("nonsense", "expected a study as save_json writes it"),
        ('{"rows": []}', "expected a study as save_json writes it .*burnish_study"),
        ('{"burnish_study": 99, "rows": []}', "format 1, got 99"),
        ('{"burnish_study": 1, "rows": [{}], "command": "", "notes": []}', "expected a study.*scene"),
        ("[]", "expected a study"),
    ],
)
def test_other_files_are_no_study(tmp_path, text, message):
    (tmp_path / "other.json").write_text(text)
    with pytest.raises(burnish.FileError, match=message):
        Study.load_json(tmp_path / "other.json")


def test_an_absent_file_is_named(tmp_path):
    with pytest.raises(burnish.FileError, match=r"absent.json: expected a file, found none"):
        Study.load_json(tmp_path / "absent.json")


def test_csv_has_a_column_for_every_pass(study, tmp_path):
    study.save_csv(tmp_path / "study.csv")
    rows = list(csv.DictReader((tmp_path / "study.csv").open(newline="")))
    assert [row["sampler"] for row in rows] == [row["sampler"] for row in study.rows]
    assert float(rows[1]["pass shade 0 (ms)"]) == 10.0
    assert float(rows[0]["relative_rmse"]) == pytest.approx(0.2)
    assert "passes_ms" not in rows[0]


def test_an_empty_study_writes_empty_files(tmp_path):
    Study([]).save_csv(tmp_path / "a.csv")
    Study([]).save_json(tmp_path / "a.json")
    assert Study.load_json(tmp_path / "a.json").rows == []
    with pytest.raises(ValueError, match="page: expected a study with at least one row, got none"):
        Study([]).save_html(tmp_path / "a.html")
    with pytest.raises(ValueError, match="plot: expected a study with at least one row, got none"):
        Study([]).plot(tmp_path / "a.png")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.csv", "a.json"]


def test_the_front_is_taken_cell_by_cell(study):
    # the more samples, the slower and the better: all are on the front of their cell
    assert study.pareto() == study.rows
    slower = [row | {"frame_ms": 1000.0 - row["frame_ms"]} for row in study.rows]
    assert [row["sampler"] for row in Study(slower).pareto()] == ["importance:20"] * 2


def test_the_text_table_marks_the_front(study):
    rows = [row | {"frame_ms": 99.0} if row["sampler"] == "regular:5" else row for row in study.rows]
    text = Study(rows).format_table()
    lines = [line for line in text.splitlines() if "regular" in line]
    assert [line.startswith(" * ") for line in lines] == [False, True, False, True]
    assert "one · m 0.1 · studio (8) · box · 8 x 6" in text
    assert len(text.split("\n\n")) == 2


class Links(HTMLParser):
    """Collects what a page would fetch, and its text."""

    def __init__(self):
        super().__init__()
        self.targets, self.words, self.tags = [], [], []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        self.targets += [value for name, value in attributes if name in ("src", "href", "data", "srcset")]

    def handle_data(self, data):
        self.words.append(data)


def test_the_page_needs_no_other_file_and_says_everything(study, tmp_path):
    study.save_html(tmp_path / "page.html")
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    page = Links()
    page.feed(text)
    assert page.targets and all(target.startswith("data:image/png;base64,") for target in page.targets)
    assert not re.search(r"url\(|@import|https?:|//", re.sub(r'base64,[^"]*', "", text))
    words = " ".join(page.words)
    for expected in ("a <fast> device", "its driver", study.command, "the workers were in a hurry"):
        assert expected in words
    assert "two & <three>" in words and "$" not in words
    for row in study.rows:
        assert words.count(row["sampler"]) >= 2
    assert page.tags.count("table") == 2 and page.tags.count("select") == 4
    # four curves, two pages of differences, and four pictures of each cell
    assert len(page.targets) == 4 + 2 + 2 * 4


def test_a_page_without_pictures_has_no_slider(study, tmp_path):
    Study(study.rows).save_html(tmp_path / "page.html")
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "<h2>Compare</h2>" not in text and "<table>" in text


def test_findings_name_the_best_and_warn(study):
    lines = list_findings(study)
    best = "importance:20 has the least error, 0.05 relative RMSE in 22 ms."
    assert lines[0] == f"one · m 0.1 · studio (8) · box · 8 x 6: {best}"
    assert lines[2] == "the workers were in a hurry" and len(lines) == 3
    changed = {"reference_standard_error": 0.04, "flip": None, "warnings": ["mind the gap"]}
    text = "\n".join(list_findings(Study([row | changed for row in study.rows])))
    assert text.count("more than a third of the least error") == 2
    assert "flip-evaluator was not installed" in text and text.count("mind the gap") == 1
    owned = list_findings(Study([study.rows[0] | {"worst_share": 0.9}, *study.rows[1:]]))
    assert "the worst .1 % of the pixels have 90% of regular:5's squared error" in owned[1]
    assert not any("squared error" in line for line in lines)
    black = Study([row | {"relative_rmse": None} for row in study.rows])
    assert "the reference is black" in list_findings(black)[0]


@pytest.mark.parametrize("kind", ["error-time", "error-samples", "time-samples", "difference"])
def test_plots_show_something(study, tmp_path, kind):
    path = tmp_path / "plot.png"
    study.plot(path, kind, error="max_error", time="shade_ms")
    pixels = np.asarray(Image.open(path).convert("RGB"))
    assert len(np.unique(pixels.reshape(-1, 3), axis=0)) > 20


def test_plots_leave_out_what_a_logarithm_cannot_show(study, tmp_path):
    rows = [row | {"flip": None, "display_rms": 0.0} for row in study.rows]
    for error in ("flip", "display_rms"):
        Study(rows).plot(tmp_path / "plot.svg", error=error)
    assert (tmp_path / "plot.svg").read_text(encoding="utf-8").count("<svg") == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"kind": "pie"}, "kind: expected one of error-time, .*, got 'pie'"),
        ({"error": "feeling"}, "error: expected one of relative_rmse, .*, got 'feeling'"),
        ({"time": "years"}, "time: expected one of frame_ms, .*, got 'years'"),
        ({"path": "plot.jpg"}, "path: expected a name ending in .png, .svg or .pdf, got 'plot.jpg'"),
    ],
)
def test_wrong_plots_are_refused(study, arguments, message):
    with pytest.raises(ValueError, match=message):
        study.plot(**{"path": "plot.png", **arguments})


def test_differences_need_pictures(study, tmp_path):
    with pytest.raises(ValueError, match="plot: expected a study that kept its pictures, got none"):
        Study(study.rows).plot(tmp_path / "plot.png", "difference")


def test_a_missing_matplotlib_is_named_with_its_command(study, tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "matplotlib.figure", None)
    message = r"A plot needs the package matplotlib; install it with: pip install 'burnish\[study\]'"
    with pytest.raises(ImportError, match=message):
        study.plot(tmp_path / "plot.png")


def test_the_colours_span_nearly_all_differences():
    values = np.linspace(-0.04, 0.04, 1001).reshape(7, 143)
    assert difference_range([values]) == 0.05
    assert difference_range([np.full((2, 2), np.nan)]) == difference_range([]) == 0.005
    assert difference_range([np.full((2, 2), 7.0)]) == 1.0


def test_the_box_of_objects_has_a_margin_and_stays_inside():
    covered = np.zeros((10, 20), bool)
    covered[4, 0:6] = True
    assert object_box(covered) == (slice(2, 7), slice(0, 8))
    assert object_box(np.zeros((10, 20), bool)) == (slice(0, 10), slice(0, 20))


def test_titles_are_broken_at_their_dots():
    assert wrap_title("a · b · c", 5) == "a · b\nc"
    assert wrap_title("a long title of one part", 5) == "a long title of one part"


def test_json_rows_hold_plain_values_only(study):
    assert json.loads(json.dumps(study.rows, allow_nan=False)) == study.rows
