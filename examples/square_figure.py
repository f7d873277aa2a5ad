"""Draws docs/images/square-tracks.png: three controllers on a square, in a current and in waves.

uwsim bench square --algorithm position-pi --out pi.result
uwsim bench square --algorithm mpc --out mpc.result
uwsim bench square --algorithm dob-mpc --out dob.result
python examples/square_figure.py pi.result mpc.result dob.result docs/images/square-tracks.png
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from uwsim.benchmark.reference_trajectory import TrajectorySpec

SQUARE = TrajectorySpec(shape="square", centre=(-0.5, -0.5, 3.0), radius=0.5, period=26.6666667)
CONDITIONS = ((0.0, 0.0), (0.0, 0.2), (0.75, 0.2))
"""The significant wave heights [m] and currents [m/s]."""
LAP = 26.6666667
"""The time of a lap [s]."""
SETTLING_TIME = 10.0
"""The time before a level is measured [s]."""


def read_track(folder: Path, condition: tuple[float, float]) -> np.ndarray:
    """Return the places of a vehicle in the first lap of a level, (n, 2) [m]."""
    with (folder / "measure-offset.csv").open() as file:
        rows = [[float(cell) for cell in row] for row in list(csv.reader(file))[1:]]
    samples = np.array([row for row in rows if np.allclose(row[:2], condition)])
    times = samples[:, 2] - samples[0, 2]
    places = SQUARE.position(times + SETTLING_TIME) + samples[:, 4:7]
    return places[times <= LAP, :2]


def main(folders: list[Path], out: Path) -> None:
    """Draw a panel for each condition."""
    figure, panels = plt.subplots(
        1, 3, figsize=(9.0, 3.3), sharex=True, sharey=True, layout="constrained"
    )
    corners = SQUARE.position(np.arange(5) * LAP / 4.0)
    for axes, (height, current) in zip(panels, CONDITIONS, strict=True):
        axes.plot(corners[:, 0], corners[:, 1], "k--", linewidth=0.8, label="square")
        for folder in folders:
            name = json.loads((folder / "provenance.json").read_text())["algorithms"][0]
            places = read_track(folder, (height, current))
            axes.plot(places[:, 0], places[:, 1], linewidth=1.2, label=name)
        axes.set_title(f"current {current:g} m/s, waves {height:g} m", fontsize=9)
        axes.set_aspect("equal")
        axes.set_xlabel("x [m]")
    panels[0].set_ylabel("y [m]")
    panels[0].legend(fontsize=7, loc="center")
    figure.savefig(out, dpi=110)


if __name__ == "__main__":
    main([Path(name) for name in sys.argv[1:-1]], Path(sys.argv[-1]))
