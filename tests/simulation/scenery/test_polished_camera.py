"""A polished camera: soft light and smooth edges in its images, and nothing else of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.simulation.small_robots import begin, scene_of, shape, write_robot
from uwsim.checks import check_file
from uwsim.errors import SceneError
from uwsim.scene.reader import read_scene
from uwsim.scene.vehicle import VehicleSpec
from uwsim.sensors.virtual_camera import VirtualCamera, VirtualCameraSpec
from uwsim.simulation import Simulation

SCENE = """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <virtualCamera> <name>eye</name> <relativeTo>base_link</relativeTo>
      <u:quality>{}</u:quality> </virtualCamera>
  </vehicle>
</UWSimScene>
"""


def two_cameras(folder: Path, *, std: float = 0.0, grayscale: bool = False) -> Simulation:
    """A turned box under a lid, seen from the side by a plain and a polished camera."""
    box = shape(size=(0.5, 0.5, 0.5), xyz="3 0 0", rpy="0.4 0.2 0.5", colour="0.9 0.9 0.9 1")
    lid = shape(size=(0.4, 0.4, 0.02), xyz="3 0 0.8")
    cameras = [
        VirtualCameraSpec(
            name=quality, relative_to="base", orientation=(np.pi / 2, 0.0, -np.pi / 2),
            quality=quality, std=std, grayscale=grayscale,
        )
        for quality in ("plain", "polished")
    ]  # fmt: skip
    file = str(write_robot(folder, f'<link name="base">{box}{lid}</link>'))
    return begin(scene_of(VehicleSpec(name="r", file=file, parts=tuple(cameras))))


def pair(simulation: Simulation) -> tuple[VirtualCamera, VirtualCamera]:
    sensors = simulation.world.sensors
    return sensors.camera("plain"), sensors.camera("polished")


def steps_across(image: np.ndarray) -> float:
    """The mean square of differences between pixels side by side: less where edges are smooth."""
    return float((np.diff(image.astype(float), axis=1) ** 2).mean())


def test_edges_of_polished_images_are_smooth(tmp_path: Path) -> None:
    with two_cameras(tmp_path) as simulation:
        plain, polished = (camera.capture() for camera in pair(simulation))
    assert polished.shape == plain.shape
    assert steps_across(polished) < 0.8 * steps_across(plain)
    assert np.abs(polished.astype(int) - plain).mean() < 4.0


def test_a_pixel_is_the_mean_of_four_of_an_image_twice_as_large(tmp_path: Path) -> None:
    with two_cameras(tmp_path) as simulation:
        camera = pair(simulation)[1]
        small, lens = camera.capture().astype(float), camera.intrinsics
        large = simulation.world.scenery.render_clean(
            camera.world_from_camera, lens.with_size(2 * lens.width, 2 * lens.height),
            is_polished=True,
        ).colour  # fmt: skip
    assert large is not None
    means = large.reshape(lens.height, 2, lens.width, 2, 3).mean(axis=(1, 3))
    assert np.abs(small - means).max() <= 0.5


def test_noise_is_added_after_the_mean_and_draws_as_many_numbers(tmp_path: Path) -> None:
    with two_cameras(tmp_path, std=0.05) as simulation:
        plain, polished = pair(simulation)
        spread = []
        for camera in (plain, polished):
            clean = simulation.world.scenery.render_clean(
                camera.world_from_camera, camera.intrinsics, targets={"colour"},
                is_polished=camera.is_polished,
            ).colour  # fmt: skip
            assert clean is not None
            noise = camera.capture().astype(float) - clean
            spread.append(noise[(clean > 40) & (clean < 215)].std())
            twin = np.random.Generator(np.random.Philox())
            twin.bit_generator.state = camera.state.rng.bit_generator.state
            camera.capture()
            twin.integers(2**63)
            assert twin.integers(2**63) == camera.state.rng.integers(2**63)
    assert spread == pytest.approx([0.05 * 255.0] * 2, rel=0.05)


def test_depth_and_ids_do_not_depend_on_the_quality(tmp_path: Path) -> None:
    with two_cameras(tmp_path) as simulation:
        depths = [camera.depth(0.0) for camera in pair(simulation)]
        plain, polished = (simulation.image(name) for name in ("plain", "polished"))
    assert np.array_equal(*depths)
    assert np.array_equal(plain.ids, polished.ids)  # type: ignore[arg-type]
    assert not np.array_equal(plain.colour, polished.colour)  # type: ignore[arg-type]


def test_a_polished_camera_may_be_grey(tmp_path: Path) -> None:
    with two_cameras(tmp_path, grayscale=True) as simulation:
        plain, polished = (camera.capture() for camera in pair(simulation))
    assert polished.shape == plain.shape == (120, 160)


def test_check_states_what_polish_costs(tmp_path: Path) -> None:
    file = tmp_path / "scene.xml"
    file.write_text(SCENE.format("polished"))
    warnings = [f"{each.line}: {each.message}" for each in check_file(file)]
    cost = "4: 'eye': a polished image takes three to four times the time of a plain one"
    assert cost in warnings
    file.write_text(SCENE.format("plain"))
    assert not any("polished" in each.message for each in check_file(file))


def test_a_quality_that_is_none_is_an_error(tmp_path: Path) -> None:
    file = tmp_path / "scene.xml"
    file.write_text(SCENE.format("polishd"))
    with pytest.raises(SceneError, match=r"polishd.*plain.*polished"):
        read_scene(file)
