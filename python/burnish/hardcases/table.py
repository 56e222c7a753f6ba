"""The table of hard cases as text and as Markdown."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from burnish.hardcases.case import SAMPLERS, HardCase, Measurement


def _figure(value: float) -> str:
    return "-" if value != value else f"{value:.2g}"


def _cell(measurement: Measurement | None) -> str:
    """Measured and bound; bold where it failed."""
    if measurement is None:
        return ""
    text = f"{_figure(measurement.measured)} / {_figure(measurement.bound)}"
    return text if measurement.passed else f"**{text} {measurement.verdict}**"


def _markdown(header: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    lines = [header, ["---"] * len(header), *rows]
    return [f"| {' | '.join(line)} |" for line in lines]


@dataclass(frozen=True)
class Table:
    """What was measured on one device; ``print`` it.

    Parameters
    ----------
    device, driver, lookup : str
        What the cases ran on, and how maps were read.
    measurements : tuple of Measurement
        In the catalogue's order.
    """

    device: str
    driver: str
    lookup: str
    measurements: tuple[Measurement, ...]

    @property
    def failures(self) -> list[Measurement]:
        """Those beyond their bounds that are not known to be."""
        return [m for m in self.measurements if m.verdict == "fail"]

    @property
    def summary(self) -> str:
        """How many rows of how many are within their bounds."""
        verdicts = [m.verdict for m in self.measurements]
        cases = len({m.case for m in self.measurements})
        text = f"{verdicts.count('pass')} of {len(verdicts)} rows, of {cases} cases, within their bounds"
        known = verdicts.count("known failure")
        return f"{text}; {known} known to fail on this driver" if known else text

    def __str__(self) -> str:
        width = max((len(m.case) for m in self.measurements), default=0)
        lines = [
            f"  [{m.verdict:^13}] {m.case:<{width}}  {m.sampler or '-':<11}  bound {_figure(m.bound):<8}"
            f"  measured {_figure(m.measured):<8}  {m.quantity}{': ' + m.note if m.note else ''}"
            for m in self.measurements
        ]
        return "\n".join([f"hard cases on {self.device}, lookup {self.lookup}:", *lines, f"{self.summary}."])

    def to_markdown(self) -> str:
        """Two tables of "measured / bound": cases with a column for each sampler, and cases without."""
        found = {(m.case, m.sampler): m for m in self.measurements}
        names = dict.fromkeys((m.case, m.quantity) for m in self.measurements)
        sampled = [name for name in names if (name[0], "") not in found]
        single = [name for name in names if (name[0], "") in found]
        lines = [
            f"## {self.device}, lookup by {self.lookup}",
            "",
            f"Driver {self.driver}: {self.summary}.",
            "",
        ]
        if sampled:
            rows = [[case, what, *(_cell(found.get((case, s))) for s in SAMPLERS)] for case, what in sampled]
            lines += [*_markdown(("case", "quantity", *SAMPLERS), rows), ""]
        if single:
            lines += _markdown(
                ("case", "quantity", "measured / bound"), [(c, w, _cell(found[c, ""])) for c, w in single]
            )
            lines += [""]
        known = dict.fromkeys(m.known for m in self.measurements if m.verdict == "known failure")
        lines += [f"Known failures: {reason}." for reason in known]
        lines += [f"- {m.case}, {m.sampler or 'no sampler'}: {m.note}" for m in self.measurements if m.note]
        return "\n".join(lines).rstrip() + "\n"


INTRODUCTION = """# Hard cases

The worst inputs known, each with a number that is measured and the most that it may be. Made by
`burnish doctor --hard-cases --lookup both -o docs/hard-cases.md`; tests measure the same on every run.
"""


def catalogue_markdown(cases: Sequence[HardCase]) -> str:
    """What each case is there for, and why its bound is what it is."""
    reasons = list(dict.fromkeys(case.limit.reason for case in cases))
    rows = [(c.name, c.why, c.source, str(reasons.index(c.limit.reason) + 1)) for c in cases]
    lines = ["## The cases", "", *_markdown(("case", "what breaks without care", "source", "bound"), rows)]
    lines += ["", "Why the bounds are what they are:", ""]
    lines += [f"{k}. {reason}." for k, reason in enumerate(reasons, 1)]
    return "\n".join(lines) + "\n"


def page(tables: Sequence[Table], cases: Sequence[HardCase]) -> str:
    """The whole page: tables by device, then the catalogue.

    Parameters
    ----------
    tables : sequence of Table
        What was measured.
    cases : sequence of HardCase
        The catalogue that they were measured of.
    """
    return "\n".join([INTRODUCTION, *(table.to_markdown() for table in tables), catalogue_markdown(cases)])
