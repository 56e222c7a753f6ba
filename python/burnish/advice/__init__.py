"""Which sampler and count meet an error, and at what price; and an error for every pixel."""

from burnish.advice.advice import Advice
from burnish.advice.advise import advise
from burnish.advice.error_estimate import estimate_errors

__all__ = ["Advice", "advise", "estimate_errors"]
