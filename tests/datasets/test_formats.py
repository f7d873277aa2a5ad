"""COCO, KITTI and YOLO against boxes that are calculated by hand."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from uwsim.datasets import DatasetRequest, make_dataset
from uwsim.datasets.formats.coco import make_document
from uwsim.datasets.formats.kitti import camera_lines, object_line
from uwsim.datasets.formats.run_lengths import compress, decompress, read_mask, run_lengths
from uwsim.datasets.formats.yolo import label_lines
from uwsim.datasets.image_files import encode_png, read_values

BOX = {
    "number": 1,
    "name": "crate",
    "class": "crate",
    "box": [40, 30, 80, 50],
    "amodal_box": [40, 30, 100, 50],
    "visible_pixels": 600,
    "silhouette_pixels": 900,
    "visibility": 0.666667,
    "truncation": 0.25,
    "distance": 4.0,
    # the object's x is the camera's z (away from it), its y the camera's -x, its z is up
    "box_3d": {
        "centre": [1.0, 0.5, 4.0],
        "size": [2.0, 1.0, 0.6],
        "quaternion_wxyz": [0.5, 0.5, -0.5, 0.5],
        "corners": [],
    },
    "keypoints": [[1.0, 2.0, 2]] * 7 + [[0.0, 0.0, 0]],
}
RECORD: dict[str, Any] = {
    "index": 3,
    "files": {"images": "images/000003.png", "instances": "instances/000003.png"},
    "camera": {"width": 160, "height": 120, "fx": 100.0, "fy": 90.0, "cx": 79.5, "cy": 59.5,
               "skew": 0.0},
    "instances": [BOX],
}  # fmt: skip


def test_a_yolo_line_has_the_centre_and_the_size_over_those_of_the_image() -> None:
    # centre (60, 40), size 40 x 20 in an image of 160 x 120
    (line,) = label_lines(RECORD, ["ball", "crate"])
    assert line == "1 0.375000 0.333333 0.250000 0.166667\n"


def test_a_kitti_line_is_that_of_a_box_that_faces_away() -> None:
    fields = object_line(BOX).split()
    assert fields[0] == "crate"
    assert fields[1:3] == ["0.25", "1"]
    numbers = [float(field) for field in fields[3:]]
    assert numbers[1:5] == [40.0, 30.0, 80.0, 50.0]
    assert numbers[5:8] == [0.6, 1.0, 2.0]  # height, width, length
    # the bottom face is half the height below the centre: y points down
    assert numbers[8:11] == pytest.approx([1.0, 0.5 + 0.3, 4.0])
    # x away from the camera: rotated by -90 degrees about y
    assert numbers[11] == pytest.approx(-np.pi / 2, abs=1e-5)
    assert numbers[0] == pytest.approx(-np.pi / 2 - np.arctan2(1.0, 4.0), abs=1e-5)


def test_a_kitti_camera_is_the_matrix_of_the_pinhole() -> None:
    first = camera_lines(RECORD).splitlines()[0]
    assert first == "P0: 100 0 79.5 0 0 90 59.5 0 0 0 1 0"


def test_a_coco_annotation_has_the_mask_and_the_boxes(tmp_path: Path) -> None:
    mask = np.zeros((120, 160), np.uint16)
    mask[30:50, 40:70] = 1
    (tmp_path / "instances").mkdir()
    (tmp_path / RECORD["files"]["instances"]).write_bytes(encode_png(mask))
    document = make_document(tmp_path, [RECORD], ["ball", "crate"])
    (annotation,) = document["annotations"]
    assert annotation["bbox"] == [40, 30, 40, 20]
    assert annotation["amodal_bbox"] == [40, 30, 60, 20]
    assert annotation["category_id"] == 2
    assert annotation["area"] == 600
    assert annotation["num_keypoints"] == 7
    assert len(annotation["keypoints"]) == 24
    counts = decompress(annotation["segmentation"]["counts"])
    assert np.array_equal(read_mask(counts, 120, 160), mask == 1)


def test_run_lengths_are_those_of_the_example_of_coco() -> None:
    # M = [0 0 1; 1 1 1; 0 0 1] by columns is 0 1 0, 0 1 0, 1 1 1
    mask = np.array([[0, 0, 1], [1, 1, 1], [0, 0, 1]], bool)
    assert run_lengths(mask) == [1, 1, 2, 1, 1, 3]
    assert run_lengths(np.ones((2, 2), bool)) == [0, 4]
    assert run_lengths(np.zeros((2, 2), bool)) == [4]


def test_compressed_runs_are_those_of_the_reference_code() -> None:
    # of pycocotools 2.0.8: mask.frPyObjects({"counts": [...], "size": [120, 160]}, 120, 160)
    assert compress([6, 1, 40, 4, 5, 4, 5, 4, 21]) == "61X13mN000`0"


@settings(max_examples=50, deadline=None)
@given(st.lists(st.booleans(), min_size=24, max_size=24))
def test_every_mask_is_read_back(pixels: list[bool]) -> None:
    mask = np.array(pixels).reshape(4, 6)
    lengths = run_lengths(mask)
    assert decompress(compress(lengths)) == lengths
    assert np.array_equal(read_mask(lengths, 4, 6), mask)


def test_all_formats_of_one_data_set_agree(tmp_path: Path) -> None:
    request = DatasetRequest(
        scene="visibility-scene",
        out=tmp_path / "set",
        n_images=8,
        size=(160, 120),
        formats=("plain", "coco", "kitti", "yolo"),
        split=(0.5, 0.25, 0.25),
    )
    make_dataset(request)
    out = request.out
    records = [json.loads(line) for line in (out / "labels.jsonl").read_text().splitlines()]
    n_visible = sum(i["box"] is not None for r in records for i in r["instances"])
    documents = [json.loads(path.read_text()) for path in sorted((out / "coco").iterdir())]
    assert sum(len(document["images"]) for document in documents) == 8
    assert sum(len(document["annotations"]) for document in documents) == n_visible
    for document in documents:
        for annotation in document["annotations"]:
            mask = read_values(out / f"instances/{annotation['image_id']:06d}.png")
            counts = decompress(annotation["segmentation"]["counts"])
            inside = read_mask(counts, 120, 160)
            assert len(np.unique(mask[inside])) == 1
            assert inside.sum() == annotation["area"]
    for kind in ("labels", "kitti/training/label_2"):
        lines = [p.read_text().splitlines() for p in sorted((out / kind).iterdir())]
        assert [len(x) for x in lines] == [
            sum(i["box"] is not None for i in r["instances"]) for r in records
        ]
    description = (out / "data.yaml").read_text()
    assert "0: " in description
    assert "path" not in description  # the lists are beside it, and name images as ./images/...
    assert (out / "train.txt").read_text().startswith("./images/")
    listed = [line for name in ("train", "val", "test")
              for line in (out / f"{name}.txt").read_text().splitlines()]  # fmt: skip
    assert sorted(listed) == [f"./images/{i:06d}.png" for i in range(8)]
    assert (out / "kitti/training/image_2/000005.png").read_bytes() == (
        out / "images/000005.png"
    ).read_bytes()

    sizes = sorted(i["visible_pixels"] for r in records for i in r["instances"] if i["box"])
    limit = sizes[len(sizes) // 2]
    assert make_dataset(replace(request, min_pixels=limit)).n_rendered == 0
    n_large = sum(size >= limit for size in sizes)
    assert 0 < n_large < len(sizes)
    areas = [
        annotation["area"]
        for path in sorted((out / "coco").iterdir())
        for annotation in json.loads(path.read_text())["annotations"]
    ]
    assert sorted(areas) == sizes[-n_large:]
    for kind in ("labels", "kitti/training/label_2"):
        assert sum(len(p.read_text().splitlines()) for p in (out / kind).iterdir()) == n_large
    assert [json.loads(line) for line in (out / "labels.jsonl").read_text().splitlines()] == records
    assert f"--min-pixels {limit} " in (out / "README.md").read_text()
