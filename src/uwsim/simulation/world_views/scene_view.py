"""The clock and the topics of a scene, which all its views but that of forces have."""

from __future__ import annotations

from ..physical_scene import PhysicalScene


class SceneView:
    """The base of the views of a scene (`uwsim.world.TimedWorld`).

    Args:
        scene: the scene.
    """

    def __init__(self, scene: PhysicalScene) -> None:
        self.bus = scene.bus
        """Its topics and services."""
        self.timestep = scene.model.timestep
        """Length of a step [s]."""

    @property
    def step(self) -> int:
        """Physics steps since the simulation began."""
        return self.bus.state.step

    @property
    def time(self) -> float:
        """``step * timestep`` [s]."""
        return self.bus.state.step * self.timestep
