"""Bounds that several cases share, each with its reason."""

from burnish.hardcases.case import Bound

CORNERS = 5e-5

TWIN_BOUND = Bound(
    {"regular": 5e-6, "importance": 5e-6, "matched": 1.05e-4, "prefiltered": 1.05e-4, "reference": 1.2e-3},
    "some ten roundings of 6e-8, and a lookup placed within 1e-6 of its face; matched and prefiltered are "
    "also scaled to the albedo's table, within 1e-4 for round lobes, which adds to these; the reference "
    "takes a texel's solid angle at its middle, 1e-3 off on faces of 32; corners of the software lookup add "
    "5e-5",
    corners=CORNERS,
)
WILD_BOUND = Bound(0.0, "radiance is a number and no less than 0, always")
SAME_BITS = Bound(0.0, "the same operations on the same numbers")
GRAZING_BOUND = Bound(
    {"regular": 5e-6, "importance": 5e-6, "matched": 2e-4, "prefiltered": 2e-4, "reference": 1.2e-3},
    "as for other views: the form in slopes loses nothing at grazing angles; the albedo's table is within "
    "2e-4 for slopes from 0.05",
    corners=CORNERS,
)
HORIZON_BOUND = Bound(
    {"regular": 5e-6, "importance": 5e-6, "matched": 3e-3, "prefiltered": 3e-3},
    "a lobe's albedo changes its course where cos_o is its slope: of 1e-3 the table has four views, and is "
    "1e-3 off between the first",
)
FRESNEL_BOUND = Bound(
    {"regular": 3e-5, "importance": 3e-5, "matched": 1e-3, "prefiltered": 1e-3, "reference": 1.2e-3},
    "of (1 - o.h)^5 alone, which is next to nothing along the normal, rounding leaves 1e-5 and the "
    "albedo's table 1e-3",
)
BRUSHED_BOUND = Bound(
    {"regular": 3e-5, "importance": 3e-5, "matched": 1e-3, "prefiltered": 1e-3, "reference": 1.2e-3},
    "as for round lobes; the albedo's table of brushed ones has 33 widths as well, and is within 1e-3",
)
