"""What is drawn: the paper's environment and lobes, and how large."""

from dataclasses import dataclass

from burnish import _core
from burnish.filters import FILTERS as FILTERS

MATCHED_MOST = 64
"""The largest count that `Matched` has a table for; it stands beside 270 regular samples."""

SHARES = (0.25, 0.5, 1.0)
"""Shares of the screen that Fig. 7 covers with glossy material."""


@dataclass(frozen=True)
class PaperSettings:
    """Sizes of the reproduction; the defaults are the paper's where it names them.

    Parameters
    ----------
    face_size : int
        Texels along a face of the environment.
    seeds : tuple of int
        Environments that errors are taken over; pictures show the first.
    pyramid_sizes : tuple of int
        Face sizes of Table 1.
    frame_size : (height, width)
        Pixels of Fig. 7. The shares of the screen are exact where a quarter of the width is a whole number.
    frame_samples : tuple of int
        Counts of Fig. 7; `Matched` must have tables for them.
    picture_px, further_px : int
        Edge of the pictures under the first environment and under the others.
    reference_faces : int
        Largest face size at which the reference sums all texels.
    repeats : int
        Timed runs of each candidate, which take turns.
    """

    face_size: int = 1024
    seeds: tuple[int, ...] = (1, 2, 3)
    pyramid_sizes: tuple[int, ...] = (256, 512, 1024)
    frame_size: tuple[int, int] = (1080, 1920)
    frame_samples: tuple[int, ...] = (5, 14, 30, 64)
    picture_px: int = 160
    further_px: int = 64
    reference_faces: int = 64
    repeats: int = 3

    @classmethod
    def quick(cls, repeats: int = 3) -> "PaperSettings":
        """Give sizes for a first look: one small environment, small frames; times and errors are others.

        Parameters
        ----------
        repeats : int
            Timed runs of each candidate.
        """
        return cls(
            face_size=256,
            seeds=(1,),
            pyramid_sizes=(64, 128, 256),
            frame_size=(270, 480),
            frame_samples=(5, 14, 30),
            picture_px=96,
            repeats=repeats,
        )


@dataclass(frozen=True)
class PaperCell:
    """One lobe and one count of samples.

    Parameters
    ----------
    name : str
        Key of the cell in all tables.
    roughness : (mx, my)
        Beckmann slopes.
    samples : int
        As asked for, of every sampler but `Matched`, which stops at `MATCHED_MOST`.
    threshold : float
        xi_0 of the pattern.
    printed_samples : int
        The count that the paper prints.
    figures : str
        Where it is shown.
    """

    name: str
    roughness: tuple[float, float]
    samples: int
    threshold: float
    printed_samples: int
    figures: str

    def samplers(self) -> dict[str, str]:
        """Give the samplers by the role they play, as text; only those that this build has."""
        count, pattern = self.samples, f"threshold={self.threshold:g}"
        roles = {
            "published": f"regular:{count}:published:{pattern}",
            "importance": f"importance:{count}",
            "importance_bias": f"importance:{count}:mip_bias=1",
            "footprint": f"regular:{count}:normalization=published:{pattern}",
            "exact": f"regular:{count}:{pattern}",
            "fibonacci": f"importance:{count}:fibonacci",
        }
        if hasattr(_core, "Matched"):
            roles["matched"] = f"matched:{min(count, MATCHED_MOST)}"
        if hasattr(_core, "Prefiltered"):
            roles["prefiltered"] = "prefiltered"
        return roles


CELLS = (
    PaperCell("14", (0.1, 0.1), 14, 0.2, 14, "Figs. 8 and 10"),
    PaperCell("17", (0.2, 0.075), 17, 0.2, 17, "Figs. 8 and 10"),
    PaperCell("270", (0.15, 0.15), 270, 0.01, 270, "Figs. 8, 9 and 10"),
    PaperCell("fig9-14", (0.15, 0.15), 14, 0.2, 14, "Fig. 9"),
    PaperCell("fig9-30", (0.15, 0.15), 30, 0.1, 30, "Fig. 9"),
)

FILTER_CELL = "14"
"""The cell that is also drawn with the other filters, to see what Table 1 buys."""

COMPARED = ("14", "17", "270")
"""Cells of Figs. 8 and 10."""

DIFFERENCES = ("fig9-14", "fig9-30", "270")
"""Cells of Fig. 9; all have the same lobe."""

ROLE_NAMES = {
    "published": "regular, as published",
    "importance": "importance, bias 0",
    "importance_bias": "importance, bias +1",
    "footprint": "regular, exact footprint",
    "exact": "regular, exact",
    "fibonacci": "importance, Fibonacci",
    "matched": "matched",
    "prefiltered": "prefiltered",
}
