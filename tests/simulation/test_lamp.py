"""Lamps of vehicles: read from the scene, checked, and shining where their link is."""

from __future__ import annotations

from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.base.geometry import Pose
from uwsim.checks import check_file
from uwsim.devices.lamp import LampSpec
from uwsim.errors import UnknownName, UwsimError
from uwsim.rendering.lights.lamp import MAX_HALF_ANGLE
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.simulation import Simulation

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "visibility-scene.xml"

LAMP = LampSpec(
    name="headlight",
    relative_to="part0",
    position=(-0.35, -0.55, 0.0),
    orientation=(0.0, np.pi, np.pi / 2.0),
    intensity=2.0,
)
"""BackgroundProcess the camera, looking down as it does."""


def night(*lamps: LampSpec, vr: bool = False) -> SceneSpec:
    scene = read_scene(SCENE)
    (vehicle,) = scene.vehicles
    return replace(
        scene,
        sim_params=replace(scene.sim_params, light_rate=0.0),
        vehicles=(replace(vehicle, parts=(*vehicle.parts, *lamps), vr=vr),),
    )


def brightness(simulation: Simulation) -> np.ndarray:
    camera = simulation.world.sensors.camera("bowtech1")
    colour = simulation.world.scenery.render_clean(
        camera.world_from_camera, camera.intrinsics
    ).colour
    assert colour is not None
    return colour[..., 0].astype(float)


def test_a_lamp_lights_the_black_box_at_night() -> None:
    simulation = open_scene(night(LAMP))
    dark = open_scene(night())
    seen, nothing = brightness(simulation), brightness(dark)
    assert nothing.max() <= 1.0
    assert seen[170:174, 215:235].max() > 150.0  # the orange of its side, under the lamp
    assert seen[:, :100].max() <= 1.0  # outside the cone
    simulation.close()
    dark.close()


def test_the_light_goes_with_the_vehicle() -> None:
    simulation = open_scene(night(LAMP))
    before = brightness(simulation)
    state = simulation.world.engine
    higher = Pose(np.array([0.0, 0.0, 0.5]), np.eye(3)) @ state.poses.vehicle(0)
    state.place_vehicle(0, higher)
    after = brightness(simulation)
    # The floor was 1.4 m below and is now 1.9 m: about (1.4 / 1.9)^2 of the light.
    assert 0.4 < np.percentile(after, 90) / np.percentile(before, 90) < 0.9
    simulation.close()


def test_the_light_of_the_scene_does_not_dim_a_lamp() -> None:
    simulation = open_scene(night(LAMP))
    at_night = brightness(simulation)
    simulation.world.scenery.set_light_rate(0.3)
    assert (brightness(simulation) >= at_night).all()
    simulation.close()


def test_the_lamp_of_a_ghost_does_not_shine() -> None:
    simulation = open_scene(night(LAMP, vr=True))
    assert brightness(simulation).max() <= 1.0
    simulation.close()


def test_a_lamp_on_no_link_and_a_fifth_lamp_are_refused() -> None:
    with pytest.raises(UnknownName, match="part9"):
        open_scene(night(replace(LAMP, relative_to="part9")))
    with pytest.raises(UwsimError, match="5 lamps"):
        open_scene(night(*[LAMP] * 5))


def test_the_check_finds_both_and_a_cone_too_wide(tmp_path: Path) -> None:
    lamp = "<u:lamp><u:name>{}</u:name><u:relativeTo>{}</u:relativeTo>{}</u:lamp>"
    lamps = "".join(lamp.format(n, "part0", "") for n in range(4)) + lamp.format("l", "part9", "")
    text = SCENE.read_text("utf-8").replace("<UWSimScene>", '<UWSimScene xmlns:u="urn:uwsim:1">')
    file = tmp_path / "scene.xml"
    file.write_text(text.replace("</vehicle>", f"{lamps}</vehicle>"), "utf-8")
    said = [diagnostic.message for diagnostic in check_file(file) if diagnostic.severity == "error"]
    assert any("'part9' is no link" in message for message in said)
    assert any("more than 4 lamps" in message for message in said)
    assert len(said) == 2
    wide = lamp.format("l", "part0", "<u:fov>170</u:fov>")
    file.write_text(text.replace("</vehicle>", f"{wide}</vehicle>"), "utf-8")
    (said_of_fov,) = [f.message for f in check_file(file) if f.severity == "error"]
    assert "fov" in said_of_fov


def test_a_cone_is_at_most_160_degrees_wide() -> None:
    assert np.degrees(MAX_HALF_ANGLE) * 2.0 == pytest.approx(160.0)
