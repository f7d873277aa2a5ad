"""Draw dredging.png of docs/sensors.md again: a buried amphora, and after a dredge has been around.

python examples/dredging_image.py docs/images/dredging.png
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import numpy as np
from PIL import Image

import uwsim
from uwsim.simulation import Simulation
from uwsim.simulation.views import view_from

SCENE, VEHICLE = "dredging-scene", "g500"
EYE, AT = (1.1, 0.9, 12.8), (0.25, -0.05, 13.75)  # of the view, in L [m]
SIZE, GAP, FINER = (480, 360), 6, 2  # of each half, between them [px], supersampling factor
ROUNDS, REACH = 40, 0.3  # of the tool around the amphora, and how far from its middle [m]


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the image of the dredge.")
    parser.add_argument("path", type=Path)
    asked = parser.parse_args()
    with uwsim.load(SCENE) as simulation:
        before = seen(simulation)
        (heap,) = simulation.world.scenery.heaps
        middle = heap.corner[:2] + 0.5 * heap.cell * np.array(heap.heights.shape)
        for turn in np.linspace(0.0, 2.0 * math.pi * ROUNDS, 12 * ROUNDS, endpoint=False):
            reach = REACH * (0.5 + 0.5 * math.sin(0.37 * turn))
            x, y = middle + reach * np.array([math.cos(turn), math.sin(turn)])
            heap.dig(np.array([x, y, heap.height(x, y) + 0.02]))
        after = seen(simulation)
    width, height = SIZE
    whole = Image.new("RGB", (2 * width + GAP, height), "white")
    whole.paste(before, (0, 0))
    whole.paste(after, (width + GAP, 0))
    whole.save(asked.path, optimize=True)


def seen(simulation: Simulation) -> Image.Image:
    """The heap of sand from the side, without the vehicle above it."""
    width, height = SIZE
    view = view_from(simulation, np.array(EYE), np.array(AT), (FINER * width, FINER * height))
    scenery = simulation.world.scenery
    colour = scenery.render_view(view.world_from_camera, view.intrinsics, fog=0.0).colour
    assert colour is not None
    return Image.fromarray(colour.view(np.uint8)).resize(SIZE, Image.Resampling.LANCZOS)


if __name__ == "__main__":
    main()
