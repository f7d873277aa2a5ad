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

from live_view import measure_pages, measure_receivers
from measure import main, upper_target_figure

LEVEL = "current=0.1"
LEVEL_DURATION = 118.0  # [s]
FILM_DURATION = 60.0  # [s]
FRAMES = 60
DRAW = """async ([n, isShown]) => {
  const { page } = window.uwsim;
  const gl = page.picture.canvas.getContext("webgl2"), pixel = new Uint8Array(4);
  let time = page.player.start + 5;
  for (let i = 0; i < n; i++) {
    page.time = time += 1 / 30;
    page.views.drag(0.002, 0, false);
    page.picture.draw(page.player, page.player.snapshot(time), page.views, page.switches);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    if (isShown) await new Promise((done) => requestAnimationFrame(done));
  }
}"""
SIZE = "#image, #overlay { width: 640px !important; height: 480px !important; position: absolute }"
FLAGS = ["--use-gl=angle", "--use-angle=gl-egl", "--ignore-gpu-blocklist", "--disable-gpu-watchdog"]


def measure() -> dict[str, object]:
    """Run the level, and measure its replay, film, recording and live view."""
    with TemporaryDirectory() as folder:
        result = Path(folder) / "a.result"
        run = run_command("bench", "currents", "--level", LEVEL, "--out", str(result))
        motion = sum(file.stat().st_size for file in result.glob("units/*.motion"))
        return {
            "run: cpu_s": round(run, 2),
            "motion: kB a simulated minute": upper_target_figure(
                motion / 1e3 / (LEVEL_DURATION / 60.0), 40.0
            ),
            **measure_files(Path(folder), result),
            **measure_receivers(),
            **measure_in_chromium(Path(folder) / "0.html"),
        }


def measure_files(folder: Path, result: Path) -> dict[str, object]:
    """Measure size and CPU time of replay (twice), MCAP and film."""
    replays = [folder / "0.html", folder / "1.html"]
    cpu_times = [run_command("replay", str(result), "-o", str(file)) for file in replays]
    mcap, film = folder / "a.mcap", folder / "a.mp4"
    run_command("replay", str(result), "--trial", "0", "-o", str(mcap))
    film_cpu_time = run_command(
        "replay", str(result), "--until", str(FILM_DURATION), "-o", str(film)
    )
    contents = [file.read_bytes() for file in replays]
    return {
        "replay: MB": upper_target_figure(len(contents[0]) / 1e6, 2.0),
        "replay: cpu_s": upper_target_figure(min(cpu_times), 5.0),
        "replay: same bytes twice": contents[0] == contents[1],
        "mcap: MB a simulated minute": upper_target_figure(
            mcap.stat().st_size / 1e6 / (LEVEL_DURATION / 60.0), 1.0
        ),
        "film of 60 s, 960x720, 30 Hz: cpu_s": upper_target_figure(film_cpu_time, 90.0),
        "film of 60 s, 960x720, 30 Hz: MB": upper_target_figure(film.stat().st_size / 1e6, 6.0),
    }


def measure_in_chromium(page: Path) -> dict[str, object]:
    """Measure the replay and the live view in Chromium, if it is installed."""
    chromium = shutil.which("chromium")
    if chromium is None or importlib.util.find_spec("playwright") is None:
        return {"page": "not measured: Chromium or playwright is not installed"}
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS, timeout=120_000)
        figures = {**measure_page(browser, page), **measure_pages(browser)}
        browser.close()
    return figures


def measure_page(browser: Any, page: Path) -> dict[str, object]:
    """Measure the replay without a network: requests, and CPU time of a frame [ms]."""
    view: Any = {"width": 1024, "height": 768}
    context = browser.new_context(viewport=view, offline=True, bypass_csp=True)
    tab = context.new_page()
    tab.set_default_timeout(200_000)
    requests: list[str] = []
    tab.on("request", lambda request: requests.append(request.url))
    tab.goto(page.as_uri())
    tab.wait_for_function("window.uwsim")
    tab.evaluate("window.uwsim.page.switches.pictures = false")
    tab.add_style_tag(content=SIZE)
    figures: dict[str, object] = {}
    for name, is_shown in (("drawn", False), ("drawn and shown", True)):
        tab.evaluate(DRAW, [10, is_shown])
        cpu_before = children_cpu_time()
        tab.evaluate(DRAW, [FRAMES, is_shown])
        cpu_ms = 1000.0 * (children_cpu_time() - cpu_before) / FRAMES
        figures[f"frame of 640x480, {name}: cpu_ms"] = upper_target_figure(cpu_ms, 40.0)
    context.close()
    network_requests = [url for url in requests if not url.startswith(("file:", "data:", "blob:"))]
    return {
        "page: requests to the network": upper_target_figure(float(len(network_requests)), 0.0),
        **figures,
    }


def run_command(*arguments: str) -> float:
    """Run a command of `uwsim`; return the CPU time of its processes [s]."""
    usage_before = resource.getrusage(resource.RUSAGE_CHILDREN)
    command = [sys.executable, "-m", "uwsim", *arguments]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    usage_after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (
        usage_after.ru_utime + usage_after.ru_stime - usage_before.ru_utime - usage_before.ru_stime
    )


def children_cpu_time() -> float:
    """Return the CPU time so far of all descendant processes [s]."""
    children: dict[int, list[tuple[int, int]]] = {}
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            numbers = (entry / "stat").read_text().rsplit(")", 1)[1].split()
        except OSError:  # the process has ended meanwhile
            continue
        cpu_ticks = int(numbers[11]) + int(numbers[12])
        children.setdefault(int(numbers[1]), []).append((int(entry.name), cpu_ticks))
    total, process_queue = 0, [os.getpid()]
    while process_queue:
        for process, cpu_ticks in children.get(process_queue.pop(), []):
            total += cpu_ticks
            process_queue.append(process)
    return total / os.sysconf("SC_CLK_TCK")


if __name__ == "__main__":
    main(measure)
