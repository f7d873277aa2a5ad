"""Grasp another object with the algorithm `grasp`: a valve, by the bar on its stem.

The example replaces two parts: `model` sets the grip point, `perception` detects the object in
images. The valve is detected by its colour and outline; your own object may need another detector.
"""

from pathlib import Path

import numpy as np

import uwsim
from uwsim.algorithms.grasp import ColourDetector, ConvexObject, ConvexPerception, Grasp
from uwsim.messages import String

SCENE = Path(__file__).with_name("valve") / "valve-scene.xml"
BASE_CORNERS = [(x, y, z) for x in (-0.13, 0.13) for y in (-0.13, 0.13) for z in (0.0, 0.06)]  # [m]
BAR_CORNERS = [(x, y, 0.166) for x in (-0.008, 0.008) for y in (-0.075, 0.075)]  # [m]
LAST_PHASES = "hold", "aborted"  # phases at which the example ends


class GraspValve(Grasp):
    """The algorithm `grasp` for the valve."""

    def model(self) -> ConvexObject:
        """Return the model of the valve: the jaw closes along x on the bar, beside the stem."""
        return ConvexObject(
            points=np.array(BASE_CORNERS + BAR_CORNERS), grip_point=np.array([0.0, 0.04, 0.158])
        )

    def perception(self) -> ConvexPerception:
        """Return the detector of the valve in images."""
        return ConvexPerception(ColourDetector(), self.model())


if __name__ == "__main__":
    phases = []
    with uwsim.load(SCENE, seed=2, timestep=0.005) as simulation:
        start = simulation.pose("valve").position[2]
        simulation.bus.subscribe("phase", String, lambda message: phases.append(message.data))
        simulation.attach(GraspValve())
        while (
            not any(phase.startswith(LAST_PHASES) for phase in phases) and simulation.time < 120.0
        ):
            simulation.advance(1.0)
        height = start - simulation.pose("valve").position[2]  # z points down in this scene
    print(" -> ".join(phases))
    print(f"raised by {height:.1f} m after {simulation.time:.0f} s")
