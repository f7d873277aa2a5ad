"""Cameras with a response and a lens in a scene."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import begin, scene_of, shape, write_robot
from uwsim.benchmark.updaters import CameraNoiseUpdaterSpec
from uwsim.errors import SceneError, UwsimError
from uwsim.messages import numbers_of, pixels_of
from uwsim.scene.reader import read_scene
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors.camera import LensSpec, ResponseSpec
from uwsim.sensors.camera.lens import FlatPortSpec
from uwsim.sensors.pinhole import cast_depth, cast_surfaces
from uwsim.sensors.virtual_camera import VirtualCamera, VirtualCameraSpec
from uwsim.simulation import Simulation

FLAT = LensSpec(flat_port=FlatPortSpec())
BARREL = LensSpec(k1=-0.2, k2=0.03, p1=0.002)
LINEAR = ResponseSpec(output="linear12", exposure_time=0.05)
SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <virtualCamera> <name>eye</name> <relativeTo>base_link</relativeTo>
      {}
    </virtualCamera>
  </vehicle>
</UWSimScene>
"""


def one_camera(folder: Path, **settings: object) -> Simulation:
    """A turned box of another vehicle before a camera, and a small one of its own in the corner."""
    far_box = shape(size=(1.0, 1.0, 1.0), xyz="3 0 0", rpy="0.4 0.2 0.5", colour="0.9 0.9 0.9 1")
    own_box = shape(size=(0.1, 0.2, 0.2), xyz="1 0.35 0.25", colour="0.9 0.2 0.1 1")
    camera = VirtualCameraSpec(
        name="eye", relative_to="base", orientation=(np.pi / 2, 0.0, -np.pi / 2), **settings
    )  # type: ignore[arg-type]
    own_file, far_file = (
        str(write_robot(folder / name, f'<link name="base">{box}</link>'))
        for name, box in (("own", own_box), ("far", far_box))
    )
    scene = scene_of(VehicleSpec(name="r", file=own_file, parts=(camera,)))
    target = VehicleSpec(name="target", file=far_file)
    return begin(replace(scene, vehicles=(*scene.vehicles, target)))


def camera_of(simulation: Simulation) -> VirtualCamera:
    return simulation.world.sensors.camera("eye")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    for name in ("own", "far"):
        (tmp_path / name).mkdir()
    return tmp_path


@pytest.mark.parametrize("is_grey", [False, True])
def test_linear_images_have_twelve_bits_in_messages_of_sixteen(folder: Path, is_grey: bool) -> None:
    with one_camera(folder, response=LINEAR, grayscale=is_grey) as simulation:
        message = camera_of(simulation).sample(0.0)
    assert message.encoding == ("mono16" if is_grey else "rgb16")
    assert message.step == 160 * 2 * (1 if is_grey else 3)
    numbers = numbers_of(message)
    assert numbers.max() <= 4095
    assert numbers.max() > 1000
    assert np.array_equal(pixels_of(message), numbers >> 4)


def test_an_image_that_nothing_reads_draws_its_random_number(folder: Path) -> None:
    with one_camera(folder, response=LINEAR, std=0.0) as simulation:
        camera = camera_of(simulation)
        start = camera.state.rng.bit_generator.state
        camera.capture()
        second_image = camera.capture()
        camera.state.rng.bit_generator.state = start
        camera.skip()
        assert np.array_equal(camera.capture(), second_image)


def test_a_sweep_of_noise_that_no_camera_has_is_an_error(folder: Path) -> None:
    with one_camera(folder, response=LINEAR) as simulation:
        stage = simulation.world.stage_view
        with pytest.raises(UwsimError, match="<u:response>"):
            stage.set_camera_noise(0.1)
        sweep = CameraNoiseUpdaterSpec(initial_value=0.0, final_value=0.1, step=0.1, interval=1.0)
        with pytest.raises(UwsimError, match="<u:response>"):
            sweep.bind(stage)


def test_binding_a_sweep_of_noise_leaves_the_noise_of_the_scene(folder: Path) -> None:
    sweep = CameraNoiseUpdaterSpec(initial_value=0.0, final_value=0.1, step=0.1, interval=1.0)
    with one_camera(folder, std=0.05) as simulation:
        updater = sweep.bind(simulation.world.stage_view)
        assert camera_of(simulation).state.std == 0.05
        updater.apply(0.1)
        assert camera_of(simulation).state.std == 0.1


@pytest.mark.parametrize("lens", [FLAT, BARREL])
def test_segmentation_and_depth_are_those_of_the_rays_of_the_lens(
    folder: Path, lens: LensSpec
) -> None:
    with one_camera(folder, lens=lens) as simulation:
        camera, world = camera_of(simulation), simulation.world
        pose, pinhole = camera.world_from_camera, camera.intrinsics
        ids = world.scenery.segmentation(pose, pinhole)
        cast_ids = cast_surfaces(world.rays, pose, pinhole)
        depth, ray_depth = camera.depth(0.0), cast_depth(world.rays, pose, pinhole)
        straight_ids = world.scenery.segmentation(pose, replace(pinhole, lens=None))
    assert len(np.unique(ids)) == 3
    assert (ids == cast_ids).mean() > 0.99  # but for edges
    assert (ids == straight_ids).mean() < 0.99
    is_common = np.isfinite(depth) & np.isfinite(ray_depth)
    errors = np.abs(depth[is_common] / ray_depth[is_common] - 1.0)
    assert np.quantile(errors, 0.98) < 0.02  # half a pixel of 170 on slopes up to 75 degrees


def test_camera_info_has_the_lens(folder: Path) -> None:
    with one_camera(folder, lens=BARREL) as simulation:
        info = camera_of(simulation).info(0.0)
    assert info.distortion_model == "plumb_bob"
    assert info.d.tolist() == [-0.2, 0.03, 0.002, 0.0, 0.0]


def test_camera_info_behind_a_flat_port_has_the_focal_length_in_water(folder: Path) -> None:
    with one_camera(folder, lens=FLAT) as simulation:
        info = camera_of(simulation).info(0.0)
    in_air = VirtualCameraSpec(name="eye", relative_to="base").intrinsics()
    assert info.k[0] == pytest.approx(1.333 * in_air.fx)
    assert info.distortion_model == "plumb_bob"
    assert info.d[0] == pytest.approx(0.38, abs=0.03)  # (n^2 - 1) / 2 of a far object is 0.388


def test_motion_blurs_the_scene_but_not_the_own_vehicle(folder: Path) -> None:
    with one_camera(folder, response=LINEAR) as simulation:
        camera, scenery = camera_of(simulation), simulation.world.scenery
        assert camera._response is not None
        assert camera._motion is not None
        exposure = camera._make_exposure(camera._response, camera._motion)
        quiet = replace(exposure, response=replace(exposure.response, has_noise=False))
        moving = replace(quiet, velocity=np.array([0.0, 3.0, 0.0]))
        ids = scenery.segmentation(camera.world_from_camera, camera.intrinsics)
        own_id = next(n for n, name in scenery.part_names.items() if name.startswith("r/"))
        at_rest, blurred = (scenery.render(e).astype(float) for e in (quiet, moving))
        again = scenery.render(quiet).astype(float)
    is_own = ids == own_id
    inside = is_own & np.roll(is_own, 1, 0) & np.roll(is_own, -1, 0)
    inside &= np.roll(is_own, 1, 1) & np.roll(is_own, -1, 1)
    assert inside.sum() > 20
    assert np.abs(blurred - at_rest)[inside].max() < 40.0  # of 4095; light and rounding
    assert np.abs(blurred - at_rest)[~is_own].max() > 400.0
    assert np.array_equal(again, at_rest)  # the vehicle is back at its pose


def test_all_errors_of_a_camera_are_reported_at_once(tmp_path: Path) -> None:
    scene = tmp_path / "scene.xml"
    scene.write_text(
        SCENE.format(
            "<u:response><u:shutter>rolling</u:shutter><u:falloff>-0.5 -0.6</u:falloff>"
            "</u:response>\n<u:lens><u:flatPort/><u:domePort/></u:lens>"
        )
    )
    with pytest.raises(SceneError) as caught:
        read_scene(scene)
    text = str(caught.value)
    assert "rolling without a <u:rowTime>" in text
    assert "<u:falloff> has 2 numbers" in text
    assert "<u:flatPort> and a <u:domePort>" in text


def test_a_lens_that_folds_the_image_is_an_error_of_its_element(tmp_path: Path) -> None:
    scene = tmp_path / "scene.xml"
    scene.write_text(SCENE.format("<fovy>90</fovy>\n<u:lens><u:k1>-0.8</u:k1></u:lens>"))
    with pytest.raises(SceneError, match=r"scene\.xml:5: The lens has no ray"):
        read_scene(scene)
