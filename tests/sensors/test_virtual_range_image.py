"""Depth images against geometry, against the renderer's range, and on their topics."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.sensors.acoustic_world import AcousticWorld, FakeCarrier, plate, sphere
from tests.support.opened import open_scene
from uwsim.assets.find import find
from uwsim.base.geometry import Pose, rotation_from_rpy
from uwsim.messages import points
from uwsim.scene.reader import read_scene
from uwsim.sensors.pinhole import cast_depth
from uwsim.sensors.virtual_range_image import VirtualRangeImage, VirtualRangeImageSpec
from uwsim.topics.depth_images import optical_points

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>girona500</name> <file>g500ARM5.urdf</file>
    <jointValues> <joint>0</joint> <joint>0</joint> <joint>0</joint> <joint>0</joint>
      <joint>0</joint> </jointValues>
    <virtualCamera> <name>eye</name> <relativeTo>part0</relativeTo> <baseline>0.12</baseline>
      <u:lookAt>down</u:lookAt> </virtualCamera>
    <virtualRangeImage> <name>depth</name> <relativeTo>part0</relativeTo>
      <resw>32</resw> <resh>24</resh>
      <u:lookAt>down</u:lookAt> <frameId>lens</frameId> <u:std>0.01</u:std> </virtualRangeImage>
  </vehicle>
  <object> <name>terrain</name> <file>terrain/CIRS/cirs_trident.osg</file>
    <position> <x>0</x> <y>0</y> <z>0</z> </position>
    <orientation> <r>0</r> <p>0</p> <y>0</y> </orientation>
  </object>
  <rosInterfaces>
    <RangeImageSensorToROSImage> <cameraName>depth</cameraName> <imageTopic>/depth</imageTopic>
      <infoTopic>/depth_info</infoTopic> <rate>5</rate> </RangeImageSensorToROSImage>
    <VirtualCameraToROSImage> <cameraName>depth</cameraName> <imageTopic>/again</imageTopic>
      <infoTopic>/again_info</infoTopic> <rate>10</rate> <depth>1</depth> </VirtualCameraToROSImage>
    <RangeImageSensorToROSImage> <cameraName>eye</cameraName> <imageTopic>/eye</imageTopic>
      <infoTopic>/eye_info</infoTopic> </RangeImageSensorToROSImage>
    <RangeCameraToPCL> <cameraName>depth</cameraName> <topic>/cloud</topic> </RangeCameraToPCL>
  </rosInterfaces>
</UWSimScene>
"""


def make(world: AcousticWorld, *, tilt: float = 0.0, **fields: object) -> VirtualRangeImage:
    """A camera in the origin that looks straight down, but for its tilt."""
    spec = VirtualRangeImageSpec(name="depth", relative_to="base", **fields)  # type: ignore[arg-type]
    pose = Pose(np.zeros(3), rotation_from_rpy(tilt, 0.0, 0.0))
    return spec.bind(world, FakeCarrier(pose))  # type: ignore[arg-type]


def test_the_depth_of_a_level_plate_is_its_distance_in_every_pixel() -> None:
    """Along the optical axis, as in REP 118, not along the ray; beyond the plate +inf."""
    camera = make(AcousticWorld(plate(1.0, -4.0)), fovy=60.0)
    depth = camera.depth(0.0)
    rays = camera.intrinsics.rays()
    is_met = np.abs(4.0 * rays[..., :2]).max(axis=2) < 1.0
    assert depth.shape == (120, 160)
    assert np.abs(depth[is_met] - 4.0).max() < 1e-12
    assert is_met.any()
    assert (depth[~is_met] == np.inf).all()


def test_the_depth_of_a_slope_is_that_of_its_plane() -> None:
    tilt = 0.3
    camera = make(AcousticWorld(plate(50.0, -3.0)), tilt=tilt)
    normal = np.array([0.0, math.cos(tilt), math.sin(tilt)])[[0, 2, 1]]  # of the plate, in it
    wanted = 3.0 / -(camera.intrinsics.rays() @ normal)
    assert np.abs(camera.depth(0.0) - wanted).max() < 1e-9


def test_what_is_nearer_than_the_near_plane_is_not_seen_nor_what_is_beyond_the_far() -> None:
    world = AcousticWorld(plate(9.0, -0.1), plate(9.0, -3.0))
    assert make(world).depth(0.0) == pytest.approx(3.0)
    assert make(AcousticWorld(plate(9999.0, -2001.0))).depth(0.0).min() == math.inf


def test_points_are_on_the_surface_in_the_optical_frame() -> None:
    """A ball right of the axis and above: x > 0, y < 0; nothing beside it: NaN."""
    camera = make(AcousticWorld(sphere((0.4, 0.3, -3.0), 0.5, n=48)))
    cloud = optical_points(camera.depth(0.0), camera.intrinsics)
    radius = np.linalg.norm(cloud - [0.4, -0.3, 3.0], axis=2)
    assert cloud.shape == (120, 160, 3)
    assert np.nanmax(np.abs(radius - 0.5)) < 2e-3  # facets of the ball
    assert np.isnan(cloud[0, 0]).all()
    assert np.nanmean(cloud[..., 0]) > 0.3
    assert np.nanmean(cloud[..., 1]) < -0.2


def test_noise_has_its_deviation_and_depends_on_the_time_alone() -> None:
    """19 200 pixels: the deviation is within 2 % with a confidence of 99.9 %."""
    camera = make(AcousticWorld(plate(20.0, -4.0)), std=0.05)
    first = camera.depth(0.1)
    assert np.std(first) == pytest.approx(0.05, rel=0.02)
    assert np.array_equal(first, camera.depth(0.1))
    assert not np.array_equal(first, camera.depth(0.2))


def test_noise_beyond_the_planes_of_the_camera_is_infinite() -> None:
    depth = make(AcousticWorld(plate(20.0, -0.2)), std=0.02).depth(0.0)
    assert (depth == -np.inf).any()
    assert np.min(depth[np.isfinite(depth)]) >= 0.18


def test_topics_carry_depth_info_and_the_same_points(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    path.write_text(SCENE)
    with open_scene(read_scene(path), is_blind=True) as simulation:
        assert simulation.topics["cloud"] == "sensor_msgs/msg/PointCloud2"
        topics = ("/depth", "/depth_info", "/again", "/cloud", "/eye", "/eye_info")
        for topic in topics:
            simulation.latest_message(topic)
        simulation.advance(0.2)
        image, info, again, cloud, eye, eye_info = map(simulation.latest_message, topics)
    assert (image.encoding, image.step, image.header.frame_id) == ("32FC1", 128, "lens")
    depth = image.data.view(np.float32).reshape(24, 32)
    assert np.array_equal(image.data, again.data)
    assert (image.header.stamp.nanosec, info.height, info.width) == (200_000_000, 24, 32)
    assert (cloud.height, cloud.width, cloud.header.frame_id) == (24, 32, "depth")
    assert np.array_equal(points(cloud)[:, 2].astype(np.float32), depth.reshape(-1))
    assert (eye.height, eye.width) == (120, 160)
    assert eye_info.p[3] == pytest.approx(-eye_info.p[0] * 0.12)


def test_the_renderer_and_rays_give_the_same_depth(tmp_path: Path) -> None:
    """Of each pixel, but at the edges of bodies, where it may be of either."""
    path = tmp_path / "scene.xml"
    path.write_text(SCENE)
    with open_scene(read_scene(path)) as simulation:
        world, eye = simulation.world, simulation.world.sensors.camera("eye")
        drawn = eye.depth(0.0)
        cast = cast_depth(world.rays, eye.world_from_camera, eye.intrinsics)
    is_other = ~np.isclose(drawn, cast, rtol=1e-5)
    assert is_other.mean() < 0.01


def test_the_range_camera_of_the_tank_sees_its_floor() -> None:
    """As deep below the camera as below the sonar at its height."""
    path = find("cirs.xml")
    assert isinstance(path, Path)
    with open_scene(read_scene(path), is_blind=True) as simulation:
        simulation.latest_message("uwsim/rangecamera")
        simulation.advance()
        image = simulation.latest_message("uwsim/rangecamera")
    depth = image.data.view(np.float32).reshape(240, 320)
    assert np.median(depth) == pytest.approx(1.86, abs=0.05)
