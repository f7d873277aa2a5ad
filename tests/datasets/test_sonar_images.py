"""Data sets of sonar images: labels against rays that are cast here, and the sum of all echoes."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from uwsim.base.geometry import Pose
from uwsim.datasets import DatasetRequest, Range, make_dataset
from uwsim.datasets.image_files import read_values
from uwsim.datasets.instances import find_instances
from uwsim.datasets.sonar_images.dataset_sonar import make_sonar
from uwsim.errors import SeveralErrors, UnknownName, UwsimError

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle>
    <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <position> <x>0</x> <y>0</y> <z>-5</z> </position>
    <u:imagingSonar>
      <name>fls</name> <relativeTo>base_link</relativeTo>
      <position> <x>0.4</x> <y>0</y> <z>0</z> </position>
      <range>10</range> <minRange>0.5</minRange> <bins>190</bins> <beams>61</beams>
      <horizontalAperture>60</horizontalAperture> <beamWidth>1</beamWidth> <rows>64</rows>
      <verticalAperture>30</verticalAperture>
    </u:imagingSonar>
  </vehicle>
  <object> <name>ball</name> <file>ball.obj</file>
    <position> <x>6</x> <y>1.5</y> <z>-5</z> </position> </object>
  <object> <name>box</name> <file>box.obj</file>
    <position> <x>5</x> <y>-1.5</y> <z>-5</z> </position> </object>
</UWSimScene>
"""


def write_obj(path: Path, vertices: np.ndarray, faces: list[tuple[int, ...]]) -> None:
    lines = ["v {:.9f} {:.9f} {:.9f}".format(*vertex) for vertex in vertices]
    lines += ["f " + " ".join(str(index + 1) for index in face) for face in faces]
    path.write_text("\n".join(lines) + "\n")


@pytest.fixture(scope="module")
def scene(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sonar")
    n = 24
    grid = [(math.pi * i / n, 2.0 * math.pi * j / n) for i in range(n + 1) for j in range(n)]
    ball = np.array([[math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)]
                     for a, b in grid])  # fmt: skip
    quads = [
        (i * n + j, (i + 1) * n + j, (i + 1) * n + (j + 1) % n, i * n + (j + 1) % n)
        for i in range(n) for j in range(n)
    ]  # fmt: skip
    write_obj(folder / "ball.obj", 0.5 * ball, quads)
    corners = np.array([[x, y, z] for x in (-0.4, 0.4) for y in (-0.3, 0.3) for z in (-0.2, 0.2)])
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    write_obj(folder / "box.obj", corners, sides)
    path = folder / "ball-and-box.xml"
    path.write_text(SCENE)
    return path


def request_of(scene: Path, out: Path, **values: Any) -> DatasetRequest:
    return DatasetRequest(scene=str(scene), out=out, sonar="fls", n_images=1, **values)


@pytest.fixture(scope="module")
def mounted_set(scene: Path) -> Path:
    out = scene.parent / "mounted"
    make_dataset(request_of(scene, out, is_mounted=True, formats=("plain", "coco")))
    return out


def record_of(folder: Path) -> dict[str, Any]:
    record: dict[str, Any] = json.loads((folder / "labels.jsonl").read_text().splitlines()[0])
    return record


def test_ids_agree_with_rays_that_are_cast_at_the_ball_and_the_box(
    scene: Path, mounted_set: Path
) -> None:
    record = record_of(mounted_set)
    mask = read_values(mounted_set / record["files"]["instances"])
    sonar, numbers = record["sonar"], {i["name"]: i["number"] for i in record["instances"]}
    assert set(numbers) == {"ball", "box"}
    columns = np.repeat(np.arange(61), 11)  # 11 azimuths in each beam
    offsets = np.tile(np.linspace(-0.45, 0.45, 11), 61)
    azimuths, elevations = np.radians(30.0 - columns - offsets), np.radians(np.arange(-8, 8, 0.1))
    azimuth, elevation = (a.ravel() for a in np.meshgrid(azimuths, elevations))
    directions = np.stack(
        [
            np.cos(elevation) * np.cos(azimuth),
            np.cos(elevation) * np.sin(azimuth),
            np.sin(elevation),
        ],
        axis=1,
    )
    pose = Pose.from_quaternion(np.array(sonar["position"]), np.array(sonar["quaternion_wxyz"]))
    with uwsim.load(scene, is_blind=True) as simulation:
        hits = simulation.world.rays.cast(pose, directions, 10.0)
        table = find_instances(simulation)
    is_hit = np.isfinite(hits.distance)
    owners = np.where(is_hit, table.instance_numbers[np.where(is_hit, hits.surface, 0)], 0)
    rows = np.floor((np.where(is_hit, hits.distance, 0.0) - 0.5) / 0.05).astype(int)
    columns = np.tile(columns, len(elevations))
    cast_mask = np.zeros_like(mask)
    cast_mask[rows[is_hit], columns[is_hit]] = owners[is_hit]
    for number in numbers.values():
        is_cast = cast_mask == number
        assert is_cast.sum() >= 8
        assert np.isin(mask[is_cast], (0, number)).all()
        # the sonar has fewer rays than this test: a bin that a few rays touch, or the nearest and
        # the farthest one, may be between its rays
        n_rays = np.zeros(mask.shape, int)
        np.add.at(n_rays, (rows[owners == number], columns[owners == number]), 1)
        hit_rows = np.flatnonzero(is_cast.any(axis=1))
        n_rays[[hit_rows[0], hit_rows[-1]]] = 0
        assert (n_rays >= 8).sum() > 20
        assert (mask[n_rays >= 8] == number).all()
        # beams receive echoes within 1.25 beam widths, and an echo covers the bins of its area
        near = np.zeros_like(is_cast)
        for row, column in zip(*np.nonzero(is_cast), strict=True):
            near[max(row - 2, 0) : row + 3, max(column - 2, 0) : column + 3] = True
        assert not ((mask == number) & ~near).any()
    assert set(np.unique(mask)) == {0, *numbers.values()}


def test_boxes_counts_and_directions_are_those_of_the_mask(mounted_set: Path) -> None:
    record = record_of(mounted_set)
    mask = read_values(mounted_set / record["files"]["instances"])
    for instance in record["instances"]:
        rows, columns = np.nonzero(mask == instance["number"])
        assert instance["visible_pixels"] == len(rows)
        box = [columns.min(), rows.min(), columns.max() + 1, rows.max() + 1]
        assert instance["box"] == box
        assert instance["visibility"] == 1.0
        assert instance["truncation"] == 0.0
    ball, box = record["instances"]
    assert ball["name"] == "ball"
    assert ball["azimuth"] > 0.0 > box["azimuth"]  # port is left
    assert ball["box"][2] <= box["box"][0]
    assert ball["distance"] == pytest.approx(math.hypot(5.6, 1.5), abs=0.05)
    u, v, flag = box["keypoints"][0]  # the corner with the least coordinates: near, starboard
    x, y, z = box["box_3d"]["corners"][0]
    assert u == pytest.approx((30.0 - math.degrees(math.atan2(y, x))), abs=1e-4)
    assert v == pytest.approx((math.sqrt(x * x + y * y + z * z) - 0.5) / 0.05 - 0.5, abs=1e-4)
    assert flag == 2


def test_coco_has_the_mask_of_each_instance(mounted_set: Path) -> None:
    documents = [json.loads(path.read_text()) for path in sorted((mounted_set / "coco").iterdir())]
    images = [image for document in documents for image in document["images"]]
    assert [(image["width"], image["height"]) for image in images] == [(61, 190)]
    annotations = [a for document in documents for a in document["annotations"]]
    assert {a["area"] for a in annotations} == {
        i["visible_pixels"] for i in record_of(mounted_set)["instances"]
    }


def test_the_echoes_of_all_instances_are_those_of_the_ping(scene: Path) -> None:
    with uwsim.load(scene, is_blind=True) as simulation:
        sonar = make_sonar(simulation, request_of(scene, scene.parent)).sonar
        pose = sonar.world_from_sonar
        numbers = find_instances(simulation).instance_numbers
        groups = sonar.echoes.separate_amplitudes(pose, numbers)
        power = sonar.echoes.power(pose)
        everything = sonar.echoes.separate_amplitudes(pose, (numbers > 0).astype(np.uint16))[1]
    total = np.sqrt(sum(amplitudes.astype(float) ** 2 for amplitudes in groups.values()))
    assert power.columns.max() > 0.0
    assert total == pytest.approx(everything, rel=1e-4, abs=1e-6 * float(everything.max()))


def test_poses_are_drawn_around_the_target(scene: Path, tmp_path: Path) -> None:
    request = request_of(scene, tmp_path / "set", targets=("box",))
    make_dataset(replace(request, n_images=3))
    lines = (request.out / "labels.jsonl").read_text().splitlines()
    for record in map(json.loads, lines):
        assert "box" in {instance["name"] for instance in record["instances"]}
    assert (request.out / "contact-sheet.png").exists()
    card = (request.out / "README.md").read_text()
    assert card.startswith("# 3 labelled sonar images of ")
    assert "depth" not in card


def test_what_a_sonar_has_not_is_refused(scene: Path, tmp_path: Path) -> None:
    with pytest.raises(UnknownName, match="fls"):
        make_dataset(replace(request_of(scene, tmp_path / "set"), sonar="fsl"))
    request = request_of(scene, tmp_path / "set", formats=("kitti",), size=(100, 100))
    with pytest.raises(SeveralErrors, match="KITTI has no sonar images"):
        request.check()
    far = request_of(scene, tmp_path / "set", distance=Range(5.0, 50.0))
    with pytest.raises(UwsimError, match="reaches 10 m"):
        make_dataset(far)
