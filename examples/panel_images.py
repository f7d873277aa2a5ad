"""Draw the jaw at work in the tasks of docs/tasks-valve.md: a valve is turned, a plug is inserted.

python examples/panel_images.py docs/images
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np
from PIL import Image

import uwsim
from uwsim.algorithms import load_algorithm
from uwsim.simulation.views import view_from

SIZE, SUPERSAMPLING = (640, 360), 2  # of the images [px], factor of each axis
SEED, TIMESTEP, PERIOD, LIMIT = 1, 0.005, 0.5, 80.0  # step, time between two looks, limit [s]
HALF_TURN = 0.8  # the angle of the valve in the image [rad]
DEPTH = 0.03  # the depth of the tip of the plug below the mouth in the image [m]
MOUTH_DEPTH, PLUG_LENGTH = 4.59, 0.12  # of the socket, in L; of the plug [m]
VALVE_EYE, VALVE_TARGET = (0.75, 1.05, 4.25), (-0.25, 0.2, 4.6)  # of the view, in L [m]
PLUG_EYE, PLUG_TARGET = (0.7, 0.95, 4.25), (-0.3, 0.1, 4.6)  # of the view, in L [m]


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the jaw at work on a panel.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("task", nargs="*", default=["valve", "plug"])
    folder: Path = (options := parser.parse_args()).folder
    if "valve" in options.task:
        image = image_when("valve", is_valve_turned, VALVE_EYE, VALVE_TARGET)
        image.save(folder / "valve-turn.jpg", quality=88, optimize=True)
    if "plug" in options.task:
        image = image_when("plug", is_plug_inserted, PLUG_EYE, PLUG_TARGET)
        image.save(folder / "plug-insert.jpg", quality=88, optimize=True)


def is_valve_turned(simulation: uwsim.Simulation) -> bool:
    """Return whether the first valve has turned by `HALF_TURN` since it was like the second."""
    first, second = simulation.pose("valve1").rotation, simulation.pose("valve2").rotation
    return bool(np.trace(first.T @ second) < 1.0 + 2.0 * np.cos(HALF_TURN))


def is_plug_inserted(simulation: uwsim.Simulation) -> bool:
    """Return whether the tip of the plug is `DEPTH` below the mouth of the socket."""
    tip = simulation.pose("girona500/plug").transform(np.array([[0.0, 0.0, PLUG_LENGTH]]))[0]
    return bool(tip[2] > MOUTH_DEPTH + DEPTH)


def image_when(
    task: str,
    condition: Callable[[uwsim.Simulation], bool],
    eye: tuple[float, float, float],
    target: tuple[float, float, float],
) -> Image.Image:
    """Run the expert of a task until a condition holds, and draw the scene."""
    with uwsim.load(f"{task}-scene", seed=SEED, timestep=TIMESTEP) as simulation:
        simulation.attach(load_algorithm(f"{task}-truth")())
        while not condition(simulation):
            simulation.advance(PERIOD)
            if simulation.time > LIMIT:
                raise SystemExit(f"{task} was not done in {LIMIT:g} s")
        width, height = SIZE
        size = (SUPERSAMPLING * width, SUPERSAMPLING * height)
        view = view_from(simulation, np.array(eye), np.array(target), size)
        colour = simulation.world.scenery.render_view(
            view.world_from_camera, view.intrinsics, fog=0.0
        ).colour
    assert colour is not None
    pixels = colour.astype(np.uint8)[..., :3]
    return Image.fromarray(pixels).resize(SIZE, Image.Resampling.LANCZOS)


if __name__ == "__main__":
    main()
