"""Replace a part of the algorithm `grasp`: use your own control law for station keeping.

The law is proportional and estimates the current from the position error. It keeps the vehicle
above a flight recorder while the arm reaches down; all other parts of `grasp` stay the same.
"""

import numpy as np

import uwsim
from uwsim.algorithms.grasp import Grasp, TrackingState
from uwsim.messages import String

GAIN = 0.5  # of the position error [1/s]
ADAPTATION_GAIN = 0.1  # of the current estimate [1/s]
LAST_PHASE = "descend"  # phase at which the example ends


class AdaptiveLaw:
    """A proportional law whose integral term estimates the current."""

    def __init__(self) -> None:
        self.current = np.zeros(3)  # north, east, down [m/s]

    def step(self, state: TrackingState, dt: float) -> tuple[np.ndarray, float]:
        """Return the velocity through the water and the yaw rate, in the vehicle's axes."""
        self.current -= ADAPTATION_GAIN * dt * np.clip(state.error, -0.3, 0.3)
        velocity = np.clip(GAIN * state.error, -0.3, 0.3) + state.goal_velocity - self.current
        return state.rotation.T @ velocity, 0.5 * state.heading_error


class MyGrasp(Grasp):
    """The algorithm `grasp` with this law."""

    def controller(self) -> AdaptiveLaw:
        """Return the control law."""
        return AdaptiveLaw()


if __name__ == "__main__":
    phases = []
    with uwsim.load("grasp-scene", seed=1, timestep=0.005) as simulation:
        simulation.bus.subscribe("phase", String, lambda message: phases.append(message.data))
        simulation.attach(MyGrasp())
        while LAST_PHASE not in phases and simulation.time < 60.0:
            simulation.advance(1.0)
    print(" -> ".join(phases))
