"""The record of an image of a scene: its model of the water, exposure and time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...base.files.image_record import ImageRecord
from .scene_water import choose_water

if TYPE_CHECKING:
    from ..simulation import Simulation


def describe_image(
    simulation: Simulation, camera: str, fog: float | None = None, *, is_linear: bool = False
) -> ImageRecord:
    """Return the record of an image at the present time.

    Args:
        simulation: the simulation.
        camera: the name of the camera or of the view.
        fog: the fog density of a view [1/m]; None: the water of the scene.
        is_linear: True if the camera's numbers are linear.
    """
    world = simulation.world
    scene_water = world.scenery.state.water
    physical_water = choose_water(scene_water, fog, world.model).physical_water
    is_purest = fog == 0.0
    name = world.model.scene.path.replace("\\", "/").rsplit("/", 1)[-1]
    if physical_water is None:
        return ImageRecord(
            scene=name,
            time=simulation.time,
            camera=camera,
            image_model="uwsim",
            water="purest" if is_purest else "scene",
        )
    return ImageRecord(
        scene=name,
        time=simulation.time,
        camera=camera,
        image_model="physical",
        water="purest" if is_purest else "scene",
        exposure=physical_water.exposure,
        transfer="linear" if is_linear else physical_water.transfer,
    )
