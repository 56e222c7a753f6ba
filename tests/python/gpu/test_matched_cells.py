"""`Matched` loses in no cell of a small judge: brushed and narrow lobes at grazing views, few samples.

`scripts/cells.py` judges all lobes, maps and counts.
"""

import numpy as np
import pytest

from burnish.environments import spots
from burnish.study.cells import BANDS, LOBES, Cell, as_rows, band_points, judge, limit, merge_kinds, rivals

# The second one lost with mixtures that fit the lobe alone, by 1.7 at grazing views.
BRUSHED = {name: LOBES[name] for name in ("m .2/.075", "m .3/.06")}


def test_no_published_sampler_errs_less_on_brushed_lobes(device):
    cells = judge({"spots 41": lambda: spots(41, 256)}, BRUSHED, counts=(8,), points=80, device=device)
    assert len(cells) == len(BRUSHED) * len(BANDS)
    behind = [f"{cell.name}: {cell.ratio:.2f}" for cell in cells if cell.ratio > limit(LOBES[cell.lobe])]
    assert not behind


def test_points_lie_in_their_bands(rng):
    for (low, high), group in zip(BANDS, band_points(spots(1, 16), LOBES["m .1"], 50, rng), strict=True):
        cosine = np.sum(group.normals * group.views, axis=1)
        assert cosine.shape == (50,)
        assert np.all((cosine > low - 1e-6) & (cosine < high + 1e-6))
        assert np.ptp(cosine) > 0.8 * (high - low)


def test_rivals_are_the_published_samplers_at_every_setting():
    texts = [str(sampler) for sampler in rivals(14)]
    assert len(texts) == len(set(texts)) == 10
    assert all("samples=14" in text for text in texts)


def test_a_cell_knows_its_ratio_and_its_name():
    cell = Cell("m .05", 0, "sky", 8, 0.3, (("Regular(...)", 0.4), ("Importance(...)", 0.2)))
    assert cell.ratio == pytest.approx(1.5)
    assert cell.rival_sampler == "Importance(...)"
    assert cell.name == "m .05, cosine 0.005 to 0.1, sky, n = 8"
    assert as_rows([cell])[0]["ratio"] == pytest.approx(1.5)


def test_cells_of_a_kind_are_geometric_means_of_every_setting():
    # The rival of the kind is one setting: not each map's own best.
    one = Cell("m .05", 0, "sky", 8, 0.1, (("a", 0.1), ("b", 0.4)))
    other = Cell("m .05", 0, "noon", 8, 0.4, (("a", 0.9), ("b", 0.1)))
    (cell,) = merge_kinds([one, other], {"sky": "suns", "noon": "suns"})
    assert cell.environment == "suns" and cell.rival_sampler == "b"
    assert cell.matched == pytest.approx(0.2) and cell.rival == pytest.approx(0.2)


def test_long_lobes_may_lose_by_a_tenth():
    assert limit(LOBES["m .05"]) == limit(LOBES["m .3/.06"]) == 1.0
    assert limit(LOBES["m .4/.03"]) == 1.1


def test_truths_are_kept_for_later_runs(tmp_path, device):
    arguments = {"lobes": {"m .3": LOBES["m .3"]}, "counts": (5,), "points": 10}
    environments = {"spots": lambda: spots(1, 16)}
    first = judge(environments, **arguments, device=device, truths=tmp_path)
    (kept,) = tmp_path.iterdir()
    np.save(kept, 2 * np.load(kept))
    second = judge(environments, **arguments, device=device, truths=tmp_path)
    assert all(one.matched != other.matched for one, other in zip(first, second, strict=True))
