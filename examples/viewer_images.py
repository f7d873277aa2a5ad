"""Draw the moving image of README.md and the image of the page of docs/replay.md again.

    python examples/viewer_images.py docs/images               two minutes; `--only film|replay`

film.webp: a film of ``visibility-moving`` at some fogs, tracked by ESM. replay.webp: the page with
a level of ``currents``, in Chromium; it needs playwright and Debian's chromium.
"""

from __future__ import annotations

import argparse
import io
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image

from uwsim.cli import main as uwsim

FOGS = (0.0, 0.3, 0.6, 0.9, 1.2)  # of the film [1/m]
FILM = ("--size", "480x360", "--fps", "8", "--speed", "2.5", "--smooth", "--curve", "corners")
CHROMIUM = "/usr/bin/chromium"
GRAPHICS = ("--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist")
WINDOW, MOMENT = (1200, 750), 60.0  # of the page [px], simulation time [s]
PAGE_IS_LOADED = "window.uwsim !== undefined"


def main() -> None:
    parser = argparse.ArgumentParser(description="Draw the images of films and replays.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", choices=("film", "replay"))
    options = parser.parse_args()
    for name, draw in {"film": draw_film, "replay": draw_replay}.items():
        if options.only in (None, name):
            with TemporaryDirectory() as scratch:
                draw(options.folder / f"{name}.webp", Path(scratch))


def draw_film(path: Path, scratch: Path) -> None:
    """Run the levels of the film, and draw the film."""
    levels = [word for fog in FOGS for word in ("--level", f"fog={fog}")]
    result = str(scratch / "visibility-moving.result")
    run("bench", "visibility-moving", "--seed", "1", *levels, "--out", result)
    run("replay", result, "-o", str(path), "--overwrite", *FILM)


def draw_replay(path: Path, scratch: Path) -> None:
    """Run a level, open its replay, and save a screenshot."""
    from playwright.sync_api import sync_playwright

    result, page = scratch / "currents.result", scratch / "replay.html"
    level = ("--level", "current=0.1")
    run("bench", "currents", "--algorithm", "pi", "--seed", "7", *level, "--out", str(result))
    run("replay", str(result), "-o", str(page))
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*GRAPHICS])
        width, height = WINDOW
        tab = browser.new_page(viewport={"width": width, "height": height}, bypass_csp=True)
        tab.goto(page.as_uri())
        tab.wait_for_function(PAGE_IS_LOADED)
        tab.evaluate("time => uwsim.seek(time)", MOMENT)
        tab.wait_for_timeout(1000)
        image = tab.screenshot()
        browser.close()
    Image.open(io.BytesIO(image)).convert("RGB").save(path, quality=88, method=6)


def run(*words: str) -> None:
    """Run a command of uwsim; exit if it fails."""
    if (status := uwsim([*words])) != 0:
        raise SystemExit(status)


if __name__ == "__main__":
    main()
