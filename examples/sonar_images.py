"""Draw the sonar images of docs/sonar.md again, from the scene on that page.

    python examples/sonar_images.py docs/images

sonar-fan.png: the wreck as the imaging sonar sees it. sonar-waterfall.png: the side-scan along a
straight track past it.
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
TRACK = (-6.0, -1.5, -10.5)  # where the track of the side-scan begins, in L [m]
SPEED, SECONDS, STEP = 0.5, 32.0, 0.1  # along x [m/s], of the track [s], between poses [s]


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the sonar images of the documentation.")
    parser.add_argument("folder", type=Path)
    folder: Path = parser.parse_args().folder
    found = SCENE.search(PAGE.read_text())
    assert found is not None
    with TemporaryDirectory() as scratch:
        scene = Path(scratch) / "wreck-sonar.xml"
        scene.write_text(found[1])
        with uwsim.load(scene, seed=1, is_blind=True) as simulation:
            save(newest(simulation, "/rov/fls_image"), folder / "sonar-fan.png")
            save(waterfall(simulation), folder / "sonar-waterfall.png")


def newest(simulation: Simulation, topic: str) -> np.ndarray:
    """The next image on a topic."""
    simulation.latest_message(topic)
    simulation.advance(0.2)
    pixels: np.ndarray = pixels_of(simulation.latest_message(topic))
    return pixels


def waterfall(simulation: Simulation) -> np.ndarray:
    """The waterfall after the track."""
    x, y, z = TRACK
    for n in range(round(SECONDS / STEP)):
        place = Point(x=x + SPEED * STEP * n, y=y, z=z)
        simulation.publish("/rov/pose", Pose(position=place))
        simulation.advance(STEP)
    return newest(simulation, "/rov/waterfall")


def save(pixels: np.ndarray, path: Path) -> None:
    """Write an optimised grey PNG."""
    Image.fromarray(pixels).save(path, optimize=True)


if __name__ == "__main__":
    main()
