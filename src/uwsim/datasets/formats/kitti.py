r"""KITTI: a text file of objects and one of the camera for each image.

A line of ``kitti/training/label_2`` has type, truncation, occlusion, alpha, the visible box [px],
height, width and length [m], the centre of the bottom face in the camera's optical axes [m], and
the rotation about the camera's y axis:

.. math:: r_y = \operatorname{atan2}(-d_z, d_x), \qquad
    \alpha = r_y - \operatorname{atan2}(x, z)

with the direction d of the object's x axis in the camera's axes. Length, width and height are the
edges along the object's x, y and z. The occlusion is 0 from a visibility of 0.9, 1 from 0.5, else
2. Not in the format: roll and pitch of an object relative to the camera, which ``labels.jsonl``
has. Images are hard links to those of the data set, or copies where the file system has none.
"""

from __future__ import annotations

import math
import os
import shutil
from collections.abc import Sequence
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from ...base.geometry import rotation_from_quaternion
from ...results.atomic_file import write_text
from ..request import DatasetRequest
from ..splits import SPLITS

FOLDER = "kitti"
PARTS = ("image_2", "label_2", "calib")
"""The folders of images, labels and cameras."""
MOSTLY_VISIBLE, PARTLY_VISIBLE = 0.9, 0.5
"""The least visibilities of the occlusion levels 0 and 1 [1]."""


def write_kitti(
    request: DatasetRequest, records: Sequence[dict[str, Any]], classes: Sequence[str]
) -> None:
    """Write ``kitti/training`` and ``kitti/ImageSets``."""
    folder = request.out / FOLDER / "training"
    for part in PARTS:
        (folder / part).mkdir(parents=True, exist_ok=True)
    for record in records:
        path = PurePosixPath(record["files"]["images"])
        _link(request.out / path, folder / "image_2" / path.name)
        lines = (object_line(i) for i in record["instances"] if i["box"] is not None)
        (folder / "label_2" / f"{path.stem}.txt").write_text("".join(lines), encoding="utf-8")
        (folder / "calib" / f"{path.stem}.txt").write_text(camera_lines(record), encoding="utf-8")
    sets = request.out / FOLDER / "ImageSets"
    sets.mkdir(exist_ok=True)
    for split in SPLITS:
        stems = [
            PurePosixPath(r["files"]["images"]).stem + "\n" for r in records if r["split"] == split
        ]
        write_text(sets / f"{split}.txt", "".join(stems))


def object_line(instance: dict[str, Any]) -> str:
    """Return the line of a visible instance; blanks in the class become underscores."""
    box = instance["box_3d"]
    rotation = rotation_from_quaternion(np.array(box["quaternion_wxyz"]))
    length, width, height = box["size"]
    direction, down = rotation[:, 0], -rotation[:, 2] if rotation[1, 2] <= 0.0 else rotation[:, 2]
    x, y, z = (np.array(box["centre"]) + 0.5 * height * down).tolist()
    yaw = math.atan2(-direction[2], direction[0])
    alpha = math.remainder(yaw - math.atan2(x, z), 2.0 * math.pi)
    visibility = instance["visibility"]
    occlusion = 0 if visibility >= MOSTLY_VISIBLE else 1 if visibility >= PARTLY_VISIBLE else 2
    left, top, right, bottom = instance["box"]
    truncation = instance["truncation"]
    numbers = [alpha, left, top, right, bottom, height, width, length, x, y, z, yaw]
    return (
        " ".join(
            [
                "_".join(instance["class"].split()),
                f"{-1.0 if truncation is None else truncation:.2f}",
                str(occlusion),
                *(f"{number:.6g}" for number in numbers),
            ]
        )
        + "\n"
    )


def camera_lines(record: dict[str, Any]) -> str:
    """Return the calibration file of an image: P0 to P3 are the same camera."""
    camera = record["camera"]
    matrix = [camera["fx"], camera["skew"], camera["cx"], 0.0, 0.0, camera["fy"], camera["cy"], 0.0]
    values = " ".join(f"{value:.12g}" for value in [*matrix, 0.0, 0.0, 1.0, 0.0])
    unit = "1 0 0 0 1 0 0 0 1"
    lines = [f"P{number}: {values}\n" for number in range(4)]
    transform = "1 0 0 0 0 1 0 0 0 0 1 0"
    lines += [
        f"R0_rect: {unit}\n",
        f"Tr_velo_to_cam: {transform}\n",
        f"Tr_imu_to_velo: {transform}\n",
    ]
    return "".join(lines)


def _link(source: Path, target: Path) -> None:
    """Make a hard link to an image, or a copy."""
    target.unlink(missing_ok=True)
    try:
        os.link(source, target)
    except OSError:
        shutil.copyfile(source, target)
