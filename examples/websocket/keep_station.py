"""Keep a position in a current, and step the simulation; needs `websockets` alone.

    uwsim bench examples/ros1/keep_station.xml --web 9090 --client keep_station --sync step
    python examples/websocket/keep_station.py --uri ws://127.0.0.1:9090

Ten times a second of simulation time it reads the odometry, commands a velocity towards the goal,
and steps the simulation to the next time. Environments for learning have the same loop. Simulation
time waits while the program computes.
"""

import argparse
import json
import random
import time

from lockstep import open_connection

GOAL, KP = (-9.0, -8.0, 10.0), 0.4
TIMESTEP, PERIOD = 0.002, 0.1
RESULT_OK = 1
"""The code of success of simulation_interfaces/Result."""


class Simulation:
    """A client of the simulation over a WebSocket."""

    def __init__(self, socket) -> None:
        self._socket, self._n_calls = socket, 0
        self.latest_messages: dict[str, dict] = {}
        """The latest message of each topic."""

    def send(self, **frame) -> None:
        """Send a frame of the rosbridge protocol."""
        self._socket.send(json.dumps(frame))

    def call(self, service: str, **arguments) -> dict:
        """Call a service, and store the messages that arrive before its response."""
        self._n_calls += 1
        self.send(op="call_service", id=str(self._n_calls), service=service, args=arguments)
        while True:
            frame = json.loads(self._socket.recv())
            if frame["op"] == "publish":
                self.latest_messages[frame["topic"]] = frame["msg"]
            elif frame["op"] == "status":
                raise SystemExit(frame["msg"])
            elif frame["op"] == "service_response" and frame["id"] == str(self._n_calls):
                if not frame["result"]:
                    raise SystemExit(f"{service}: {frame['values']}")
                return frame["values"]

    def step(self, seconds: float) -> None:
        """Step the simulation by a time [s]."""
        answer = self.call("/step_simulation", steps=round(seconds / TIMESTEP))
        if answer["result"]["result"] != RESULT_OK:
            raise SystemExit(f"/step_simulation: {answer['result']['error_message']}")


def velocity(odometry: dict) -> list[float]:
    """Return the velocity towards the goal in the axes of the vehicle, 3 numbers [m/s]."""
    pose = odometry["pose"]["pose"]
    p, q = pose["position"], pose["orientation"]
    position = (p["x"], p["y"], p["z"])
    ground_velocity = [KP * (g - x) for g, x in zip(GOAL, position, strict=True)]
    axis = [q["x"], q["y"], q["z"]]
    cross_product = cross(axis, ground_velocity)  # the velocity, rotated by the inverse attitude
    return [
        v - 2.0 * q["w"] * t + 2.0 * u
        for v, t, u in zip(ground_velocity, cross_product, cross(axis, cross_product), strict=True)
    ]


def cross(a: list[float], b: list[float]) -> list[float]:
    """Return the cross product."""
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--uri", default="ws://127.0.0.1:9090")
    parser.add_argument(
        "--delay", type=float, default=0.0, help="longest random delay of a loop [ms]"
    )
    options = parser.parse_args()
    with open_connection(options.uri) as socket:
        simulation = Simulation(socket)
        simulation.send(op="subscribe", topic="/g500/odom")
        simulation.send(op="advertise", topic="/g500/twist", type="geometry_msgs/TwistStamped")
        simulation.step(PERIOD)
        simulation.call("/startBench")
        while True:
            if "/g500/odom" not in simulation.latest_messages:
                raise SystemExit("The topic /g500/odom has no message.")
            x, y, z = velocity(simulation.latest_messages["/g500/odom"])
            time.sleep(options.delay / 1000.0 * random.random())
            twist = {"linear": {"x": x, "y": y, "z": z}}
            simulation.send(op="publish", topic="/g500/twist", msg={"twist": twist})
            simulation.step(PERIOD)
    print("The simulation has ended.")


if __name__ == "__main__":
    main()
