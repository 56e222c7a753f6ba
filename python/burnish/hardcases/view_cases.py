"""Views and exponents: along the normal, along the surface and from behind; grazing powers and Fresnel."""

from functools import partial
from typing import Any

from burnish.hardcases.bounds import BRUSHED_BOUND, FRESNEL_BOUND, GRAZING_BOUND, HORIZON_BOUND
from burnish.hardcases.case import SAMPLERS, Bound, HardCase
from burnish.hardcases.inputs import around, from_above, seen_at
from burnish.hardcases.quantities import Shot, largest_value, same_picture, shot_of, twin_case, wild_values


def _near(name: str, why: str, lobe: dict[str, Any], other: dict[str, Any], bound: Bound) -> HardCase:
    """A lobe at the border between two forms of an equation, against the same lobe on the other side."""
    shot = shot_of("smooth", partial(around, 48, 0.2), **lobe)
    changed = (other,)
    quantity = same_picture(
        "relative step",
        shot,
        lambda bench, sampler: shot.measure(bench, sampler, lobes=changed),
        bound,
    )
    return HardCase(name, why, quantity, "maths 7", SAMPLERS)


def _at(cos_o: float) -> Any:
    return partial(seen_at, (cos_o,))


def view_cases() -> list[HardCase]:
    """Views along the normal, along the surface, and from behind."""
    lobe: dict[str, Any] = {"roughness": 0.1, "alpha": 0.5}
    return [
        twin_case(
            "view along the normal",
            "no plane of view: 0/0 in its azimuth",
            "maths 6",
            points=_at(1.0),
            **lobe,
        ),
        twin_case(
            "brushed lobe along the normal",
            "its width as seen from there is 0/0",
            "maths 6",
            BRUSHED_BOUND,
            _at(1.0),
            roughness=(0.3, 0.05),
        ),
        twin_case(
            "view 1e-4 off the normal",
            "an azimuth from small numbers",
            "maths 6",
            points=_at(1 - 5e-9),
            **lobe,
        ),
        twin_case(
            "view at 85 degrees",
            "eq. 16 is x5.9 off by the azimuth",
            "maths 4",
            GRAZING_BOUND,
            _at(0.0872),
            **lobe,
        ),
        twin_case(
            "view at 89.9 degrees",
            "most samples below the horizon",
            "maths 7",
            GRAZING_BOUND,
            _at(1.75e-3),
            **lobe,
        ),
        twin_case(
            "view at cos 1e-4",
            "h rebuilt from i + o is 5 % off",
            "maths 7",
            GRAZING_BOUND,
            _at(1e-4),
            is_alone=True,
            **lobe,
        ),
        twin_case(
            "view at cos 1e-6", "cos_o^-alpha without a floor", "maths 7", GRAZING_BOUND, _at(1e-6), **lobe
        ),
        twin_case(
            "narrow lobe at cos 1e-4",
            "the albedo changes within 1e-3",
            "maths 7",
            HORIZON_BOUND,
            _at(1e-4),
            roughness=1e-3,
        ),
        twin_case(
            "brushed lobe at cos 1e-3",
            "samples on both sides of the horizon",
            "maths 7",
            GRAZING_BOUND,
            _at(1e-3),
            roughness=(0.3, 0.05),
            alpha=0.5,
        ),
        twin_case(
            "very brushed lobe at cos 1e-3",
            "too brushed for a table by view: samples below the horizon, placed at the point",
            "maths 7",
            GRAZING_BOUND,
            _at(1e-3),
            roughness=(0.9, 0.05),
            alpha=0.5,
        ),
        HardCase(
            "view at 90 degrees", "o.h = 0", largest_value(Shot("smooth", _at(0.0), (lobe,))), "maths 7"
        ),
        HardCase(
            "view from behind, widest lobe",
            "half-vectors that face the eye all the same",
            largest_value(Shot("smooth", _at(-0.05), ({"roughness": 1.0, "alpha": 1.0},))),
            "maths 7",
        ),
        HardCase(
            "view from straight behind",
            "cos_i of either sign",
            largest_value(Shot("smooth", _at(-1.0), (lobe,))),
            "maths 7",
        ),
    ]


def exponent_cases() -> list[HardCase]:
    """Grazing exponents and Fresnel, at grazing angles and at the borders between their forms."""
    power = Bound(
        {**dict.fromkeys(SAMPLERS, 1e-5), "matched": 1e-4, "prefiltered": 1e-4},
        "the power itself changes by 4e-6 and pow is 50 ULP off on lavapipe, 3e-6; between two views the "
        "albedo's table is linear in cos_o for alpha 0, in its root else",
    )
    cases = [
        twin_case(
            f"alpha {alpha:g}, view at cos 0.01",
            "cos_i/(cos_i cos_o)^alpha is NaN below the horizon",
            "maths 7",
            GRAZING_BOUND,
            _at(0.01),
            roughness=0.3,
            alpha=alpha,
        )
        for alpha in (0.0, 0.5, 1.0)
    ] + [
        twin_case(
            f"alpha {alpha:g}, view at cos 1e-4",
            "pow(0, 0) at the horizon",
            "maths 7",
            GRAZING_BOUND,
            _at(1e-4),
            roughness=0.3,
            alpha=alpha,
        )
        for alpha in (0.0, 0.5, 1.0)
    ]
    return [
        *cases,
        HardCase(
            "alpha 1, all views",
            "1/cos_o up to 1e4",
            wild_values(
                Shot(
                    "spots",
                    partial(seen_at, (1.0, 0.5, 0.01, 1e-3, 1e-5, 1e-7)),
                    ({"roughness": 1.0, "alpha": 1.0},),
                )
            ),
            "maths 7",
        ),
        _near(
            "alpha 1e-6 against 0",
            "pow instead of the plain cosine",
            {"alpha": 1e-6},
            {"alpha": 0.0},
            power,
        ),
        _near(
            "alpha 0.5 + 1e-6 against 0.5",
            "pow instead of the square root",
            {"alpha": 0.500001},
            {"alpha": 0.5},
            power,
        ),
        _near(
            "alpha 1 - 1e-6 against 1",
            "cos_i^0 below the horizon",
            {"alpha": 0.999999},
            {"alpha": 1.0},
            power,
        ),
        _near(
            "r0 1 - 1e-6 against 1",
            "Fresnel's second sum, absent for r0 = 1",
            {"r0": 0.999999},
            {"r0": 1.0},
            Bound(1e-5, "Fresnel changes by 1e-6"),
        ),
        twin_case("r0 0", "the first sum is 0", "maths 1", FRESNEL_BOUND, r0=0.0),
        twin_case(
            "r0 0 along the normal",
            "reflects (1 - o.h)^5 of almost nothing",
            "maths 1",
            FRESNEL_BOUND,
            _at(1.0),
            roughness=0.2,
            r0=0.0,
        ),
        HardCase(
            "r0 0, straight from above",
            "products of unit vectors above 1: powers of negative numbers",
            wild_values(Shot("smooth", from_above, ({"roughness": 0.01, "r0": 0.0},))),
            "maths 1",
        ),
        twin_case(
            "r0 0, 0.5 and 1 by channel",
            "weights by channel",
            "maths 1",
            r0=(0.0, 0.5, 1.0),
            roughness=0.3,
            alpha=0.5,
        ),
        twin_case(
            "dielectric at cos 0.01",
            "Fresnel from 0.04 to 1 within a lobe",
            "maths 1",
            GRAZING_BOUND,
            _at(0.01),
            r0=0.04,
            roughness=0.2,
        ),
        HardCase(
            "weight 0",
            "0/0 where sums are divided",
            largest_value(Shot("spots", around, ({"roughness": 0.1, "weight": 0.0},))),
            "maths 3",
        ),
    ]


CASES = [*view_cases(), *exponent_cases()]
