"""Make the mixtures of the sampler `matched`: python -m burnish.tables.fit_matched.

matched.txt is for lobes of Gaussian density: for every count, mixtures are fitted to lobes of all aspects
from several starts, and the candidate is kept whose lookups err least on training environments. student.txt
(--density student) is for lobes with tails, of density (1 + r^2)^-2: the one of the least loss is kept.
Needs scipy (extra `fit`). The same seed gives the same table.
"""

import argparse
import math
import os
from concurrent.futures import ProcessPoolExecutor, as_completed
from itertools import product
from multiprocessing import get_context
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from burnish.images.files import write_text
from burnish.oracle.matched_table import (
    ASPECT_COUNT,
    COUNTS,
    LARGEST_ASPECT,
    STUDENT_PATH,
    STUDENT_STEP,
    STUDENT_WINDOWS,
    TABLE_PATH,
    mixture_at,
)
from burnish.oracle.spherical_pyramid import PREFILTER_SAMPLES
from burnish.tables.fit_objective import (
    SHORT_MOMENT,
    Mixtures,
    copies,
    fit,
    quantiser,
    short_share,
)
from burnish.tables.fit_selection import Training, make_training, score
from burnish.tables.fit_target import ASPECTS, student_target

Float64 = NDArray[np.float64]

# Aspects whose quantisers are starts, relative errors of a kernel to fit for.
_START_ASPECTS = (4.5, 8.0, 15.0)
_KERNEL_ERRORS = (0.1, 0.15)
# Fewer samples than this miss the moments of short lobes by a fiftieth with the greater kernel error.
_FEW = 6
# Weight of the moments; the fewest samples would else miss them by as much with either.
_MOMENT_WEIGHT = 0.7
_MOMENT_WEIGHTS_OF_FEW = {2: 3.0, 3: 3.0, 4: 1.0, 5: 0.5}
# Added to the seed of the starts: of candidates whose errors are alike, ones that keep the lobe's covariance
# and with which neighbouring pixels of wide round lobes differ little, which is chance.
_SEED_STEPS = {8: 3, 12: 3, 14: 1, 16: 1}
# The most samples whose centres are a pair and the middle.
_MOST_ON_A_LINE = 3
# Variances of a short lobe, of 1/2, may be missed by so much at most.
_MOST_MISSED = 0.02
# Many unknowns take more iterations.
_ITERATIONS_A_SAMPLE = 16

# Of lobes with tails: aspects whose quantisers are starts, and the weight of the mass.
_STUDENT_ASPECTS = (2.0, 6.0, 15.0)
_MASS_WEIGHT = 3.0

_HEADER = """\
// Mixtures of Gaussians that `matched` places over a lobe, for its counts of samples and {nodes} aspects.
// Made by: python -m burnish.tables.fit_matched{arguments}
// A row is one half-sample, y1, y2, s, w: centre along the major and the minor axis of the lobe
// {density}, each in that axis' unit; standard deviation s in units of the minor axis; weight.
// It stands for the two samples (y, -y), each of this s and this w; of an odd count the first row is the one
// sample at 0. The weights of all n samples sum to 1.
// Order: {windows}for n in {counts}:
// for aspect rho_j = {largest:g}^(j/{last}), j = 0..{last}: for k = 0..ceil(n/2)-1.
"""


def rows_of(mixtures: Mixtures) -> Float64:
    """Rows y1, y2, s, w of the table, (aspects, half, 4); weights of all samples sum to 1."""
    w = mixtures.share / np.sum(copies(mixtures.samples) * mixtures.share, axis=1, keepdims=True)
    return np.stack([mixtures.y1, mixtures.y2, np.exp(mixtures.log_s), w], axis=-1)


def with_exact_moments(samples: int, rows: Float64) -> Float64:
    """Move the centres of short lobes' samples until the mixture has the lobe's second moments.

    What the fit leaves, some thousandths, turns with the plane of view, where pixels of a smooth picture show
    it around the normal. With C the covariance of the centres in units of the axes, S that of the widths and
    T = 1/2 - S, centres y become A y, A = T^1/2 (T^1/2 C T^1/2)^-1/2 T^1/2: the least motion that makes
    A C A^T = T. The farther an aspect is from short (`short_share`), the less of it is done. Up to 3 samples
    lie on one line, which no motion spreads.
    """
    if samples <= _MOST_ON_A_LINE:
        return rows
    result = rows.copy()
    weights = rows[..., 3] * copies(samples)
    for node, share in enumerate(short_share(samples, SHORT_MOMENT)):
        y, spread = rows[node, :, :2], np.sum(weights[node] * rows[node, :, 2] ** 2)
        wanted = np.diag(0.5 - spread / np.array([ASPECTS[node] ** 2, 1.0]))
        if wanted[1, 1] <= 0.0:
            continue
        root = np.sqrt(wanted)
        values, vectors = np.linalg.eigh(root @ ((weights[node] * y.T) @ y) @ root)
        move = root @ (vectors / np.sqrt(values)) @ vectors.T @ root
        result[node, :, :2] = y + share * (y @ move.T - y)
    return result


def missed_variance(samples: int, rows: Float64) -> float:
    """Most that a variance of a short lobe, along or across, differs from 1/2."""
    short = ASPECTS[2 * ASPECTS <= samples]
    if not len(short):
        return 0.0
    mixture = mixture_at(rows, samples, short)
    across = np.sum(mixture.w * (mixture.y2**2 + mixture.s**2), axis=-1)
    along = np.sum(mixture.w * (mixture.y1**2 + (mixture.s / short[:, None]) ** 2), axis=-1)
    return float(np.max(np.abs(np.stack([across, along]) - 0.5)))


def best_rows(samples: int, training: Training, seed: int, iterations: int) -> Float64:
    """Rows of the candidate that errs least in `training`."""
    best, kept = np.inf, None
    moment_weight = _MOMENT_WEIGHTS_OF_FEW.get(samples, _MOMENT_WEIGHT)
    kernel_errors = _KERNEL_ERRORS if samples >= _FEW else _KERNEL_ERRORS[:1]
    for aspect, kernel_error in product(_START_ASPECTS, kernel_errors):
        start = quantiser(samples, aspect, seed + _SEED_STEPS.get(samples, 0))
        most = max(iterations, _ITERATIONS_A_SAMPLE * samples)
        rows = with_exact_moments(samples, rows_of(fit(start, kernel_error, moment_weight, most)[1]))
        value = score(training, samples, rows)
        if value < best and missed_variance(samples, rows) < _MOST_MISSED:
            best, kept = value, rows
    assert kept is not None
    return kept


def student_rows(window: float, samples: int, seed: int, iterations: int) -> Float64:
    """Rows of the candidate of the least loss for a lobe with a tail."""
    target = student_target(window)
    most = max(iterations, _ITERATIONS_A_SAMPLE * samples)
    starts = [quantiser(samples, aspect, seed, target) for aspect in _STUDENT_ASPECTS]
    fits = [fit(start, _KERNEL_ERRORS[1], _MASS_WEIGHT, most, target) for start in starts]
    return rows_of(min(fits, key=lambda one: one[0])[1])[::STUDENT_STEP]


def format_rows(rows: Float64) -> str:
    """Text of (..., 4) rows, six significant digits."""
    return "".join(f"{y1:.6g}, {y2:.6g}, {s:.6g}, {w:.6g},\n" for y1, y2, s, w in rows.reshape(-1, 4))


def main() -> None:
    """Parse the command line, fit every count, write the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--density",
        choices=("gaussian", "student"),
        default="gaussian",
        help="of the lobes (default: gaussian)",
    )
    parser.add_argument("--output", type=Path, help="(default: the committed file)")
    parser.add_argument("--seed", type=int, default=101, help="of starts, training environments and points")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="processes (default: one a core)")
    parser.add_argument(
        "--iterations", type=int, default=600, help="of L-BFGS, at most, per start (default: 600)"
    )
    arguments = parser.parse_args()
    seed, iterations = arguments.seed, arguments.iterations
    is_student = arguments.density == "student"
    windows = STUDENT_WINDOWS if is_student else (math.inf,)
    if not is_student:
        # The table makes the pyramid it is read from: here a first fit does.
        start = quantiser(PREFILTER_SAMPLES, _START_ASPECTS[0], seed)
        first = rows_of(fit(start, _KERNEL_ERRORS[0], _MOMENT_WEIGHT, iterations)[1])
        training = make_training(seed, mixture_at(first, PREFILTER_SAMPLES, 1.0))
    text = {}
    keys = [(window, samples) for samples in reversed(COUNTS) for window in windows]  # the longest first
    with ProcessPoolExecutor(arguments.jobs, mp_context=get_context("fork")) as pool:
        jobs = {
            pool.submit(student_rows, *key, seed, iterations)
            if is_student
            else pool.submit(best_rows, key[1], training, seed, iterations): key
            for key in keys
        }
        for job in tqdm(as_completed(jobs), total=len(jobs), unit="fit"):
            text[jobs[job]] = format_rows(job.result())
    changed = "".join(
        f" --{name} {getattr(arguments, name)}"
        for name in ("density", "seed", "iterations")
        if getattr(arguments, name) != parser.get_default(name)
    )
    nodes = (ASPECT_COUNT - 1) // STUDENT_STEP + 1 if is_student else ASPECT_COUNT
    named = ", ".join(f"{window:g}" for window in windows)
    header = _HEADER.format(
        arguments=changed,
        counts=", ".join(map(str, COUNTS)),
        nodes=nodes,
        largest=LARGEST_ASPECT,
        last=nodes - 1,
        density="(1 + r^2)^-2 exp(-r^2/(2 R^2))" if is_student else "exp(-y1^2 - y2^2)",
        windows=f"for R in {named}: " if is_student else "",
    )
    output = arguments.output or (STUDENT_PATH if is_student else TABLE_PATH)
    write_text(output, header + "".join(text[window, n] for window in windows for n in COUNTS))


if __name__ == "__main__":
    main()
