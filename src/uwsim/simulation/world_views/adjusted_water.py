"""The water of a running scene for scene updaters."""

from __future__ import annotations

from dataclasses import replace

from ...devices.lamp import MAX_LAMPS
from ...errors import UwsimError
from ...optics import Medium
from ...world import LineOfSight
from ..physical_scene import PhysicalScene
from ..scenery.board_exposure import expose_board
from ..scenery.light_sources import make_lamp


class AdjustedWater:
    """The water of a running scene, which scene updaters change (`uwsim.world.StageWater`)."""

    def __init__(self, scene: PhysicalScene) -> None:
        self._scenery = scene.scenery
        self.medium = scene.model.optical_water
        """The optical properties in the scene file; None if the water is not physical."""
        self.set_wave_height = scene.water.set_wave_height

    def set_medium(self, medium: Medium, *, sight: LineOfSight | None = None) -> None:
        """Set the optical properties; raise UwsimError if the water is not physical.

        Args:
            medium: the water, in red, green and blue.
            sight: the line of sight to a white board, for which the exposure of the cameras is set
                anew; None: the exposure remains.
        """
        scenery = self._scenery
        state = scenery.state
        if state.water.physical_water is None:
            raise UwsimError(
                'The scene has no physical water; expected <u:water law="physical"> in its '
                "<oceanState>."
            )
        physical_water = replace(state.water.physical_water, medium=medium)
        water = replace(state.water, physical_water=physical_water)
        if sight is not None:
            lamps = [make_lamp(lamp) for lamp in scenery.mounted_lamps if lamp.is_on]
            water = expose_board(water, state.light.rate, lamps[:MAX_LAMPS], sight)
        state.water = water
