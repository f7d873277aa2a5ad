"""The base of the views of a running scene: its clock and its bus."""

from __future__ import annotations

from ..physical_scene import PhysicalScene


class SceneView:
    """The clock and the bus of most views (`uwsim.world.TimedWorld`)."""

    def __init__(self, scene: PhysicalScene) -> None:
        self.bus = scene.bus
        """The topics and services."""
        self.timestep = scene.model.timestep
        """The length of a step [s]."""

    @property
    def step(self) -> int:
        """The number of physics steps since the simulation began."""
        return self.bus.state.step

    @property
    def time(self) -> float:
        """The simulation time, ``step * timestep`` [s]."""
        return self.bus.state.step * self.timestep
