"""Draw the paths of the vehicles in the tasks of docs/tasks-multi.md, from above.

    python examples/team_tasks_figure.py docs/images/tasks-multi.png

Left: two vehicles meet. Right: a vehicle takes packets from one modem to another. Seed 0, in the
noise of the scene files and, for the relay, without a current. A dot is where a vehicle begins.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import uwsim
from uwsim.algorithms import load_algorithm
from uwsim.analysis.plots import PALETTE, save_plot, styled_figure
from uwsim.messages import UInt8MultiArray

PERIOD = 1.0
"""The time between two points of a path [s]."""


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the paths of the tasks of several vehicles.")
    parser.add_argument("file", type=Path)
    options = parser.parse_args()
    pursuit = record_paths("rendezvous-scene", "rendezvous-pursuit", ("first", "second"), 75.0)
    relay = record_paths("relay-scene", "relay-shuttle", ("relay", "sender", "receiver"), 150.0)
    with styled_figure() as figure:
        left, right = figure.subplots(1, 2)
        for axes, paths, title in (
            (left, pursuit, "rendezvous-pursuit"),
            (right, relay, "relay-shuttle"),
        ):
            for (name, path), colour in zip(paths.items(), PALETTE, strict=False):
                axes.plot(path[:, 1], path[:, 0], color=colour, label=name)
                axes.plot(path[0, 1], path[0, 0], "o", color=colour)
            axes.set_title(title)
            axes.set_xlabel("east [m]")
            axes.set_ylabel("north [m]")
            axes.set_aspect("equal", adjustable="datalim")
            axes.legend(loc="upper right", fontsize=7)
        save_plot(figure, options.file)


def record_paths(
    scene: str, algorithm: str, vehicles: tuple[str, ...], duration: float
) -> dict[str, np.ndarray]:
    """Run an algorithm in a scene; return the path of each vehicle, north and east, (n, 2) [m]."""
    points: dict[str, list[tuple[float, float]]] = {name: [] for name in vehicles}
    with uwsim.load(scene, seed=0, timestep=0.01) as simulation:
        simulation.attach(load_algorithm(algorithm)())
        for second in range(round(duration / PERIOD)):
            if "sender" in vehicles and second % 4 == 0 and second < 48:
                data = np.full(24, second, np.uint8)
                simulation.publish("/sender_modem/tx", UInt8MultiArray(data=data))
            for name in vehicles:
                north, east, _ = simulation.pose(name).position.tolist()
                points[name].append((north, east))
            simulation.advance(PERIOD)
    return {name: np.array(path) for name, path in points.items()}


if __name__ == "__main__":
    main()
