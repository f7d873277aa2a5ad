"""Fog that a benchmark turns up: thicker, and still of the scene's colour."""

from __future__ import annotations

from dataclasses import replace
from importlib import resources
from pathlib import Path

import numpy as np
import pytest

from tests.support.opened import open_scene
from uwsim.scene.ocean_state import FogSpec
from uwsim.scene.reader import read_scene

SCENE = Path(str(resources.files("uwsim"))) / "data" / "scenes" / "visibility-scene.xml"


def test_a_fog_updater_changes_how_thick_the_fog_is_and_not_its_colour() -> None:
    scene = read_scene(SCENE)
    colour = (0.1, 0.5, 0.2)  # of a harbour
    fog = FogSpec(density=0.1, color=colour)
    murky = replace(scene, ocean_state=replace(scene.ocean_state, fog=fog))
    simulation = open_scene(murky)
    try:
        simulation.world.scenery.set_fog(20.0)
        camera = simulation.world.sensors.camera("bowtech1")
        image = simulation.world.scenery.render_clean(camera.world_from_camera, camera.intrinsics)
    finally:
        simulation.close()
    assert simulation.world.stage_view.fog_colour == colour
    assert image.colour is not None
    middle = image.colour[120, 160].astype(float) / 255.0
    assert middle == pytest.approx(np.array(colour), abs=0.003)
