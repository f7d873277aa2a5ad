"""A part of the algorithm `grasp` is replaced: station keeping by a law of one's own.

The law goes to its goal and learns the current from what is left of the way. It keeps the vehicle
over a flight recorder while the arm reaches down; all else is `grasp` as it is.
"""

import numpy as np

import uwsim
from uwsim.algorithms.grasp import Grasp, Motion
from uwsim.messages import String

GAIN = 0.5  # of the position [1/s]
LEARNING = 0.1  # of the current [1/s]
LAST = "descend"  # phase at which the example ends


class Learning:
    """A proportional law with an integral that is the current."""

    def __init__(self) -> None:
        self.current = np.zeros(3)  # north, east, down [m/s]

    def step(self, motion: Motion, dt: float) -> tuple[np.ndarray, float]:
        """Return the velocity through the water and the yaw rate, in the vehicle's axes."""
        self.current -= LEARNING * dt * np.clip(motion.error, -0.3, 0.3)
        wanted = np.clip(GAIN * motion.error, -0.3, 0.3) + motion.wanted - self.current
        return motion.rotation.T @ wanted, 0.5 * motion.turn


class MyGrasp(Grasp):
    """The algorithm grasp with that law."""

    def controller(self) -> Learning:
        """Return the law."""
        return Learning()


if __name__ == "__main__":
    phases = []
    with uwsim.load("grasp-scene", seed=1, timestep=0.005) as simulation:
        simulation.bus.subscribe("phase", String, lambda message: phases.append(message.data))
        simulation.attach(MyGrasp())
        while LAST not in phases and simulation.time < 60.0:
            simulation.advance(1.0)
    print(" -> ".join(phases))
