"""A CPU device chooses between the driver's sampler and our own lookup by times, measured once and kept."""

import json
import os
from pathlib import Path

import pytest

import burnish
from burnish import environments
from burnish.doctor import examine
from burnish.rendering import plan as plan_of
from process_support import finish, start

MOST_RATIO = 1.1  # as the docstring of Device has it

SCRIPT = """
import json
import burnish

device = burnish.Device()
print(json.dumps([device.lookup, device.lookup_measurement]).replace(" ", ""))
"""


@pytest.fixture(autouse=True)
def chooses(device, monkeypatch):
    """Leave the choice to the device."""
    if not device.is_software:
        pytest.skip("a GPU reads by its sampler, unmeasured")
    monkeypatch.setenv("BURNISH_LOOKUP", "")


@pytest.fixture(scope="module")
def kept(device, tmp_path_factory):
    """What a process measured and left behind, as its file holds it."""
    if not device.is_software:
        pytest.skip("a GPU reads by its sampler, unmeasured")
    folder = tmp_path_factory.mktemp("measured") / "made when it is needed"
    finish(start(SCRIPT, BURNISH_CACHE=str(folder), BURNISH_LOOKUP=""))
    (path,) = folder.iterdir()
    return path


def device_after(kept, folder, monkeypatch, **changes):
    """Open a device where an earlier process kept something else; the file's new place, and the device."""
    path = folder / kept.name
    path.write_text(json.dumps(json.loads(kept.read_text()) | changes))
    monkeypatch.setenv("BURNISH_CACHE", str(folder))
    return path, burnish.Device()


def test_the_first_process_measures_and_the_next_reads_what_it_kept(kept, device):
    text = kept.read_text()
    written = json.loads(text)
    assert (written["device"], written["driver"]) == (device.name, device.driver)
    assert written["engine"] == burnish.__version__
    assert len(written["uuid"]) == 64 and written["sampler_ms"] > 0 and written["software_ms"] > 0
    lookup, measurement = json.loads(finish(start(SCRIPT, BURNISH_CACHE=str(kept.parent), BURNISH_LOOKUP="")))
    assert kept.read_text() == text and [kept] == list(kept.parent.iterdir())
    expected = "sampler" if written["software_ms"] > MOST_RATIO * written["sampler_ms"] else "software"
    assert lookup == expected
    assert measurement["sampler_ms"] == written["sampler_ms"] and measurement["date"] == written["date"]


def test_ours_is_left_only_where_it_takes_clearly_longer(kept, tmp_path, monkeypatch):
    for k, (ratio, expected) in enumerate(
        [(0.5, "software"), (1.08, "software"), (1.12, "sampler"), (3, "sampler")]
    ):
        folder = tmp_path / str(k)
        folder.mkdir()
        path, device = device_after(kept, folder, monkeypatch, sampler_ms=2.0, software_ms=2.0 * ratio)
        assert device.lookup == expected
        assert device.lookup_measurement == {
            "sampler_ms": 2.0,
            "software_ms": 2.0 * ratio,
            "ratio": pytest.approx(ratio),
            "date": json.loads(path.read_text())["date"],
            "kept_in": str(path),
        }


@pytest.mark.parametrize("ratio", [0.61, 1.32])
def test_report_plan_and_doctor_say_what_was_measured(kept, tmp_path, monkeypatch, ratio):
    path, device = device_after(
        kept, tmp_path, monkeypatch, sampler_ms=3.0, software_ms=3.0 * ratio, date="2026-01-02"
    )
    reason = (
        "the device is a CPU; on its driver lookups of our own take "
        f"{ratio} x the sampler's time, measured on 2026-01-02"
    )
    assert device.lookup_reason == reason
    scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)]))
    scene.environment = environments.spots(1, 32)
    for effects in (
        burnish.render(scene, size=(8, 8), device=device).report.effects,
        plan_of(scene, device=device)["effects"],
    ):
        (line,) = (one for one in effects if one["name"] == "software lookup")
        assert line == {"name": "software lookup", "on": ratio < 1, "reason": reason}
    (finding,) = (one for one in examine(device=device).findings if one.name == "lookup")
    assert finding.status == "ok" and finding.text == f"{device.lookup}: {reason}; kept in {path}"


@pytest.mark.parametrize(
    "damage",
    [
        lambda text: "",
        lambda text: text[: len(text) // 2],
        lambda text: "[]",
        lambda text: "null",
        lambda text: text.replace('"sampler_ms": ', '"sampler_ms": -'),
        lambda text: text.replace('"software_ms": ', '"software_ms": 0.0, "former": '),
        lambda text: text.replace('"date": "', '"date": 7, "former": "'),
        lambda text: text.replace('"driver": "', '"driver": "another '),
        lambda text: text.replace('"engine": "', '"engine": "0.0.'),
        lambda text: "\xff" + text,
    ],
)
def test_what_cannot_be_read_or_is_of_another_driver_is_measured_anew(kept, tmp_path, monkeypatch, damage):
    path = tmp_path / kept.name
    path.write_text(damage(kept.read_text()), encoding="latin-1")
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))
    device = burnish.Device()
    written = json.loads(path.read_text())
    assert written["driver"] == device.driver and written["sampler_ms"] > 0
    assert device.lookup_measurement["software_ms"] == written["software_ms"]


def test_a_folder_that_cannot_be_written_to_does_no_harm(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("no folder")
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "file" / "below"))
    measured = burnish.Device().lookup_measurement
    assert measured["kept_in"] == "" and measured["ratio"] > 0
    assert burnish.Device().lookup_measurement == measured  # once a process


def test_nothing_is_kept_where_that_is_switched_off(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.setenv("BURNISH_CACHE", "off")
    assert burnish.Device().lookup_measurement["kept_in"] == ""
    assert not (tmp_path / "burnish").exists()


def test_without_a_folder_of_its_own_it_is_the_users_cache(kept, tmp_path, monkeypatch):
    monkeypatch.setenv("BURNISH_CACHE", "")
    for name, caches in (("HOME", tmp_path / ".cache"), ("XDG_CACHE_HOME", tmp_path / "caches")):
        folder = caches / "burnish"
        folder.mkdir(parents=True)
        (folder / kept.name).write_text(kept.read_text())
        monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
        monkeypatch.setenv(name, str(tmp_path if name == "HOME" else caches))
        assert burnish.Device().lookup_measurement["kept_in"] == str(folder / kept.name)


def test_who_asks_for_a_lookup_gets_it_unmeasured(tmp_path, monkeypatch):
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))
    for device in (burnish.Device(lookup="sampler"), burnish.Device(lookup="software")):
        assert device.lookup_reason == "asked for" and device.lookup_measurement is None
    monkeypatch.setenv("BURNISH_LOOKUP", "sampler")
    assert burnish.Device().lookup_reason == "asked for"
    assert list(tmp_path.iterdir()) == []


def test_a_limit_on_memory_is_not_in_the_way(tmp_path, monkeypatch):
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))
    device = burnish.Device(memory_limit_bytes=2**20)
    assert device.lookup_measurement["ratio"] > 0
    assert device.memory_statistics()["bytes_reserved"] <= 2**20


def test_the_tests_themselves_have_one_lookup_for_all_devices(monkeypatch, device):
    monkeypatch.undo()
    assert os.environ["BURNISH_LOOKUP"] == device.lookup == burnish.Device().lookup
    assert Path(os.environ["BURNISH_CACHE"]).is_absolute()
