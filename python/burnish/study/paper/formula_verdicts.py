"""Verdicts on the paper's equations, and on what this engine adds to it."""

from burnish.study.paper.judging import (
    ALBEDO_TOLERANCE,
    FOOTPRINT_TOLERANCE,
    Numbers,
    Verdict,
    error_ratios,
    factor_text,
    geometric_mean,
    percent_text,
)
from burnish.study.paper.settings import COMPARED, MATCHED_MOST


def judge_counts(numbers: Numbers) -> list[Verdict]:
    """Judge the printed sample counts of eqs. 11 to 13."""
    verdicts = []
    for row in numbers["formulas"]["counts"]:
        printed, found = row["printed"], row["samples"]
        slopes = "/".join(dict.fromkeys(f"{slope:g}" for slope in row["roughness"]))
        verdicts.append(
            Verdict(
                "Eqs. 11 to 13",
                f"m {slopes}, xi0 {row['threshold']:g}{row['spacing']} gives {printed} samples.",
                "printed",
                found == printed,
                f"{found} samples",
                "exactly" if found == printed else f"by {abs(found - printed)} of {printed}",
            )
        )
    return verdicts


def judge_estimator(numbers: Numbers) -> list[Verdict]:
    """Judge eqs. 9, 17 and 18 under constant light, where the answer is known."""
    verdicts = []
    for row in numbers["formulas"]["furnace"]:
        off = row["clamped"] - 1
        verdicts.append(
            Verdict(
                "Eqs. 9, 17, 18",
                f"The estimator is right under constant light, m {row['slope']:g}, normal incidence.",
                "equations",
                abs(off) <= ALBEDO_TOLERANCE,
                f"{row['clamped']:.4f} of the exact albedo, with nearly the whole lobe in the pattern",
                f"{percent_text(abs(off))} too {'dark' if off < 0 else 'bright'}, "
                f"allowed {percent_text(ALBEDO_TOLERANCE)}",
            )
        )
    for row in numbers["formulas"]["horizon"]:
        off = row["printed"] - 1
        verdicts.append(
            Verdict(
                "Pseudo-code",
                f"The loop as printed is right at {row['degrees']:g} degrees, m {row['slope']:g}, although "
                "it lets light from below the surface count.",
                "equations",
                abs(off) <= ALBEDO_TOLERANCE,
                f"{row['printed']:.2f} of the exact albedo; with a clamp at the horizon {row['clamped']:.2f}",
                f"{percent_text(abs(off))} too {'dark' if off < 0 else 'bright'}",
            )
        )
    return verdicts


def judge_energy(numbers: Numbers) -> list[Verdict]:
    """Judge the lobe: no surface returns more light than it gets."""
    verdicts = []
    rows = numbers["formulas"]["energy"]
    for alpha in dict.fromkeys(row["alpha"] for row in rows):
        of_alpha = [row for row in rows if row["alpha"] == alpha]
        most = max(row["albedo"] for row in of_alpha)
        verdicts.append(
            Verdict(
                "Eqs. 1 to 5",
                f"The lobe with alpha {alpha:g} returns no more light than it gets at "
                f"{of_alpha[0]['degrees']:g} degrees.",
                "equations",
                most <= 1,
                ", ".join(f"albedo {row['albedo']:.2f} for m {row['slope']:g}" for row in of_alpha),
                f"{most:.2f} of the light at most",
            )
        )
    return verdicts


def judge_footprint(numbers: Numbers) -> list[Verdict]:
    """Judge eqs. 14 to 16 by what the exact solid angle does with the same pattern and weights."""
    verdicts = []
    for cell in COMPARED:
        ratios = error_ratios(numbers, cell, "published", "footprint")
        if ratios:
            mean = geometric_mean(ratios)
            verdicts.append(
                Verdict(
                    "Eqs. 14 to 16",
                    f"The mip level suits the sample's footprint, {cell} samples: no more than "
                    f"{percent_text(FOOTPRINT_TOLERANCE - 1)} above the exact one's error.",
                    "equations",
                    mean <= FOOTPRINT_TOLERANCE,
                    "relative RMSE, same pattern and weights",
                    f"{factor_text(ratios)} the error with the exact solid angle",
                )
            )
    return verdicts


def _judge_matched(numbers: Numbers, cell: str) -> list[Verdict]:
    published = error_ratios(numbers, cell, "published", "matched")
    importance = error_ratios(numbers, cell, "importance", "matched")
    if not published or not importance:
        return []
    count = min(int(cell), MATCHED_MOST)
    return [
        Verdict(
            "Today",
            f"Matched with {count} samples has less error than the paper's method with {cell}.",
            "today",
            geometric_mean(published) > 1,
            f"importance sampling with {cell} has {factor_text(importance)} the error of matched",
            f"the paper's method has {factor_text(published)} the error of matched",
        )
    ]


def _judge_prefiltered(numbers: Numbers, cell: str) -> list[Verdict]:
    ratios = error_ratios(numbers, cell, "prefiltered", "published")
    if not ratios:
        return []
    return [
        Verdict(
            "Today",
            f"The paper's method with {cell} samples has less error than one lookup in a prefiltered map.",
            "today",
            geometric_mean(ratios) > 1,
            "relative RMSE; the map is prefiltered for this roughness",
            f"the lookup has {factor_text(ratios)} its error",
        )
    ]


def judge_today(numbers: Numbers) -> list[Verdict]:
    """Compare what this engine adds with what the paper has."""
    return [
        verdict
        for judge in (_judge_matched, _judge_prefiltered)
        for cell in COMPARED
        for verdict in judge(numbers, cell)
    ]


FORMULA_JUDGES = (judge_counts, judge_estimator, judge_energy, judge_footprint, judge_today)
