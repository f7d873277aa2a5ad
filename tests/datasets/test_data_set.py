"""Data sets: labels against the renderer's ids, the same bytes, continuation."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from uwsim.base.geometry import Pose
from uwsim.datasets import DatasetRequest, Range, make_dataset
from uwsim.datasets.image_files import FILE_ENDS, read_colour, read_values
from uwsim.datasets.shards import shard_path
from uwsim.errors import BadSetting, ResultError, SeveralErrors, UnknownName, UwsimError

SCENE = "visibility-scene"


def request_in(folder: Path, **values: Any) -> DatasetRequest:
    defaults: dict[str, Any] = {
        "scene": SCENE,
        "out": folder / "set",
        "n_images": 6,
        "size": (160, 120),
        "views_per_scene": 2,
        "variations": (("object[blackbox].position.x", Range(1.9, 2.1)),),
        "fog": Range(0.0, 0.3),
        "light": Range(0.5, 1.2),
    }
    return DatasetRequest(**(defaults | values))


def records_of(folder: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in (folder / "labels.jsonl").read_text().splitlines()]


def files_of(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    request = request_in(tmp_path_factory.mktemp("data"))
    make_dataset(request)
    return request.out


def read_mask(folder: Path, record: dict[str, Any], kind: str) -> np.ndarray:
    with Image.open(folder / record["files"][kind]) as image:
        return np.asarray(image)


def test_boxes_and_counts_are_those_of_the_mask(folder: Path) -> None:
    for record in records_of(folder):
        mask = read_mask(folder, record, "instances")
        for instance in record["instances"]:
            rows, columns = np.nonzero(mask == instance["number"])
            assert instance["visible_pixels"] == len(rows)
            if len(rows):
                box = [columns.min(), rows.min(), columns.max() + 1, rows.max() + 1]
                assert instance["box"] == box


def test_the_masks_are_the_ids_that_the_renderer_draws(folder: Path) -> None:
    import uwsim

    record = records_of(folder)[1]
    settings = record["variations"]
    with uwsim.load(SCENE, settings=settings) as simulation:
        simulation.set_fog(record["water"]["fog"])
        camera = record["camera"]
        pose = Pose.from_quaternion(
            np.array(camera["position"]), np.array(camera["quaternion_wxyz"])
        )
        flip = Pose(np.zeros(3), np.diag([1.0, -1.0, -1.0]))
        from uwsim.base.geometry import Intrinsics

        intrinsics = Intrinsics.from_fovy(160, 120, np.radians(50.0), near=0.05)
        image = simulation.world.scenery.render_clean(pose @ flip, intrinsics)
        names = simulation.world.scenery.part_names
    mask = read_mask(folder, record, "instances")
    instances = {i["name"]: i["number"] for i in record["instances"]}
    for number, name in names.items():
        owner = name.split("/")[0]
        if owner in instances:
            # the record rounds the pose to 1e-6, which may move an edge by a pixel
            differs = (image.ids == number) & (mask != instances[owner])
            assert np.count_nonzero(differs) <= 2
    depth = read_mask(folder, record, "depth")
    is_surface = np.isfinite(image.depth)
    assert np.array_equal(depth > 0, is_surface)
    near = np.abs(depth[is_surface] - 1000.0 * image.depth[is_surface])
    assert np.percentile(near, 99) <= 1.0


def test_an_unhidden_thing_has_its_whole_silhouette(folder: Path) -> None:
    instances = [i for record in records_of(folder) for i in record["instances"]]
    assert all(i["visible_pixels"] <= i["silhouette_pixels"] for i in instances)
    assert any(i["visibility"] == 1.0 for i in instances)
    for instance in instances:
        if instance["box"] is not None:
            left, top, right, bottom = instance["box"]
            whole = instance["amodal_box"]
            assert whole[0] <= left
            assert whole[1] <= top
            assert whole[2] >= right
            assert whole[3] >= bottom


def test_projected_corners_contain_the_silhouette(folder: Path) -> None:
    n_checked = 0
    for record in records_of(folder):
        camera = record["camera"]
        for instance in record["instances"]:
            corners = np.array(instance["box_3d"]["corners"])
            if corners[:, 2].min() < 0.1:
                continue
            u = camera["cx"] + camera["fx"] * corners[:, 0] / corners[:, 2]
            v = camera["cy"] + camera["fy"] * corners[:, 1] / corners[:, 2]
            left, top, right, bottom = instance["amodal_box"]
            assert u.min() - 1.0 <= left
            assert v.min() - 1.0 <= top
            assert u.max() + 1.5 >= right
            assert v.max() + 1.5 >= bottom
            n_checked += 1
    assert n_checked >= 6


def test_the_target_is_visible_and_the_camera_is_in_the_water(folder: Path) -> None:
    for record in records_of(folder):
        target = next(i for i in record["instances"] if i["name"] == record["target"])
        assert target["visible_pixels"] > 20
        assert record["camera"]["position"][2] < 0.0


def test_fog_light_and_variations_are_in_the_records(folder: Path) -> None:
    records = records_of(folder)
    assert len({record["water"]["fog"] for record in records}) == 6
    assert all(0.5 <= record["water"]["light_rate"] <= 1.2 for record in records)
    values = [record["variations"]["object[blackbox].position.x"] for record in records]
    assert values[0] == values[1] != values[2]


def test_two_workers_and_an_interruption_change_no_bytes(folder: Path, tmp_path: Path) -> None:
    request = request_in(tmp_path, workers=2)
    make_dataset(request)
    assert files_of(request.out) == files_of(folder)

    shard_path(request.out, 1).unlink()  # as if it had been killed in the second draw
    (request.out / "images/000003.png").write_bytes(b"half")
    (request.out / "labels.jsonl").unlink()
    assert make_dataset(replace(request, workers=1)).n_rendered == 2
    assert files_of(request.out) == files_of(folder)


@pytest.mark.parametrize("kind", ["images", "depth"])
def test_damaged_images_are_rendered_again(folder: Path, tmp_path: Path, kind: str) -> None:
    request = request_in(tmp_path)
    shutil.copytree(folder, request.out)
    content = (request.out / f"{kind}/000002.png").read_bytes()
    (request.out / f"{kind}/000002.png").write_bytes(content[:-4])
    (request.out / "instances/000003.png").unlink()
    assert make_dataset(request).n_rendered == 2
    assert files_of(request.out) == files_of(folder)


def test_an_image_with_other_bytes_is_named_with_the_remedy(folder: Path, tmp_path: Path) -> None:
    copy = tmp_path / "set"
    shutil.copytree(folder, copy)
    record = records_of(folder)[0]
    for kind in ("images", "depth"):
        file = copy / record["files"][kind]
        file.write_bytes(bytes(100) + FILE_ENDS[".png"])
        read = read_colour if kind == "images" else read_values
        with pytest.raises(ResultError, match=r"000000\.png: is damaged\. Remove the file"):
            read(file)


def test_fewer_images_leave_the_others_unlisted(folder: Path, tmp_path: Path) -> None:
    request = request_in(tmp_path, n_images=4)
    shutil.copytree(folder, request.out)
    assert make_dataset(request).n_unlisted == 2
    assert len(records_of(request.out)) == 4
    assert make_dataset(replace(request, n_images=6)).n_rendered == 0
    assert files_of(request.out) == files_of(folder)


@pytest.mark.parametrize("split", [(float("nan"), 0.0, 1.0), (0.0, float("nan"), 1.0)])
def test_shares_that_are_no_numbers_are_refused(
    tmp_path: Path, split: tuple[float, float, float]
) -> None:
    with pytest.raises(BadSetting, match="--split"):
        request_in(tmp_path, split=split).check()


def test_more_images_keep_the_earlier_ones_and_their_splits(folder: Path, tmp_path: Path) -> None:
    request = request_in(tmp_path, n_images=7)
    shutil.copytree(folder, request.out)
    assert make_dataset(request).n_rendered == 1
    assert records_of(request.out)[:6] == records_of(folder)
    assert [r["index"] for r in records_of(request.out)] == list(range(7))


def test_another_seed_is_refused_in_the_same_folder(folder: Path) -> None:
    request = replace(request_in(folder.parent), seed=1)
    with pytest.raises(BadSetting, match="other values of seed"):
        make_dataset(request)


def test_a_folder_with_other_files_is_refused(tmp_path: Path) -> None:
    request = request_in(tmp_path)
    request.out.mkdir()
    (request.out / "thesis.tex").write_text("")
    with pytest.raises(BadSetting, match=r"thesis\.tex"):
        make_dataset(request)
    assert [path.name for path in request.out.iterdir()] == ["thesis.tex"]


def test_a_disk_that_is_too_small_is_refused(tmp_path: Path) -> None:
    request = request_in(tmp_path, n_images=1_000_000, size=(8000, 6000))
    with pytest.raises(BadSetting, match="GB are free"):
        make_dataset(request)
    assert not request.out.exists()


def test_all_wrong_values_are_reported_at_once(tmp_path: Path) -> None:
    request = request_in(
        tmp_path, n_images=0, formats=("cocoo",), split=(0.5, 0.1, 0.1), roll=Range(-999.0, 0.0)
    )
    with pytest.raises(SeveralErrors) as caught:
        make_dataset(request)
    text = str(caught.value)
    for part in ("-n is 0", "'coco'", "--split", "--roll"):
        assert part in text


def test_an_unknown_target_is_named(tmp_path: Path) -> None:
    with pytest.raises(UnknownName, match="blackbox"):
        make_dataset(request_in(tmp_path, targets=("blackbok",)))
    assert not (tmp_path / "set").exists()


def test_a_wrong_variation_is_refused(tmp_path: Path) -> None:
    wrong = (("object[blackbox].position.q", Range(0.0, 1.0)),)
    with pytest.raises(UwsimError, match="--vary"):
        make_dataset(request_in(tmp_path, variations=wrong))


def test_a_pose_that_cannot_be_is_an_error(tmp_path: Path) -> None:
    request = request_in(tmp_path, targets=("blackbox",), distance=Range(900.0, 901.0))
    with pytest.raises(UwsimError, match="No camera pose views blackbox"):
        make_dataset(request)


@pytest.mark.parametrize("text", ["", "1..", "a..b", "3..1", "nan..1", "1e999", "0.4.1.2"])
def test_a_wrong_range_is_refused(text: str) -> None:
    with pytest.raises(BadSetting, match=r"LOW\.\.HIGH"):
        Range.parse(text, "--fog")


def test_ranges_are_read() -> None:
    assert Range.parse("0.5..3", "--fog") == Range(0.5, 3.0)
    assert Range.parse("-20..60", "--fog") == Range(-20.0, 60.0)
    assert Range.parse("2", "--fog") == Range(2.0, 2.0)


def test_images_of_a_benchmark_have_its_levels(tmp_path: Path) -> None:
    request = request_in(
        tmp_path, scene="visibility", variations=(), fog=None, light=None, n_images=4
    )
    make_dataset(request)
    for record in records_of(request.out):
        assert record["level"] == {"fog": pytest.approx(record["water"]["fog"])}


def test_the_card_has_the_command_the_counts_and_the_models(folder: Path) -> None:
    card = (folder / "README.md").read_text()
    assert "--fog 0..0.3 --light 0.5..1.2" in card
    assert "--vary 'object[blackbox].position.x=1.9..2.1'" in card
    n_boxes = sum(
        i["class"] == "blackbox" and i["box"] is not None
        for record in records_of(folder)
        for i in record["instances"]
    )
    assert f"| 1 | blackbox | {n_boxes} |" in card
    assert "objects/blackbox" in card
    for name in ("contact-sheet.png", "statistics.png"):
        with Image.open(folder / name) as image:
            assert image.width > 900
