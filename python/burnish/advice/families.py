"""The samplers that are considered, as families whose errors fall together with the count."""

from dataclasses import dataclass

from burnish.oracle.matched_table import COUNTS


@dataclass(frozen=True)
class Family:
    """One sampler at several counts.

    Parameters
    ----------
    text : str
        The sampler, with ``{}`` for the count.
    counts : tuple of int
        Those that are considered, rising.
    timed_counts : tuple of int
        Those at which the cost model times it; straight lines between them give the others.
    splits_suns : bool
        Whether suns are taken out of the map and become lights.
    """

    text: str
    counts: tuple[int, ...]
    timed_counts: tuple[int, ...]
    splits_suns: bool = False


FAMILIES: dict[str, Family] = {
    "matched": Family("matched:{}", COUNTS, (5, 20), splits_suns=True),
    "regular": Family("regular:{}", (8, 14, 19, 30, 48, 64), (8, 30)),
    # Beyond 80 lookups are a loop: another line.
    "importance": Family(
        "importance:{}:fibonacci",
        (8, 14, 30, 64, 96, 128, 192, 256, 384, 512, 768, 1024),
        (14, 64, 512),
    ),
    "prefiltered": Family("prefiltered", (1,), (1,)),
}


def sampler_text(family: str, count: int) -> str:
    """Name a sampler of a family.

    Parameters
    ----------
    family : str
        A key of `FAMILIES`.
    count : int
        Lookups a lobe; of no account where there is one.
    """
    return FAMILIES[family].text.format(count)
