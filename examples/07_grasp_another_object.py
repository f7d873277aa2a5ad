"""The algorithm `grasp` takes another object: a valve, by the bar on its stem.

Two parts are replaced: `model` says where the jaw takes the object, `perception` finds it in
images. A valve is found by its colour and outline; an object of your own may be found as you like.
"""

from pathlib import Path

import numpy as np

import uwsim
from uwsim.algorithms.grasp import ColourDetector, ConvexObject, ConvexPerception, Grasp
from uwsim.messages import String

SCENE = Path(__file__).with_name("valve") / "valve-scene.xml"
BASE = [(x, y, z) for x in (-0.13, 0.13) for y in (-0.13, 0.13) for z in (0.0, 0.06)]  # m
BAR = [(x, y, 0.166) for x in (-0.008, 0.008) for y in (-0.075, 0.075)]  # m
LAST = "hold", "aborted"  # phases at which the example ends


class GraspValve(Grasp):
    """The algorithm grasp for the valve."""

    def model(self) -> ConvexObject:
        """Return the valve: the jaw closes along x on the bar, beside the stem."""
        return ConvexObject(points=np.array(BASE + BAR), grip_point=np.array([0.0, 0.04, 0.158]))

    def perception(self) -> ConvexPerception:
        """Return what finds the valve in every image."""
        return ConvexPerception(ColourDetector(), self.model())


if __name__ == "__main__":
    phases = []
    with uwsim.load(SCENE, seed=2, timestep=0.005) as simulation:
        start = simulation.pose("valve").position[2]
        simulation.bus.subscribe("phase", String, lambda message: phases.append(message.data))
        simulation.attach(GraspValve())
        while not any(phase.startswith(LAST) for phase in phases) and simulation.time < 120.0:
            simulation.advance(1.0)
        raised = start - simulation.pose("valve").position[2]  # z points down in this scene
    print(" -> ".join(phases))
    print(f"raised by {raised:.1f} m after {simulation.time:.0f} s")
