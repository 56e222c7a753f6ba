"""A subject that is drawn without a device, so that what a study does with it can be worked out by hand."""

from contextlib import nullcontext

import numpy as np

import burnish
from burnish.study.measure import Cell
from burnish.study.sources import LiveSource
from burnish.study.store import StoredPicture
from burnish.study.subject import Shot

HEIGHT, WIDTH = 6, 8


class FakeSubject:
    """Grey pictures: the reference is 1 everywhere, a sampler of n samples is too bright by 1/n.

    The left column is background, where every picture shows 100. The k-th drawing of a sampler of n samples
    takes n + k milliseconds, of which n to shade.
    """

    def __init__(self, name="fake", fails_at=None):
        self.name = name
        self.drawn = []
        self.fails_at = fails_at

    def draw(self, sampler, progress=None):
        if self.fails_at is not None and len(self.drawn) == self.fails_at:
            self.fails_at = None
            raise KeyboardInterrupt
        is_reference = isinstance(sampler, burnish.Reference)
        samples = 0 if is_reference else sampler.samples
        run = self.drawn.count(samples)
        self.drawn.append(samples)
        color = np.full((HEIGHT, WIDTH, 3), 1.0 if is_reference else 1.0 + 1.0 / samples, np.float32)
        covered = np.ones((HEIGHT, WIDTH), bool)
        covered[:, 0] = False
        color[~covered] = 100.0
        times = {"frame_ms": samples + run, "shade_ms": samples, "wall_ms": samples + run + 1}
        times["pass shade 0"] = samples
        return Shot(color, covered, times, 7.0 if run == 0 else 0.0, str(samples), 0.001)

    def device_names(self):
        return {"device": "a <fast> device", "driver": "its driver", "is_software": True}

    def keeping_pipelines(self, sampler_count):
        return nullcontext()

    def describe(self):
        return {
            "scene": self.name,
            "material": "m 0.1",
            "environment": "studio (8)",
            "filter": "box",
            "height": HEIGHT,
            "width": WIDTH,
            "spp": 1,
        }

    def fingerprint(self, with_filter=True):
        return f"{self.name} {'box' if with_filter else ''}"


def make_cell(subject, samplers=("regular:5", "regular:10", "importance:20"), repeats=3):
    """One cell of a fake subject."""
    return Cell(LiveSource(subject), tuple(samplers), "reference:0.01", repeats)


def grey_picture(value=1.0, shape=(HEIGHT, WIDTH)):
    """A stored picture of one grey, covered everywhere."""
    return StoredPicture(np.full((*shape, 3), value, np.float32), np.ones(shape, bool), 0.25)
