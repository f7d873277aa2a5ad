"""The splits of a data set: train, val and test.

The unit of a split is a scene draw if scenes vary, so that no scene is in two splits, and otherwise
an image. A unit's split depends on the seed and on its number alone: it stays when images are
added. So the shares are those of the request on average.
"""

from __future__ import annotations

from ..base.rng import stream
from .request import DatasetRequest

SPLITS = ("train", "val", "test")
"""The names of the splits."""


def find_split(request: DatasetRequest, index: int, *, varies: bool) -> str:
    """Return the split of an image.

    Args:
        request: the request.
        index: the index of the image.
        varies: True if scene draws differ.
    """
    unit = index // request.views_per_scene if varies else index
    share = float(stream(request.seed, f"dataset/split/{unit}").uniform())
    for name, part in zip(SPLITS[:-1], request.split[:-1], strict=True):
        if share < part:
            return name
        share -= part
    return SPLITS[-1] if request.split[-1] > 0.0 else SPLITS[0]
