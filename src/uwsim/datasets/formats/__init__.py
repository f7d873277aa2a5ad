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
    "coco": write_coco,
    "kitti": write_kitti,
    "yolo": write_yolo,
}
"""The function that writes each format beside the plain one."""


def write_formats(
    request: DatasetRequest, records: Sequence[dict[str, Any]], classes: Sequence[str]
) -> None:
    """Write the labels of a data set in all requested formats, and always in the plain one.

    Instances with fewer visible pixels than the request demands are in the plain format alone.
    """
    write_plain(request, records, classes)
    large_records = [
        {
            **record,
            "instances": [
                instance
                for instance in record["instances"]
                if instance["visible_pixels"] >= request.min_pixels
            ],
        }
        for record in records
    ]
    for name, write in WRITERS.items():
        if name in request.formats:
            write(request, large_records, classes)
