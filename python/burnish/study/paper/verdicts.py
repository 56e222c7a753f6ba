"""Verdicts on the paper's table and figures."""

from collections.abc import Callable
from itertools import pairwise

from burnish.study.paper.formula_verdicts import FORMULA_JUDGES
from burnish.study.paper.judging import (
    ALBEDO_TOLERANCE,
    LEAST_LINEARITY,
    MOST_SCATTER,
    REAL_TIME_MS,
    SHARE_TOLERANCE,
    TYPICAL_COUNT,
    Numbers,
    Verdict,
    error_ratios,
    factor_text,
    find_errors,
    find_scatter,
    fit_frames,
    geometric_mean,
    percent_text,
    scatter_remark,
)
from burnish.study.paper.settings import COMPARED, DIFFERENCES, FILTER_CELL, FILTERS, SHARES
from burnish.study.rows import format_value


def judge_pyramids(numbers: Numbers) -> list[Verdict]:
    """Judge Table 1."""
    times = {(row["face_size"], row["filter"]): row["ms"] for row in numbers["pyramids"]}
    sizes = sorted({size for size, _ in times})
    largest = sizes[-1]
    full = [
        row["shade"]["ms"]
        for row in numbers["frames"]
        if row["role"] == "published" and row["share"] == 1.0 and row["samples"] == TYPICAL_COUNT
    ]
    filtering = times[largest, "gauss6"]
    verdicts = []
    if full:
        share = filtering / full[0]
        verdicts.append(
            Verdict(
                "Table 1",
                "The MIP-map-based filtering step is efficient: the largest 6x6 pyramid takes less than "
                f"shading one frame of {TYPICAL_COUNT} samples, every pixel glossy.",
                "abstract",
                share < 1,
                f"{filtering:.3g} ms against {full[0]:.3g} ms",
                f"{share:.2f} of the frame's shading",
            )
        )
    noise = {(row["face_size"], row["filter"]): row["deviation_ms"] for row in numbers["pyramids"]}
    # Two times count as disordered only where they differ by more than their noise.
    ordered = all(
        times[size, a] < times[size, b] + noise[size, a] + noise[size, b]
        for size in sizes
        for a, b in pairwise(FILTERS)
    )
    scatter = find_scatter(numbers["pyramids"])
    ratios = [times[size, "gauss6"] / times[size, "box"] for size in sizes]
    listed = "; ".join(
        f"{size}: {' / '.join(f'{times[size, name]:.1f}' for name in FILTERS)} ms" for size in sizes
    )
    verdicts.append(
        Verdict(
            "Table 1",
            "A wider filter has its price: box < 4x4 < 6x6 at every size, within the noise.",
            "reading",
            ordered if scatter <= MOST_SCATTER else None,
            listed,
            f"6x6 takes {min(ratios):.2f} to {max(ratios):.2f} times the box, for 9 times as many taps"
            f"{scatter_remark(scatter)}",
        )
    )
    return verdicts + _judge_filters(numbers)


def _judge_filters(numbers: Numbers) -> list[Verdict]:
    ratios = error_ratios(numbers, FILTER_CELL, "published_box", "published")
    middle = error_ratios(numbers, FILTER_CELL, "published_gauss4", "published")
    if not ratios or not middle:
        return []
    return [
        Verdict(
            "Table 1",
            f"The 6x6 filter is worth its price: at {TYPICAL_COUNT} samples its error is below the box's.",
            "reading",
            geometric_mean(ratios) > 1,
            f"relative RMSE of the 4x4 is {factor_text(middle)} the 6x6's",
            f"the box's error is {factor_text(ratios)} the 6x6's",
        )
    ]


def judge_frames(numbers: Numbers) -> list[Verdict]:
    """Judge Fig. 7."""
    lines = fit_frames(numbers["frames"], "published")
    if set(lines) != set(SHARES):
        return []
    least = min(line.r_squared for line in lines.values())
    slopes = {share: line.slope for share, line in lines.items()}
    ratios = {share: slopes[share] / (share * slopes[1.0]) for share in SHARES[:-1]}
    worst = max(abs(ratio - 1) for ratio in ratios.values())
    rows = [
        row
        for row in numbers["frames"]
        if row["role"] == "published" and row["share"] == 1.0 and row["samples"] == TYPICAL_COUNT
    ]
    scatter = find_scatter([row["frame"] for row in numbers["frames"] if row["role"] == "published"])
    is_steady, remark = scatter <= MOST_SCATTER, scatter_remark(scatter)
    verdicts = [
        Verdict(
            "Fig. 7",
            "Frame time grows linearly with the number of samples, at 25, 50 and 100 % of the screen.",
            "reading",
            least >= LEAST_LINEARITY if is_steady else None,
            ", ".join(f"{share:.0%}: {line.slope:.2f} ms a sample" for share, line in lines.items()),
            f"least R² {least:.4f}, asked for {LEAST_LINEARITY}{remark}",
        ),
        Verdict(
            "Fig. 7",
            "A sample costs in proportion to the share of the screen that is glossy.",
            "reading",
            worst <= SHARE_TOLERANCE if is_steady else None,
            ", ".join(f"{share:.0%} costs {share * ratio:.2f} of 100 %" for share, ratio in ratios.items()),
            f"off by up to {percent_text(worst)}, allowed {percent_text(SHARE_TOLERANCE)}{remark}",
        ),
    ]
    if rows:
        time = rows[0]["frame"]["ms"]
        where = "a CPU driver" if numbers["is_software"] else "this device"
        height, width = numbers["settings"]["frame_size"]
        verdicts.append(
            Verdict(
                "Fig. 7",
                f"Real-time: {TYPICAL_COUNT} samples at {width} x {height}, every pixel glossy, in 1/30 s.",
                "abstract",
                time <= REAL_TIME_MS,
                f"{time:.1f} ms on {where}, {1000 / time:.1f} frames a second",
                f"{time / REAL_TIME_MS:.2f} times the time there is",
            )
        )
    return verdicts


def judge_comparison(numbers: Numbers) -> list[Verdict]:
    """Judge Figs. 8 and 10: regular against importance sampling at equal counts."""
    verdicts = []
    for cell in COMPARED:
        for error, name in (("display_rms", "display RMS"), ("relative_rmse", "relative RMSE")):
            plain, bias = (
                error_ratios(numbers, cell, other, "published", error)
                for other in ("importance", "importance_bias")
            )
            if not plain or not bias:
                continue
            # Importance sampling with the better of its two published mip biases is the fair opponent.
            best = min(plain, bias, key=geometric_mean)
            means = [
                geometric_mean(list(find_errors(numbers, cell, role, error).values()))
                for role in ("published", "importance", "importance_bias")
            ]
            verdicts.append(
                Verdict(
                    "Figs. 8 and 10",
                    f"At {cell} samples regular sampling has the smaller {name} than importance sampling.",
                    "abstract",
                    geometric_mean(best) > 1,
                    f"{means[0]:.4f} against {means[1]:.4f} (bias 0) and {means[2]:.4f} (bias +1)",
                    f"importance sampling's error is {factor_text(best)} the regular one's",
                )
            )
    return verdicts


def judge_differences(numbers: Numbers) -> list[Verdict]:
    """Judge Fig. 9: more samples, less difference, and nothing left in the end."""
    means = []
    for cell in DIFFERENCES:
        errors = find_errors(numbers, cell, "published", "display_rms")
        if not errors:
            return []
        means.append(geometric_mean(list(errors.values())))
    biases = [
        row["mean_error"]
        for row in numbers["pictures"]
        if row["cell"] == DIFFERENCES[-1] and row["role"] == "published" and row["mean_error"] is not None
    ]
    bias = sum(biases) / len(biases)
    counts = "14, 30 and 270"
    return [
        Verdict(
            "Fig. 9",
            "The difference from the reference shrinks from 14 over 30 to 270 samples.",
            "reading",
            means[0] > means[1] > means[2],
            f"display RMS {', '.join(format_value(mean) for mean in means)} at {counts}",
            f"{means[0] / means[1]:.2f} x less, then {means[1] / means[2]:.2f} x less",
        ),
        Verdict(
            "Fig. 9",
            "With many samples the picture becomes the reference: its mean is right within "
            f"{percent_text(ALBEDO_TOLERANCE)}.",
            "equations",
            abs(bias) <= ALBEDO_TOLERANCE,
            f"mean radiance at 270 samples {100 * bias:+.2f} %; "
            "the normalization's limit is truth over E[1/cos h]",
            f"off by {percent_text(abs(bias))}",
        ),
    ]


JUDGES: tuple[Callable[[Numbers], list[Verdict]], ...] = (
    judge_pyramids,
    judge_frames,
    judge_comparison,
    judge_differences,
    *FORMULA_JUDGES,
)


def list_verdicts(numbers: Numbers) -> list[Verdict]:
    """Judge everything.

    Parameters
    ----------
    numbers : dict
        As `Paper` has them.

    Returns
    -------
    verdicts : list of Verdict
        In the order of the paper, then its equations, then what is added today.
    """
    return [verdict for judge in JUDGES for verdict in judge(numbers)]
