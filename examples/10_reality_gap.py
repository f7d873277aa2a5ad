"""Make the log of a vehicle with 50 % more yaw drag, and let the reality gap find the coefficient.

The "real" vehicle is a BlueROV2 of the simulator with one changed coefficient, so that the answer
is known. Its commands, odometry and sensors are recorded as those of a real vehicle would be.
"""

import math
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import uwsim
from uwsim.messages import Float64MultiArray
from uwsim.middleware.recording import Recorder

SCENE, VEHICLE, TOPIC = "bluerov2-scene", "bluerov2", "bluerov2/thrusters"
DRAG = f"vehicle[{VEHICLE}].hydrodynamics.body[base_link].quadraticDamping"
TRUE_DRAG = "141 217 190 1.19 0.47 2.25"  # the set of the scene has 1.5 for yaw
SECONDS, STEP = 90.0, 0.05  # of simulation time [s]


def commands(simulation: uwsim.Simulation) -> np.ndarray:
    """Return commands of the thrusters: surge, sway and yaw vary, depth and tilt are held."""
    pose, (_, _, w, p, q, _) = simulation.pose(VEHICLE), simulation.velocity(VEHICLE)
    down = pose.rotation[2]  # the z axis of L in base axes
    time = simulation.time
    surge, sway = 0.25 * math.sin(0.5 * time), 0.15 * math.sin(0.31 * time + 1.0)
    yaw = 0.12 * math.copysign(1.0, math.sin(0.23 * time + 0.5))
    heave = 0.8 * (2.0 - pose.position[2]) - 0.5 * w
    roll, pitch = -0.6 * down[1] - 0.2 * p, 0.6 * down[0] - 0.2 * q
    thrusts_xy = [surge - sway - yaw, surge + sway + yaw, surge + sway - yaw, surge - sway + yaw]
    thrusts_z = [heave + x * pitch + y * roll for x, y in ((-1, 1), (-1, -1), (1, 1), (1, -1))]
    return np.clip(np.array([*thrusts_xy, *thrusts_z]), -0.8, 0.8)


def record(path: Path) -> None:
    """Record the commands, odometry and sensors of the vehicle."""
    with (
        uwsim.load(SCENE, settings={DRAG: TRUE_DRAG}, is_blind=True) as simulation,
        Recorder(simulation.bus, path) as recorder,
    ):
        recorder.start(lambda: simulation.time)
        for _ in range(round(SECONDS / STEP)):
            simulation.publish(TOPIC, Float64MultiArray(data=commands(simulation)))
            simulation.advance(STEP)


def main() -> None:
    with TemporaryDirectory() as folder:
        log = Path(folder) / "dive.mcap"
        record(log)
        gap = uwsim.gap(log, SCENE, horizons=(1, 5), windows=40)
    for error in gap.horizons:
        print(f"after {error.horizon:g} s: {error.distance.value:.2f} m, {error.n_windows} windows")
    print(gap.verdict)


if __name__ == "__main__":
    main()
