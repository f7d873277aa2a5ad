"""Declared keypoints: their pixels, their flags, their files."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from uwsim.datasets import DatasetRequest, make_dataset
from uwsim.datasets.image_files import read_values
from uwsim.datasets.keypoints import read_keypoints
from uwsim.errors import BadSetting, SeveralErrors, UnknownName, UwsimError

POINTS = {"middle": [0.0, 0.0, 0.0], "above": [0.0, 0.0, 3.0]}


def request_in(folder: Path, document: object) -> DatasetRequest:
    file = folder / "points.json"
    file.write_text(json.dumps(document))
    return DatasetRequest(
        scene="visibility-scene",
        out=folder / "set",
        n_images=3,
        size=(160, 120),
        targets=("blackbox",),
        formats=("plain", "coco"),
        keypoints=read_keypoints(file),
    )


def test_declared_points_have_their_pixels_and_flags_by_depth(tmp_path: Path) -> None:
    request = request_in(tmp_path, {"blackbox": POINTS})
    make_dataset(request)
    n_visible = n_hidden = 0
    for line in (request.out / "labels.jsonl").read_text().splitlines():
        record = json.loads(line)
        camera = record["camera"]
        depth = read_values(request.out / record["files"]["depth"]) / 1000.0
        (target,) = (i for i in record["instances"] if i["name"] == "blackbox")
        assert len(target["keypoints"]) == 2
        diagonal = float(np.linalg.norm(target["box_3d"]["size"]))
        for u, v, flag in target["keypoints"]:
            if flag == 0:
                continue
            surface = depth[round(v), round(u)]
            n_visible += flag == 2
            n_hidden += flag == 1
            if flag == 1:  # a surface is in front
                assert 0.0 < surface < target["distance"] + diagonal
            assert 0 <= round(u) < camera["width"]
    assert n_hidden > 0  # the middle is inside of the mesh
    document = json.loads((request.out / "coco/instances_train.json").read_text())
    categories = {category["name"]: category for category in document["categories"]}
    assert categories["blackbox"]["keypoints"] == ["middle", "above"]
    assert all(
        len(annotation["keypoints"]) == 6
        for annotation in document["annotations"]
        if annotation["category_id"] == categories["blackbox"]["id"]
    )
    assert json.loads((request.out / "keypoints.json").read_text()) == {"blackbox": POINTS}
    assert "--keypoints keypoints.json" in (request.out / "README.md").read_text()


def test_an_unknown_class_is_named(tmp_path: Path) -> None:
    with pytest.raises(UnknownName, match="blackbox"):
        make_dataset(request_in(tmp_path, {"blackbok": POINTS}))


@pytest.mark.parametrize(
    "document", [[], {}, {"box": {}}, {"box": {"a": [1, 2]}}, {"box": {"a": [1, 2, True]}},
                 {"box": {"a": [1, 2, 1e9]}}, {"box": {"a": "1 2 3"}}]
)  # fmt: skip
def test_invalid_points_are_refused(document: object, tmp_path: Path) -> None:
    with pytest.raises(BadSetting, match="expected"):
        request_in(tmp_path, document)


def test_all_errors_of_a_file_are_reported(tmp_path: Path) -> None:
    with pytest.raises(SeveralErrors) as refusal:
        request_in(tmp_path, {"box": {"a": [1], "b": "x"}, "ball": 3})
    assert all(name in str(refusal.value) for name in ("'a'", "'b'", "'ball'"))


def test_a_file_that_is_no_json_has_a_line(tmp_path: Path) -> None:
    file = tmp_path / "points.json"
    file.write_text("{\n oops}")
    with pytest.raises(UwsimError, match=r"points\.json:2: is not JSON"):
        read_keypoints(file)
    with pytest.raises(UwsimError, match="none"):
        read_keypoints(tmp_path / "none.json")
