"""Draw dredging.png of docs/sensors.md again: a buried amphora before and after dredging.

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
EYE, TARGET = (0.9, 0.62, 13.05), (0.28, -0.04, 13.72)  # of the view, in L [m]
SETTINGS = {"oceanState.water.type": "clear", "oceanState.water.exposure": "1.5"}
SIZE, GAP, SUPERSAMPLING = (480, 360), 6, 2  # of each half, between them [px], supersampling factor
ROUNDS, REACH = 40, 0.3  # of the tool around the amphora, and its largest distance [m]


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the image of the dredge.")
    parser.add_argument("path", type=Path)
    options = parser.parse_args()
    with uwsim.load(SCENE, settings=SETTINGS) as simulation:
        image_before = render_heap(simulation)
        (heap,) = simulation.world.scenery.heaps
        middle = heap.corner[:2] + 0.5 * heap.cell * np.array(heap.heights.shape)
        for angle in np.linspace(0.0, 2.0 * math.pi * ROUNDS, 12 * ROUNDS, endpoint=False):
            reach = REACH * (0.5 + 0.5 * math.sin(0.37 * angle))
            x, y = middle + reach * np.array([math.cos(angle), math.sin(angle)])
            heap.dig(np.array([x, y, heap.height(x, y) + 0.02]))
        image_after = render_heap(simulation)
    width, height = SIZE
    canvas = Image.new("RGB", (2 * width + GAP, height), "white")
    canvas.paste(image_before, (0, 0))
    canvas.paste(image_after, (width + GAP, 0))
    canvas.save(options.path, optimize=True)


def render_heap(simulation: Simulation) -> Image.Image:
    """Render the heap of sand from the side, without the vehicle above it."""
    width, height = SIZE
    view = view_from(
        simulation, np.array(EYE), np.array(TARGET), (SUPERSAMPLING * width, SUPERSAMPLING * height)
    )
    scenery = simulation.world.scenery
    colour = scenery.render_view(view.world_from_camera, view.intrinsics, fog=0.0).colour
    assert colour is not None
    return Image.fromarray(colour.view(np.uint8)).resize(SIZE, Image.Resampling.LANCZOS)


if __name__ == "__main__":
    main()
