"""COCO: one file of instances for each split, with masks as run lengths, boxes and keypoints.

Keypoints are declared points, or the corners of the 3-D box. ``bbox`` is x, y, width, height of the
visible pixels, and ``area`` is their number. Fields of uwsim beside COCO's: ``visibility``,
``amodal_bbox``.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from ...results.atomic_file import write_text
from ..image_files import read_values
from ..request import DatasetRequest
from ..sensor_record import sensor_of
from ..splits import SPLITS
from .run_lengths import compress, run_lengths

FOLDER = "coco"
CORNERS = [f"corner{i}" for i in range(8)]
"""The names of the keypoints: x varies fastest, z slowest."""
EDGES = [[i + 1, (i | bit) + 1] for i in range(8) for bit in (1, 2, 4) if not i & bit]
"""The edges of a box, as pairs of keypoints from 1."""


def write_coco(
    request: DatasetRequest, records: Sequence[dict[str, Any]], classes: Sequence[str]
) -> None:
    """Write ``coco/instances_train.json``, ``_val`` and ``_test``."""
    folder = request.out / FOLDER
    folder.mkdir(exist_ok=True)
    for split in SPLITS:
        document = make_document(
            request.out,
            [record for record in records if record["split"] == split],
            classes,
            {label: [name for name, _ in points] for label, points in request.keypoints},
        )
        text = json.dumps(document, separators=(",", ":")) + "\n"
        write_text(folder / f"instances_{split}.json", text)


def make_document(
    directory: Path,
    records: Sequence[dict[str, Any]],
    classes: Sequence[str],
    keypoint_names: Mapping[str, Sequence[str]] = MappingProxyType({}),
) -> dict[str, Any]:
    """Return COCO's document of some images; ``file_name`` is relative to the data set.

    Args:
        directory: the data set.
        records: the records of the images.
        classes: the classes.
        keypoint_names: the names of the declared keypoints of classes; others have corners.
    """
    annotations: list[dict[str, Any]] = []
    for record in records:
        annotations += _make_annotations(directory, record, classes, len(annotations) + 1)
    return {
        "info": {"description": "Images of uwsim; see README.md", "version": "1.0"},
        "licenses": [],
        "images": [
            {
                "id": record["index"],
                "file_name": record["files"]["images"],
                "width": sensor_of(record)["width"],
                "height": sensor_of(record)["height"],
            }
            for record in records
        ],
        "categories": [
            {
                "id": number,
                "name": name,
                "keypoints": list(keypoint_names.get(name, CORNERS)),
                "skeleton": [] if name in keypoint_names else EDGES,
            }
            for number, name in enumerate(classes, start=1)
        ],
        "annotations": annotations,
    }


def _make_annotations(
    directory: Path, record: dict[str, Any], classes: Sequence[str], first_id: int
) -> list[dict[str, Any]]:
    """Return the annotations of the visible instances of an image."""
    instances = [instance for instance in record["instances"] if instance["box"] is not None]
    if not instances:
        return []
    mask = read_values(directory / record["files"]["instances"])
    height, width = mask.shape
    annotations = []
    for number, instance in enumerate(instances):
        lengths = run_lengths(np.equal(mask, instance["number"]))
        annotations.append(
            {
                "id": first_id + number,
                "image_id": record["index"],
                "category_id": 1 + list(classes).index(instance["class"]),
                "bbox": corner_and_size(instance["box"]),
                **(
                    {"amodal_bbox": corner_and_size(instance["amodal_box"])}
                    if "amodal_box" in instance
                    else {}
                ),
                "area": instance["visible_pixels"],
                "iscrowd": 0,
                "segmentation": {"size": [height, width], "counts": compress(lengths)},
                "visibility": instance["visibility"],
                "keypoints": [value for point in instance["keypoints"] for value in point],
                "num_keypoints": sum(point[2] > 0 for point in instance["keypoints"]),
            }
        )
    return annotations


def corner_and_size(box: Sequence[int]) -> list[int]:
    """Return left, top, width and height of a box with left, top, right and bottom [px]."""
    left, top, right, bottom = box
    return [left, top, right - left, bottom - top]
