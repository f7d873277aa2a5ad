"""Algorithms that know ROS's and OpenCV's image coordinates only are scored without a bias."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.support.short_trial import DATA, make_plan, rows_of
from uwsim.bus import Algorithm, Node
from uwsim.messages import CameraInfo, Float32MultiArray, Image, floats, pixels_of
from uwsim.scene.object import ObjectSpec
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.sensors.virtual_camera import VirtualCameraSpec

CAMERA, BOX = np.array([2.2, -0.1, 3.465]), np.array([2.0, 0.35, 4.735])  # in L [m]
PLATE = """mtllib plate.mtl
v -0.3 -0.2 0
v 0.3 -0.2 0
v 0.3 0.2 0
v -0.3 0.2 0
usemtl red
f 1 2 3 4
"""
CENTROID = """
<euclideanNorm u:truth="{truth}"> <name>centroid</name>
  <groundTruth type="centroidFromCamera">
    <camera>bowtech1</camera> <target>blackbox</target>
  </groundTruth>
  <target>centroidTopic</target>
</euclideanNorm>"""
FOG = """
<sceneFogUpdater> <initialValue>0</initialValue> <finalValue>0.05</finalValue> <step>0.1</step>
  <interval>0.3</interval>
</sceneFogUpdater>"""


class ByCameraInfo:
    """Projects the known place of the box with K as it comes, as OpenCV does."""

    def start(self, node: Node) -> None:
        self.say = node.publisher("centroidTopic", Float32MultiArray)
        node.subscribe("/uwsim/camera1_info", CameraInfo, self.on_info)

    def on_info(self, info: CameraInfo) -> None:
        north, east, down = BOX - CAMERA
        u, v, w = info.k.reshape(3, 3) @ [east, -north, down]  # x right, y down, z forwards
        self.say(floats([u / w, v / w]))


class ByPixels:
    """Publishes the mean row and column of all that is red."""

    def start(self, node: Node) -> None:
        self.say = node.publisher("centroidTopic", Float32MultiArray)
        node.subscribe("/uwsim/camera1", Image, self.on_image)

    def on_image(self, message: Image) -> None:
        red, _, blue = pixels_of(message).astype(int).transpose(2, 0, 1)
        rows, columns = np.nonzero(red > blue + 40)
        assert len(rows) > 1000
        self.say(floats([columns.mean(), rows.mean()]))


def error(folder: Path, algorithm: type[Algorithm], scene: SceneSpec, truth: str) -> float:
    plan = make_plan(
        folder, algorithm, FOG, scene=scene, measures=CENTROID.format(truth=truth),
        function="<function>centroid</function>",
    )  # fmt: skip
    (row,) = rows_of(replace(plan, data_path=(folder,)))
    assert row.status == "ok"
    value, _ = row.measures["centroid"]
    assert value is not None
    return value


def test_a_point_projected_with_the_published_camera_matrix_has_no_error(tmp_path: Path) -> None:
    scene = read_scene(DATA / "scenes" / "visibility-scene.xml")
    assert error(tmp_path, ByCameraInfo, scene, "original") == pytest.approx(0.0, abs=1e-4)


def test_the_mean_pixel_of_a_target_is_the_centre_of_its_face(tmp_path: Path) -> None:
    """A plate seen from above and turned, so that its edges cut pixels everywhere."""
    (tmp_path / "plate.obj").write_text(PLATE)
    (tmp_path / "plate.mtl").write_text("newmtl red\nKd 1 0 0\n")
    scene = read_scene(DATA / "scenes" / "visibility-scene.xml")
    (vehicle,) = scene.vehicles
    (camera,) = vehicle.parts_of(VirtualCameraSpec)
    plate = ObjectSpec(
        name="blackbox",
        file="plate.obj",
        position=(2.25, -0.15, 4.8),
        orientation=(np.pi, 0.0, 0.37),
    )
    scene = replace(
        scene,
        objects=(plate,),
        vehicles=(replace(vehicle, parts=(replace(camera, std=0.0),)),),
    )
    assert error(tmp_path, ByPixels, scene, "face") == pytest.approx(0.0, abs=0.05)
