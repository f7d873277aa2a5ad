"""The formats of labels, which the records of images are written in."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from ..request import DatasetRequest
from .coco import write_coco
from .kitti import write_kitti
from .plain import write_plain
from .yolo import write_yolo

Writer = Callable[[DatasetRequest, Sequence[dict[str, Any]], Sequence[str]], None]
WRITERS: dict[str, Writer] = {
    "plain": write_plain,
    "coco": write_coco,
    "kitti": write_kitti,
    "yolo": write_yolo,
}
"""The function that writes each format."""


def write_formats(
    request: DatasetRequest, records: Sequence[dict[str, Any]], classes: Sequence[str]
) -> None:
    """Write the labels of a data set in all requested formats, and always in the plain one."""
    for name, write in WRITERS.items():
        if name == "plain" or name in request.formats:
            write(request, records, classes)
