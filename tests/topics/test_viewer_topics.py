"""Images and clouds that a viewer shows are kept as the original shows them."""

from __future__ import annotations

from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.messages import Image, PointCloud2, PointField, header, image, point_cloud
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation
from uwsim.topics.viewer_topics import (
    HudImage,
    PointClouds,
    ROSImageToHUDSpec,
    ROSPointCloudLoaderSpec,
    jet,
)

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "visibility-scene.xml"
PIXELS = (np.arange(2 * 3 * 3) * 13 % 256).astype(np.uint8).reshape(2, 3, 3)


def opened(*interfaces: object) -> Simulation:
    scene = read_scene(SCENE)
    return open_scene(replace(scene, ros_interfaces=interfaces), is_blind=True)


def of(simulation: Simulation, kind: type) -> list:
    return [each for each in simulation.world.interfaces if isinstance(each, kind)]


def test_the_newest_image_of_the_right_size_is_kept() -> None:
    hud = ROSImageToHUDSpec(width=3, height=2, image_topic="/seen")
    grey = ROSImageToHUDSpec(width=3, height=2, black_white=True, image_topic="/grey")
    with opened(hud, grey) as simulation:
        shown, of_grey = of(simulation, HudImage)
        assert shown.pixels is None
        simulation.publish("/seen", image(PIXELS, time=0.0))
        simulation.publish("/grey", image(PIXELS[..., 0], time=0.0))
        simulation.advance()
        assert np.array_equal(shown.pixels, PIXELS)
        assert np.array_equal(of_grey.pixels, PIXELS[..., 0])
        saved = simulation.save()
        for wrong in (PIXELS[:1], PIXELS[..., 0]):
            simulation.publish("/seen", image(wrong, time=0.0))
            simulation.advance()
            assert "expected" in shown.state.problem
        simulation.publish("/seen", Image(width=3, height=2, encoding="rgb8"))
        simulation.advance()
        assert shown.state.problem == "the image is not of 18 bytes"
        assert np.array_equal(shown.pixels, PIXELS)
        simulation.restore(saved)
        assert shown.state.problem is None


def coloured(places: np.ndarray, colours: np.ndarray, frame: str) -> PointCloud2:
    packed = np.zeros((len(places), 16), dtype=np.uint8)
    packed[:, :12] = places.astype("<f4").view(np.uint8).reshape(-1, 12)
    packed[:, 12:15] = colours[:, ::-1]
    names = ("x", "y", "z", "rgb")
    return PointCloud2(
        header=header(0.0, frame),
        height=1,
        width=len(places),
        fields=[PointField(name, 4 * i, 7, 1) for i, name in enumerate(names)],
        point_step=16,
        row_step=16 * len(places),
        data=packed.reshape(-1),
    )


def test_a_cloud_stays_where_its_frame_was_when_it_came() -> None:
    places = np.array([[0.0, 0.0, 0.0], [1.0, 2.0, 3.0], [np.nan, 0.0, 0.0]])
    colours = np.array([[255, 0, 1], [2, 3, 4], [0, 0, 0]], dtype=np.uint8)
    with opened(ROSPointCloudLoaderSpec(topic="/cloud")) as simulation:
        (loader,) = of(simulation, PointClouds)
        simulation.publish("/cloud", coloured(places, colours, "girona500"))
        simulation.advance()
        (cloud,) = loader.state.clouds
        pose = simulation.pose("girona500")
        assert cloud.points == pytest.approx(pose.transform(places[:2]), abs=1e-5)
        assert cloud.colours.tolist() == [[255, 0, 1], [2, 3, 4]]
        simulation.publish("/cloud", point_cloud(places[:2], frame_id="girona500/base_link"))
        simulation.advance()
        (cloud,) = loader.state.clouds
        assert cloud.colours.tolist() == jet(places[:2, 2]).tolist()


def test_without_del_last_pcd_clouds_add_up_and_unknown_frames_are_named() -> None:
    with opened(ROSPointCloudLoaderSpec(topic="/cloud", del_last_pcd=False)) as simulation:
        (loader,) = of(simulation, PointClouds)
        for frame in ("girona500", "girona500", "nowhere"):
            simulation.publish("/cloud", point_cloud(np.zeros((2, 3)), frame_id=frame))
        simulation.advance()
        assert len(loader.state.clouds) == 2
        assert "'nowhere'" in loader.state.problem


def test_heights_are_coloured_by_the_ramp() -> None:
    found = jet(np.array([0.0, 0.25, 0.5, 0.75, 1.0]))
    expected = [[0, 0, 128], [0, 128, 255], [128, 255, 128], [255, 128, 0], [128, 0, 0]]
    assert found == pytest.approx(np.array(expected), abs=1)
    assert jet(np.array([2.0, 2.0])).tolist() == [[128, 255, 128]] * 2
    assert jet(np.empty(0)).shape == (0, 3)
