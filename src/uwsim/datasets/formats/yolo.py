"""YOLO: a text file for each image in ``labels``, beside ``images``, and ``data.yaml``.

A line has the class from 0, and the centre and the size of the visible box over the image's width
and height. ``train.txt`` and the other lists of the plain format name the images. ``data.yaml`` has
no ``path``: its files are then beside it, whereas ``path: .`` is the current folder of the reader.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import PurePosixPath
from typing import Any

from ...results.atomic_file import write_text
from ..request import DatasetRequest
from ..sensor_record import sensor_of

FOLDER = "labels"


def write_yolo(
    request: DatasetRequest, records: Sequence[dict[str, Any]], classes: Sequence[str]
) -> None:
    """Write ``labels`` and ``data.yaml``."""
    folder = request.out / FOLDER
    folder.mkdir(exist_ok=True)
    for record in records:
        name = PurePosixPath(record["files"]["images"]).stem
        content = "".join(label_lines(record, classes))
        (folder / f"{name}.txt").write_text(content, encoding="utf-8")
    names = "".join(f"  {number}: {json.dumps(name)}\n" for number, name in enumerate(classes))
    write_text(
        request.out / "data.yaml",
        f"train: train.txt\nval: val.txt\ntest: test.txt\nnames:\n{names}",
    )


def label_lines(record: dict[str, Any], classes: Sequence[str]) -> list[str]:
    """Return the lines of an image, one for each visible instance."""
    width, height = sensor_of(record)["width"], sensor_of(record)["height"]
    lines = []
    for instance in record["instances"]:
        if instance["box"] is None:
            continue
        left, top, right, bottom = instance["box"]
        numbers = (
            0.5 * (left + right) / width,
            0.5 * (top + bottom) / height,
            (right - left) / width,
            (bottom - top) / height,
        )
        number = list(classes).index(instance["class"])
        lines.append(" ".join([str(number), *(f"{value:.6f}" for value in numbers)]) + "\n")
    return lines
