"""Make matched.txt, the mixtures of the sampler `matched`: python -m burnish.tables.fit_matched.

For every count, mixtures are fitted to lobes of all aspects from several starts, and the candidate is kept
whose lookups err least on training environments. Needs scipy (extra `fit`). The same seed gives the same
table.
"""

import argparse
from itertools import product
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from tqdm import tqdm

from burnish.images.files import write_text
from burnish.oracle.matched_table import COUNTS, TABLE_PATH, mixture_at
from burnish.oracle.spherical_pyramid import PREFILTER_SAMPLES
from burnish.tables.fit_objective import Mixtures, copies, fit, quantiser
from burnish.tables.fit_selection import Training, make_training, score

Float64 = NDArray[np.float64]

# Aspects whose quantisers are starts, relative errors of a kernel to fit for, weights of the moments:
# more weight on them keeps long lobes long, less leaves fewer gaps in them.
_START_ASPECTS = (4.5, 8.0, 15.0)
_KERNEL_ERRORS = (0.1, 0.15)
_MOMENT_WEIGHTS = (3.0, 1.0)
# Fewer samples than this would shrink long lobes to a third if their moments weighed less.
_LEAST_LIGHT_MOMENTS = 6

_HEADER = """\
// Mixtures of Gaussians that `matched` places over a lobe, for its counts of samples and 40 aspects.
// Made by: python -m burnish.tables.fit_matched{arguments}
// A row is one half-sample, y1, y2, s, w: centre along the major and the minor axis of the lobe
// exp(-y1^2 - y2^2), each in that axis' unit; standard deviation s in units of the minor axis; weight.
// It stands for the two samples (y, -y), each of this s and this w; of an odd count the first row is the one
// sample at 0. The weights of all n samples sum to 1.
// Order: for n in {counts}:
// for aspect rho_j = 34^(j/39), j = 0..39: for k = 0..ceil(n/2)-1.
"""


def rows_of(mixtures: Mixtures) -> Float64:
    """Rows y1, y2, s, w of the table, (aspects, half, 4); weights of all samples sum to 1."""
    w = mixtures.share / np.sum(copies(mixtures.samples) * mixtures.share, axis=1, keepdims=True)
    return np.stack([mixtures.y1, mixtures.y2, np.exp(mixtures.log_s), w], axis=-1)


def best_rows(samples: int, training: Training, seed: int, iterations: int, bar: "tqdm[None]") -> Float64:
    """Rows of the candidate that errs least in `training`."""
    best, kept = np.inf, None
    moment_weights = _MOMENT_WEIGHTS if samples >= _LEAST_LIGHT_MOMENTS else _MOMENT_WEIGHTS[:1]
    for aspect, kernel_error, moment_weight in product(_START_ASPECTS, _KERNEL_ERRORS, moment_weights):
        start = quantiser(samples, aspect, seed)
        rows = rows_of(fit(start, kernel_error, moment_weight, iterations)[1])
        value = score(training, samples, rows)
        if value < best:
            best, kept = value, rows
            bar.write(f"n {samples}: {value:.4f} from {aspect}, eps {kernel_error}, lambda {moment_weight}")
    assert kept is not None
    return kept


def format_rows(rows: Float64) -> str:
    """Text of (..., 4) rows, six significant digits."""
    return "".join(f"{y1:.6g}, {y2:.6g}, {s:.6g}, {w:.6g},\n" for y1, y2, s, w in rows.reshape(-1, 4))


def main() -> None:
    """Parse the command line, fit every count, write the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--output", type=Path, default=TABLE_PATH)
    parser.add_argument("--seed", type=int, default=101, help="of starts, training environments and points")
    parser.add_argument("--iterations", type=int, default=1000, help="of L-BFGS, at most, per start")
    arguments = parser.parse_args()
    with tqdm(total=len(COUNTS), unit="count") as bar:
        bar.set_description("training maps")
        # The table makes the pyramid it is read from: here a first fit does.
        start = quantiser(PREFILTER_SAMPLES, _START_ASPECTS[0], arguments.seed)
        first = rows_of(fit(start, _KERNEL_ERRORS[0], _MOMENT_WEIGHTS[0], arguments.iterations)[1])
        training = make_training(arguments.seed, mixture_at(first, PREFILTER_SAMPLES, 1.0))
        text = []
        for samples in COUNTS:
            bar.set_description(f"{samples} samples")
            text.append(format_rows(best_rows(samples, training, arguments.seed, arguments.iterations, bar)))
            bar.update()
    changed = "".join(
        f" --{name} {getattr(arguments, name)}"
        for name in ("seed", "iterations")
        if getattr(arguments, name) != parser.get_default(name)
    )
    header = _HEADER.format(arguments=changed, counts=", ".join(map(str, COUNTS)))
    write_text(arguments.output, header + "".join(text))


if __name__ == "__main__":
    main()
