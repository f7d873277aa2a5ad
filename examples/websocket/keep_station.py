"""Keep a place in a current, and take the steps of the simulation: needs `websockets` alone.

    uwsim bench examples/ros1/keep_station.xml --web 9090 --client keep_station --sync step
    python examples/websocket/keep_station.py --uri ws://127.0.0.1:9090

Ten times a second of simulation time it reads the odometry, commands a velocity towards the place,
and lets the simulation take the steps to the next time. It is the loop of a controller that has a
`step`, as environments for learning have; time stands while it computes.
"""

import argparse
import json
import random
import time

from lockstep import connected

GOAL, KP = (-9.0, -8.0, 10.0), 0.4
TIMESTEP, PERIOD = 0.002, 0.1
DONE = 1
"""Of simulation_interfaces/Result."""


class Simulation:
    """The simulation at the other end of a connection."""

    def __init__(self, socket) -> None:
        self._socket, self._n_calls = socket, 0
        self.newest: dict[str, dict] = {}
        """Topic -> newest message."""

    def send(self, **frame) -> None:
        """Send a frame of rosbridge."""
        self._socket.send(json.dumps(frame))

    def call(self, service: str, **arguments) -> dict:
        """Call a service, and take in what is published until it has answered."""
        self._n_calls += 1
        self.send(op="call_service", id=str(self._n_calls), service=service, args=arguments)
        while True:
            frame = json.loads(self._socket.recv())
            if frame["op"] == "publish":
                self.newest[frame["topic"]] = frame["msg"]
            elif frame["op"] == "status":
                raise SystemExit(frame["msg"])
            elif frame["op"] == "service_response" and frame["id"] == str(self._n_calls):
                if not frame["result"]:
                    raise SystemExit(f"{service}: {frame['values']}")
                return frame["values"]

    def step(self, seconds: float) -> None:
        """Let simulation time pass."""
        answer = self.call("/step_simulation", steps=round(seconds / TIMESTEP))
        if answer["result"]["result"] != DONE:
            raise SystemExit(f"/step_simulation: {answer['result']['error_message']}")


def velocity(odometry: dict) -> list[float]:
    """Velocity towards the goal with the axes of the vehicle, 3 numbers [m/s]."""
    pose = odometry["pose"]["pose"]
    p, q = pose["position"], pose["orientation"]
    here = (p["x"], p["y"], p["z"])
    away = [KP * (wanted - is_at) for wanted, is_at in zip(GOAL, here, strict=True)]
    axis = [q["x"], q["y"], q["z"]]
    turn = cross(axis, away)  # away, turned back by the attitude
    return [
        v - 2.0 * q["w"] * t + 2.0 * u
        for v, t, u in zip(away, turn, cross(axis, turn), strict=True)
    ]


def cross(a: list[float], b: list[float]) -> list[float]:
    """The cross product."""
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--uri", default="ws://127.0.0.1:9090")
    parser.add_argument("--delay", type=float, default=0.0, help="longest pause in a loop [ms]")
    options = parser.parse_args()
    with connected(options.uri) as socket:
        simulation = Simulation(socket)
        simulation.send(op="subscribe", topic="/g500/odom")
        simulation.send(op="advertise", topic="/g500/twist", type="geometry_msgs/TwistStamped")
        simulation.step(PERIOD)
        simulation.call("/startBench")
        while True:
            if "/g500/odom" not in simulation.newest:
                raise SystemExit("No odometry comes on /g500/odom.")
            x, y, z = velocity(simulation.newest["/g500/odom"])
            time.sleep(options.delay / 1000.0 * random.random())
            twist = {"linear": {"x": x, "y": y, "z": z}}
            simulation.send(op="publish", topic="/g500/twist", msg={"twist": twist})
            simulation.step(PERIOD)
    print("The simulation has ended.")


if __name__ == "__main__":
    main()
