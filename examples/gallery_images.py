"""Draw the pictures of docs/gallery.md and of its copies in README.md and docs/physical-water.md.

    python examples/gallery_images.py docs/images/gallery             three minutes
    python examples/gallery_images.py docs/images/gallery snell       or those whose names begin so

Each picture is the output of a command on that page, drawn twice as large and then reduced. The
four waters differ in the type of the water and in the exposure (`DAY`, `NIGHT`). The sand is
stirred up by a Girona 500 that climbs for 2.5 s.
"""

from __future__ import annotations

import argparse
import re
import shlex
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image, ImageDraw, ImageFont

import uwsim
from uwsim.cli import main as run_uwsim
from uwsim.messages import Twist, TwistStamped, Vector3
from uwsim.simulation.views import view_from

PAGE = Path(__file__).parent.parent / "docs" / "gallery.md"
COMMAND = re.compile(r"^\$ uwsim (render .* -o ([\w-]+)\.png.*)$", re.MULTILINE)
SIZE, PANEL_SIZE, SUPERSAMPLING = (960, 540), (640, 360), 2  # [px], [px], factor of each axis
JPEG_QUALITIES, MAX_FILE_SIZE = (88, 84, 80, 74), 200_000  # the best one that fits, [byte]
DAY = {"jerlov-I": 4.5, "jerlov-IB": 4.0, "jerlov-II": 2.0, "jerlov-1C": 3.2}
NIGHT = {"jerlov-I": 14.0, "jerlov-IB": 8.0, "jerlov-II": 4.5, "jerlov-1C": 4.5}
START = {"position.x": 4.0, "position.y": 9.0, "position.z": 13.3}  # of the climb, in L [m]
CLIMB, SECONDS, PERIOD = -0.35, 2.5, 0.1  # speed along z of the vehicle [m/s], [s], [s]
SAND_EXPOSURE = 3.3
EYE, TARGET = (7.6, 7.9, 12.8), (3.8, 8.9, 13.0)  # of the picture of sand, in L [m]


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the pictures of the gallery.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("name", nargs="?", default="", help="beginning of the pictures' names")
    options = parser.parse_args()
    folder: Path = options.folder
    folder.mkdir(parents=True, exist_ok=True)
    commands = {name: command for command, name in COMMAND.findall(PAGE.read_text())}
    pictures: dict[str, Callable[[], Image.Image]] = {
        name: lambda command=command: render(command, SIZE)  # type: ignore[misc]
        for name, command in commands.items()
    }
    pictures["waters-day"] = lambda: render_waters(commands["waters-day"], DAY)
    pictures["waters-night"] = lambda: render_waters(commands["waters-night"], NIGHT)
    pictures["sand"] = render_sand
    for name, draw in pictures.items():
        if name.startswith(options.name):
            save(draw(), folder / f"{name}.jpg")


def render(command: str, size: tuple[int, int], **changes: str) -> Image.Image:
    """Run a command of the page with more pixels, and with other values of ``--set`` paths."""
    words = shlex.split(command)
    for path, value in changes.items():
        words += ["--set", f"oceanState.water.{path}={value}"]
    with TemporaryDirectory() as scratch:
        file = Path(scratch) / "picture.png"
        words[words.index("-o") + 1] = str(file)
        words += ["--size", "x".join(str(SUPERSAMPLING * n) for n in size)]
        if run_uwsim(words) != 0:
            raise SystemExit(command)
        return Image.open(file).convert("RGB").resize(size, Image.Resampling.LANCZOS)


def render_waters(command: str, exposures: dict[str, float]) -> Image.Image:
    """Render a command in several waters, two in a row, with their names."""
    width, height = PANEL_SIZE
    n_rows = -(-len(exposures) // 2)
    canvas = Image.new("RGB", (2 * width, n_rows * height))
    font = ImageFont.load_default(size=20)
    for i, (water, exposure) in enumerate(exposures.items()):
        image = render(command, PANEL_SIZE, type=water, exposure=str(exposure))
        ImageDraw.Draw(image).text(
            (10, 6), f"Jerlov {water.removeprefix('jerlov-')}", "white", font
        )
        canvas.paste(image, ((i % 2) * width, (i // 2) * height))
    return canvas


def render_sand() -> Image.Image:
    """Let the vehicle climb from near the floor, and render the sand that its jets stir up."""
    settings = {f"vehicle[g500].{path}": value for path, value in START.items()}
    settings["oceanState.water.exposure"] = SAND_EXPOSURE
    climb = TwistStamped(twist=Twist(linear=Vector3(0.0, 0.0, CLIMB), angular=Vector3(0, 0, 0)))
    with uwsim.load("wreck-physical-scene", settings=settings) as simulation:
        for _ in range(round(SECONDS / PERIOD)):
            simulation.publish("/g500/twist", climb)
            simulation.advance(PERIOD)
        size = (SUPERSAMPLING * SIZE[0], SUPERSAMPLING * SIZE[1])
        view = view_from(simulation, np.array(EYE), np.array(TARGET), size)
        scenery = simulation.world.scenery
        colour = scenery.render_view(view.world_from_camera, view.intrinsics).colour
    assert colour is not None
    image = Image.fromarray(colour.astype(np.uint8)[..., :3])
    return image.resize(SIZE, Image.Resampling.LANCZOS)


def save(image: Image.Image, path: Path) -> None:
    """Write a JPEG file of at most `MAX_FILE_SIZE`."""
    for quality in JPEG_QUALITIES:
        image.save(path, quality=quality, optimize=True)
        if path.stat().st_size <= MAX_FILE_SIZE:
            return
    raise SystemExit(f"{path} is larger than {MAX_FILE_SIZE} bytes")


if __name__ == "__main__":
    main()
