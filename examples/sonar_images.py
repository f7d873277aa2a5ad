"""Draw the sonar images of docs/sonar.md again, from the scene on that page.

    python examples/sonar_images.py docs/images

sonar-fan.png: the image of the wreck by the imaging sonar. sonar-waterfall.png: the side-scan along
a straight track past the wreck.
"""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image

import uwsim
from uwsim.messages import Point, Pose, pixels_of
from uwsim.simulation import Simulation

PAGE = Path(__file__).parent.parent / "docs" / "sonar.md"
SCENE = re.compile(r"^`wreck-sonar.xml`:\n\n```xml\n(.*?)^```", re.MULTILINE | re.DOTALL)
TRACK = (-6.0, -1.5, -10.5)  # start of the side-scan track, in L [m]
SPEED, SECONDS, STEP = 0.5, 32.0, 0.1  # along x [m/s], of the track [s], between poses [s]


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the sonar images of the documentation.")
    parser.add_argument("folder", type=Path)
    folder: Path = parser.parse_args().folder
    scene_match = SCENE.search(PAGE.read_text())
    assert scene_match is not None
    with TemporaryDirectory() as scratch:
        scene = Path(scratch) / "wreck-sonar.xml"
        scene.write_text(scene_match[1])
        with uwsim.load(scene, seed=1, is_blind=True) as simulation:
            save(next_image(simulation, "/rov/fls_image"), folder / "sonar-fan.png")
            save(record_waterfall(simulation), folder / "sonar-waterfall.png")


def next_image(simulation: Simulation, topic: str) -> np.ndarray:
    """Return the next image on a topic."""
    simulation.latest_message(topic)
    simulation.advance(0.2)
    pixels: np.ndarray = pixels_of(simulation.latest_message(topic))
    return pixels


def record_waterfall(simulation: Simulation) -> np.ndarray:
    """Return the waterfall image after the track."""
    x, y, z = TRACK
    for n in range(round(SECONDS / STEP)):
        position = Point(x=x + SPEED * STEP * n, y=y, z=z)
        simulation.publish("/rov/pose", Pose(position=position))
        simulation.advance(STEP)
    return next_image(simulation, "/rov/waterfall")


def save(pixels: np.ndarray, path: Path) -> None:
    """Write an optimised grey PNG."""
    Image.fromarray(pixels).save(path, optimize=True)


if __name__ == "__main__":
    main()
