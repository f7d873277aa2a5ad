"""Replay, film and recording of a scored run: their sizes, and what they cost.

A level of `currents` (118 s) is run once in a temporary folder; then the command line writes its
replay, its film and its MCAP, each in a process of its own whose CPU time is taken. Where Chromium
and playwright are, the replay is opened offline and drawn at 640 x 480: requests to the network,
and CPU time of a frame, all of Chromium's processes together. Last the live view (`live_view`),
with receivers that draw nothing and with pages of Chromium. One JSON on stdout.
"""

from __future__ import annotations

import importlib.util
import os
import resource
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from live_view import with_pages, with_receivers
from measure import kept, main

LEVEL = "current=0.1"
LASTS = 118.0  # [s]
FILM = 60.0  # [s]
FRAMES = 60
DRAW = """async ([n, isShown]) => {
  const { page } = window.uwsim;
  const gl = page.picture.canvas.getContext("webgl2"), pixel = new Uint8Array(4);
  let time = page.player.start + 5;
  for (let i = 0; i < n; i++) {
    page.time = time += 1 / 30;
    page.views.drag(0.002, 0, false);
    page.picture.draw(page.player, page.player.moment(time), page.views, page.switches);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    if (isShown) await new Promise((done) => requestAnimationFrame(done));
  }
}"""
SIZE = "#image, #overlay { width: 640px !important; height: 480px !important; position: absolute }"
FLAGS = ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist", "--disable-gpu-watchdog"]


def measure() -> dict[str, object]:
    """Run the level, and make of it all that can be made."""
    with TemporaryDirectory() as folder:
        result = Path(folder) / "a.result"
        run = cpu_of("bench", "currents", "--level", LEVEL, "--out", str(result))
        motion = sum(file.stat().st_size for file in result.glob("units/*.motion"))
        return {
            "run: cpu_s": round(run, 2),
            "motion: kB a simulated minute": kept(motion / 1e3 / (LASTS / 60.0), 40.0),
            **files(Path(folder), result),
            **with_receivers(),
            **in_chromium(Path(folder) / "0.html"),
        }


def files(folder: Path, result: Path) -> dict[str, object]:
    """Replay (twice), MCAP and film: their sizes, and the CPU time of their processes."""
    replays = [folder / "0.html", folder / "1.html"]
    spent = [cpu_of("replay", str(result), "-o", str(file)) for file in replays]
    mcap, film = folder / "a.mcap", folder / "a.mp4"
    cpu_of("replay", str(result), "--trial", "0", "-o", str(mcap))
    filmed = cpu_of("replay", str(result), "--until", str(FILM), "-o", str(film))
    contents = [file.read_bytes() for file in replays]
    return {
        "replay: MB": kept(len(contents[0]) / 1e6, 2.0),
        "replay: cpu_s": kept(min(spent), 5.0),
        "replay: same bytes twice": contents[0] == contents[1],
        "mcap: MB a simulated minute": kept(mcap.stat().st_size / 1e6 / (LASTS / 60.0), 1.0),
        "film of 60 s, 960x720, 30 Hz: cpu_s": kept(filmed, 90.0),
        "film of 60 s, 960x720, 30 Hz: MB": kept(film.stat().st_size / 1e6, 6.0),
    }


def in_chromium(page: Path) -> dict[str, object]:
    """The replay and the live view in Chromium, where it is."""
    chromium = shutil.which("chromium")
    if chromium is None or importlib.util.find_spec("playwright") is None:
        return {"page": "not measured: Chromium or playwright is not installed"}
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS, timeout=120_000)
        found = {**drawn(browser, page), **with_pages(browser)}
        browser.close()
    return found


def drawn(browser: Any, page: Path) -> dict[str, object]:
    """The replay without a network: requests, and CPU time of a frame [ms]."""
    view: Any = {"width": 1024, "height": 768}
    context = browser.new_context(viewport=view, offline=True, bypass_csp=True)
    tab = context.new_page()
    tab.set_default_timeout(200_000)
    asked: list[str] = []
    tab.on("request", lambda request: asked.append(request.url))
    tab.goto(page.as_uri())
    tab.wait_for_function("window.uwsim")
    tab.evaluate("window.uwsim.page.switches.pictures = false")
    tab.add_style_tag(content=SIZE)
    found: dict[str, object] = {}
    for name, is_shown in (("drawn", False), ("drawn and shown", True)):
        tab.evaluate(DRAW, [10, is_shown])
        before = cpu_of_children()
        tab.evaluate(DRAW, [FRAMES, is_shown])
        cpu_ms = 1000.0 * (cpu_of_children() - before) / FRAMES
        found[f"frame of 640x480, {name}: cpu_ms"] = kept(cpu_ms, 40.0)
    context.close()
    outside = [url for url in asked if not url.startswith(("file:", "data:", "blob:"))]
    return {"page: requests to the network": kept(float(len(outside)), 0.0), **found}


def cpu_of(*arguments: str) -> float:
    """CPU time of a command of `uwsim` and its processes [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "uwsim", *arguments]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def cpu_of_children() -> float:
    """CPU time so far of the processes that this one has begun, and of theirs [s]."""
    children: dict[int, list[tuple[int, int]]] = {}
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            numbers = (entry / "stat").read_text().rsplit(")", 1)[1].split()
        except OSError:  # it has ended meanwhile
            continue
        spent = int(numbers[11]) + int(numbers[12])
        children.setdefault(int(numbers[1]), []).append((int(entry.name), spent))
    total, waiting = 0, [os.getpid()]
    while waiting:
        for process, spent in children.get(waiting.pop(), []):
            total += spent
            waiting.append(process)
    return total / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    main(measure)
