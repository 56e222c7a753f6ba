"""Hard cases on a second driver, SwiftShader, where it is installed: other arithmetic, least limits."""

import json
from pathlib import Path

import pytest

from process_support import finish, start

DRIVER = Path("/usr/lib/chromium/vk_swiftshader_icd.json")
# The driver is chosen when a process first asks for one. Samplers whose kernels it compiles within a second.
SCRIPT = """
import json
import sys
from pathlib import Path

import burnish
from burnish import hardcases

device = burnish.Device()
bench = hardcases.Bench(device)
rows = [(case, sampler) for case, sampler in hardcases.rows() if sampler in ("regular", "importance", "")]
measured = [hardcases.measure(case, sampler, bench) for case, sampler in rows]
scene = burnish.Scene.sphere(burnish.Material(lobes=[burnish.KurtLobe(roughness=0.2)]))
scene.environment = bench.light("spots")
frame = burnish.render(scene, size=(16, 16), sampler=burnish.Regular(14), device=device)
found = {
    "device": device.name,
    "lookup": device.lookup,
    "count": len(measured),
    "failures": [f"{m.case}, {m.sampler}: {m.measured} {m.note}" for m in measured if not m.passed],
    "reason": frame.report.classes[0]["reason"],
}
Path(sys.argv[1]).write_text(json.dumps(found))
print("written")
"""


@pytest.fixture(scope="module")
def swiftshader(tmp_path_factory):
    if not DRIVER.exists():
        pytest.skip(f"{DRIVER} is not there; apt-get install chromium brings it")
    written = tmp_path_factory.mktemp("swiftshader") / "found.json"
    # Its own sampler is broken in compute shaders.
    finish(start(SCRIPT, str(written), VK_DRIVER_FILES=str(DRIVER), BURNISH_LOOKUP=""))
    return json.loads(written.read_text())


def test_hard_cases_are_within_their_bounds(swiftshader):
    assert "SwiftShader" in swiftshader["device"] and swiftshader["lookup"] == "software"
    assert swiftshader["count"] > 200
    assert swiftshader["failures"] == []


def test_it_is_spared_kernels_that_it_compiles_for_minutes(swiftshader):
    assert "one after the other, which compiles soonest" in swiftshader["reason"]
