"""What is measured in a benchmark: one file a measure."""

from __future__ import annotations

from .euclidean_norm import EuclideanNorm, EuclideanNormSpec
from .measure import Measure, MeasureSpec
from .signal import Signal

MEASURES: dict[str, type[MeasureSpec]] = {
    "euclideanNorm": EuclideanNormSpec,
}
"""Element -> what a file says about it. In alphabetical order."""

__all__ = [
    "MEASURES",
    "EuclideanNorm",
    "EuclideanNormSpec",
    "Measure",
    "MeasureSpec",
    "Signal",
]
