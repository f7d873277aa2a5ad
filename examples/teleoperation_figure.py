"""Draw the paths of operators over a link with a delay, from above (docs/tasks-multi.md).

    python examples/teleoperation_figure.py docs/images/teleoperation.png

Seed 0 and a delay of 1 s in each direction. The dot is where the vehicle begins, the cross is the
place to hold.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import uwsim
from uwsim.algorithms import load_algorithm
from uwsim.analysis.plots import PALETTE, save_plot, styled_figure

OPERATORS = ("operator-continuous", "operator-wait", "operator-predict")
WALLS = ((-1.5, 0.8), (2.0, -0.8))
"""The north coordinate of each wall and the east coordinate of the middle of its gate [m]."""
GATE_WIDTH, POOL_WIDTH = 1.3, 8.0
"""The widths of a gate and of the pool [m]."""
GOAL = (4.6, 0.0)
"""The place to hold, north and east [m]."""
DURATION, PERIOD = 70.0, 0.5
"""The duration of a path, and the time between two points of it [s]."""


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the paths of the task teleoperation.")
    parser.add_argument("file", type=Path)
    parser.add_argument("--delay", type=float, default=1.0, help="the delay in each direction [s]")
    options = parser.parse_args()
    with styled_figure() as figure:
        axes = figure.subplots()
        for north, gate in WALLS:
            for start, end in (
                (-POOL_WIDTH / 2, gate - GATE_WIDTH / 2),
                (gate + GATE_WIDTH / 2, POOL_WIDTH / 2),
            ):
                axes.plot([north, north], [start, end], color="black", linewidth=3)
        for name, colour in zip(OPERATORS, PALETTE, strict=False):
            path = record_path(name, options.delay)
            axes.plot(path[:, 0], path[:, 1], color=colour, label=name)
            axes.plot(path[0, 0], path[0, 1], "o", color=colour)
        axes.plot(*GOAL, "kx")
        axes.set_xlabel("north [m]")
        axes.set_ylabel("east [m]")
        axes.set_ylim(POOL_WIDTH / 2, -POOL_WIDTH / 2)  # as seen from above
        axes.set_aspect("equal", adjustable="box")
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=3, fontsize=7)
        save_plot(figure, options.file)


def record_path(algorithm: str, delay: float) -> np.ndarray:
    """Run an operator; return the path of the vehicle, north and east, (n, 2) [m]."""
    settings = {"vehicle[bluerov2].topicLink[operator].delay": delay}
    points = []
    with uwsim.load("teleoperation-scene", timestep=0.01, settings=settings) as simulation:
        simulation.attach(load_algorithm(algorithm)())
        for _ in range(round(DURATION / PERIOD)):
            points.append(simulation.pose("bluerov2").position[:2].copy())
            simulation.advance(PERIOD)
    return np.array(points)


if __name__ == "__main__":
    main()
