"""Make labelled images of a black box in fog, and read its boxes and masks.

The camera is drawn around the box, and the fog for each image. The same request makes the same
labels; a greater number of images adds some.
"""

import json
import tempfile
from pathlib import Path

import cv2
import numpy as np

from uwsim.datasets import DatasetRequest, Range, make_dataset


def main() -> None:
    with tempfile.TemporaryDirectory() as scratch:
        request = DatasetRequest(
            scene="visibility-scene",
            out=Path(scratch) / "boxes",
            n_images=4,
            size=(160, 120),
            targets=("blackbox",),
            fog=Range(0.0, 0.3),
            formats=("plain", "coco", "yolo"),
        )
        data_set = make_dataset(request)
        print(f"{data_set.n_images} images; formats: {', '.join(request.formats)}")
        for line in (request.out / "labels.jsonl").read_text().splitlines():
            describe(request.out, json.loads(line))


def describe(folder: Path, record: dict) -> None:
    """Compare the box of the target with its mask."""
    target = next(i for i in record["instances"] if i["name"] == record["target"])
    mask = cv2.imread(str(folder / record["files"]["instances"]), cv2.IMREAD_UNCHANGED)
    rows, columns = np.nonzero(mask == target["number"])
    box = [columns.min(), rows.min(), columns.max() + 1, rows.max() + 1]
    agreement = "is" if target["box"] == box else "is not"
    fog = "thin" if record["water"]["fog"] < 0.15 else "dense"
    print(f"image {record['index']}, {fog} fog: the box {agreement} that of the mask")


if __name__ == "__main__":
    main()
