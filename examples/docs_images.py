"""Draw the images of README.md and docs/ again.

    python examples/docs_images.py docs/images                          about a minute
    python examples/docs_images.py docs/images --trackers DIR           also the comparison of
                                     trackers, from the directory that this command writes

    uwsim bench visibility-moving --algorithm esm --algorithm frozen --algorithm ecc --algorithm ic
        --algorithm orb --algorithm ssd-esm --seed 1 --repeat 6 --workers 2 --out DIR

tank.png: the scene of ``visibility-moving`` in slightly turbid water, and its camera image at
three fogs, with the truth and the tracker's estimate. wreck.png, wreck-offset.png: output of the
commands of docs/first-benchmark.md. trackers.png: the score over fog.
"""

from __future__ import annotations

import argparse
import math
import os
import re
import shlex
import shutil
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from uwsim.analysis.plots import compare_plot, save_plot
from uwsim.analysis.report.overlay import overlay
from uwsim.api import load as load_scene
from uwsim.assets.find import find
from uwsim.cli import main as uwsim
from uwsim.results.result import Result
from uwsim.results.result_file import load
from uwsim.simulation.views import view_from

PAGE = Path(__file__).parent.parent / "docs" / "first-benchmark.md"
FILE = re.compile(r"^`([\w.-]+)`:\n\n```\w+\n(.*?)^```", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"^\$ uwsim (.*)$", re.MULTILINE)
SCENE, BENCHMARK, SEED = "visibility-moving-scene.xml", "visibility-moving", 1
EYE, TARGET = (4.3, 1.55, 2.15), (2.05, 0.15, 3.45)  # of the view, in L [m]
HAZE = 0.05  # fog of the view [1/m]
FOGS = (0.0, 0.6, 1.2)  # of the camera images [1/m]
SIZE, CAMERA_IMAGE_SIZE, GAP = (960, 500), (316, 237), 6  # view, camera images, gap [px]
SUPERSAMPLING = 2  # of the view, images per axis


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the images of the documentation.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--trackers", type=Path, metavar="DIR", help="folder with several results")
    options = parser.parse_args()
    folder: Path = options.folder
    folder.mkdir(parents=True, exist_ok=True)
    save(stack_images(render_view(), run_levels()), folder / "tank.png")
    run_tutorial(folder)
    if options.trackers is not None:
        results = [load(path.parent) for path in sorted(options.trackers.glob("*/result.json"))]
        save_plot(compare_plot(results, "total"), folder / "trackers.png")


def render_view() -> Image.Image:
    """Render the tank, the vehicle and the box from a point beside the vehicle's bow."""
    path = find(SCENE)
    assert path is not None
    simulation = load_scene(path, seed=SEED)
    try:
        width, height = SIZE
        eye, target = np.array(EYE), np.array(TARGET)
        view = view_from(simulation, eye, target, (SUPERSAMPLING * width, SUPERSAMPLING * height))
        colour = simulation.world.scenery.render_view(
            view.world_from_camera, view.intrinsics, fog=HAZE
        ).colour
    finally:
        simulation.close()
    assert colour is not None
    return Image.fromarray(colour.astype(np.uint8)[..., :3]).resize(SIZE, Image.Resampling.LANCZOS)


def run_levels() -> list[Image.Image]:
    """Run a level at each fog; return the last camera images with truth and ESM's estimate."""
    levels = [word for fog in FOGS for word in ("--level", f"fog={fog}")]
    with TemporaryDirectory() as folder:
        out = Path(folder) / "esm.result"
        status = uwsim(["bench", BENCHMARK, "--seed", str(SEED), *levels, "--out", str(out)])
        if status != 0:
            raise SystemExit(status)
        result = load(out)
        return [draw_overlay(result, out, fog) for fog in FOGS]


def draw_overlay(result: Result, directory: Path, fog: float) -> Image.Image:
    """Draw a camera image with its quadrangles and its fog."""
    row = next(i for i, level in enumerate(result.numbers("fog")) if math.isclose(level or 0, fog))
    result_image = next(stored_image for stored_image in result.images if stored_image.row == row)
    pixels = np.asarray(Image.open(directory / result_image.file).convert("RGB"))
    overlaid_pixels = overlay(
        pixels, truth=result_image.truth, estimate=result_image.estimate, scale=3
    )
    image = Image.fromarray(overlaid_pixels).resize(CAMERA_IMAGE_SIZE, Image.Resampling.LANCZOS)
    font = ImageFont.load_default(size=17)
    text = f"fog {fog:g} 1/m"
    ImageDraw.Draw(image).text((8, 5), text, "white", font, stroke_width=2, stroke_fill="#0a141e")
    return image


def stack_images(top: Image.Image, bottom_row: Sequence[Image.Image]) -> Image.Image:
    """Place a wide image above a row of small images."""
    canvas = Image.new("RGB", (SIZE[0], SIZE[1] + GAP + CAMERA_IMAGE_SIZE[1]), "white")
    canvas.paste(top, (0, 0))
    for i, image in enumerate(bottom_row):
        canvas.paste(image, (i * (CAMERA_IMAGE_SIZE[0] + GAP), SIZE[1] + GAP))
    return canvas


def run_tutorial(folder: Path) -> None:
    """Write the files of the page, run its commands, and copy two of their images."""
    page = PAGE.read_text()
    working_directory = Path.cwd()
    with TemporaryDirectory() as scratch:
        for name, text in FILE.findall(page):
            (Path(scratch) / name).write_text(text)
        os.chdir(scratch)
        try:
            for words in map(shlex.split, COMMAND.findall(page)):
                if words[0] in ("render", "bench") and uwsim(words) != 0:
                    raise SystemExit(words)
        finally:
            os.chdir(working_directory)
        save(Image.open(Path(scratch) / "wreck.png"), folder / "wreck.png")
        shutil.copy(Path(scratch) / "hover.result/plots/offset.png", folder / "wreck-offset.png")


def save(image: Image.Image, path: Path) -> None:
    """Write an optimised true-colour PNG."""
    image.save(path, optimize=True)


if __name__ == "__main__":
    main()
