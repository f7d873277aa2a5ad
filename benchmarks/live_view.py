"""Measure the live view under load: two viewers of a camera's images, and pressed keys.

`currents-scene` (a simulated vehicle) gives the real-time factor and the rate of rows. `cirs` (a
kinematic vehicle, which is at rest without commands) gives the delay from a key to the first
change of the vehicle's pose. Both have a camera of 640x480 whose images are drawn for
the viewers 10 times a second.

Viewers are of two kinds. A *receiver* reads and decodes all messages like a page, and draws
nothing, which measures uwsim alone. A *page* runs in Chromium; without a GPU it draws on the cores
of the simulation. On a page, the vehicle counts as moved at the first
frame that begins after its new pose was drawn.

`viewer` measures both; as a command this file measures receivers alone.
"""

from __future__ import annotations

import gzip
import json
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from measure import lower_target_figure, main, upper_target_figure
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

CAMERA = "bowtech1"
REAL_TIME_SCENE, PILOTED_SCENE = "currents-scene", "cirs"
SIZE = [f"vehicle[girona500].virtualCamera[{CAMERA}].{edge}" for edge in ("resw=640", "resh=480")]
BODY = "girona500/base_link"
WARM_UP, DURATION = 4.0, 15.0  # [s]
N_KEYS = 30
HOLD_TIME, REST_TIME = 0.4, 1.0  # [s]
MIN_DISPLACEMENT = 1e-5  # [m]
LIMIT = 120.0  # [s]
KIND = {"head": 0, "row": 1, "image": 2}
COUNT = """() => {
  const { player } = window.uwsim.page, push = player.push.bind(player);
  window.n = 0;
  player.push = (...row) => { ++window.n; push(...row); };
}"""
WATCH = """([body, moved]) => {
  const { page } = window.uwsim, draw = page.draw.bind(page), found = [];
  const where = () => {
    const m = page.player.snapshot(page.time).poses.get(body);
    return [m[3], m[7], m[11]];
  };
  let pressed = null, place = where(); // also where the first key comes before the next drawing
  document.addEventListener("keydown", (event) => {
    if (event.key === "w" && !event.repeat) pressed = event.timeStamp;
  }, true);
  page.draw = () => {
    draw();
    const now = where(), far = Math.hypot(...now.map((value, i) => value - place[i])) > moved;
    if (pressed === null) place = now;
    else if (far) {
      const began = pressed;
      pressed = null;
      requestAnimationFrame(() => found.push(performance.now() - began));
    }
  };
  window.found = found;
}"""

Figures = dict[str, object]


class Receiver:
    """A viewer that reads and decodes rows and images, like a page."""

    def __init__(self, url: str, stack: ExitStack) -> None:
        address = url.replace("http://", "ws://").replace("/?", "/socket?")
        connection = connect(address, max_size=None, compression=None, open_timeout=LIMIT)
        self.socket = stack.enter_context(connection)
        self.rows: list[tuple[float, float, np.ndarray]] = []
        """The rows: wall time of arrival [s], simulation time [s], numbers."""
        self.n_images = 0
        """The number of decoded images."""
        self.position_column = 0
        """The column of the vehicle's position in a row."""
        self.socket.send(json.dumps({"type": "images", "cameras": [CAMERA], "rate": 10}))
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        try:
            for data in self.socket:
                if isinstance(data, bytes):
                    self._decode(data)
        except ConnectionClosed:
            return

    def _decode(self, data: bytes) -> None:
        if data[0] == KIND["head"]:
            content = gzip.decompress(data[16:])
            (length,) = struct.unpack_from("<I", content)
            motion = json.loads(content[4 : 4 + length])["motion"]
            self.position_column = 7 * motion["bodies"].index(BODY)
        elif data[0] == KIND["row"]:
            (now,) = struct.unpack_from("<d", data, 8)
            numbers = np.frombuffer(data, "<f4", offset=16)
            self.rows.append((time.perf_counter(), now, numbers))
        elif data[0] == KIND["image"]:
            cv2.imdecode(np.frombuffer(data, np.uint8, offset=16), cv2.IMREAD_COLOR)
            self.n_images += 1

    def last_position(self) -> np.ndarray:
        """Return the last position of the vehicle, (3,) [m]."""
        return self.rows[-1][2][self.position_column : self.position_column + 3]

    def hold(self, *keys: str) -> None:
        """Send the keys that are held."""
        message = {"type": "input", "keys": keys, "axes": [], "buttons": [], "sticks": []}
        self.socket.send(json.dumps(message))

    def measure_key_delay(self) -> float:
        """Press a key at rest; return the delay until the vehicle moves [s]."""
        start_position, n = self.last_position(), len(self.rows)
        start_time = time.perf_counter()
        self.hold("w")
        while True:
            for arrival_time, _, numbers in self.rows[n:]:
                n += 1
                if (
                    np.abs(
                        numbers[self.position_column : self.position_column + 3] - start_position
                    ).max()
                    > MIN_DISPLACEMENT
                ):
                    time.sleep(HOLD_TIME)
                    self.hold()
                    return arrival_time - start_time
            time.sleep(0.0002)


@contextmanager
def run_scene(scene: str, *settings: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """Run a scene in real time; yield its process and the address of its page."""
    command = [sys.executable, "-m", "uwsim", "run", scene, "--view"]
    command += [word for setting in settings for word in ("--set", setting)]
    pipes: Any = {"stderr": subprocess.PIPE, "stdout": subprocess.DEVNULL, "text": True}
    with subprocess.Popen(command, **pipes) as process:
        try:
            assert process.stderr is not None
            lines = (line for line in process.stderr if line.startswith("view: "))
            yield process, next(lines).split()[1]
        finally:
            process.terminate()


@contextmanager
def open_receivers(url: str, n: int) -> Iterator[list[Receiver]]:
    """Open receivers; yield them after a warm-up with rows."""
    with ExitStack() as stack:
        receivers = [Receiver(url, stack) for _ in range(n)]
        while not all(receiver.rows for receiver in receivers):
            time.sleep(0.01)
        time.sleep(WARM_UP)
        yield receivers


def measure_receivers() -> Figures:
    """Measure two receivers."""
    name = "live, 2 receivers"
    with run_scene(REAL_TIME_SCENE) as (process, url), open_receivers(url, 2) as receivers:
        receiver = receivers[0]
        first_row, n = receiver.rows[-1], receiver.n_images
        size = resident_memory(process.pid)
        time.sleep(DURATION)
        last_row, n = receiver.rows[-1], receiver.n_images - n
        wall_time, rows = (
            last_row[0] - first_row[0],
            [row for row in receiver.rows if first_row[0] < row[0] <= last_row[0]],
        )
        figures = {
            f"{name}: real-time factor": lower_target_figure(
                (last_row[1] - first_row[1]) / wall_time, 0.99
            ),
            f"{name}: rows a second": lower_target_figure(len(rows) / wall_time, 30.0),
            f"{name}: images a second": round(n / wall_time, 1),
            "live, a stalled reader: MB": upper_target_figure(
                stalled_reader_memory(url, process.pid, size), 1.0
            ),
        }
    with run_scene(PILOTED_SCENE, *SIZE) as (_, url), open_receivers(url, 2) as receivers:
        key_delays = []
        for k in range(N_KEYS):
            time.sleep(REST_TIME + 0.0137 * k)  # at any time between two rows and commands
            key_delays.append(receivers[0].measure_key_delay())
    return {**figures, **delay_figures(f"{name}: key to moved vehicle", key_delays)}


def stalled_reader_memory(url: str, process: int, memory_before: float) -> float:
    """Return the memory for a viewer of images that never reads [MB]."""
    address = url.replace("http://", "ws://").replace("/?", "/socket?")
    options: Any = {"max_size": None, "compression": None, "open_timeout": LIMIT, "max_queue": 1}
    with connect(address, ping_interval=None, **options) as socket:
        socket.send(json.dumps({"type": "images", "cameras": [CAMERA], "rate": 10}))
        time.sleep(DURATION)
        return max(0.0, resident_memory(process) - memory_before)


def resident_memory(process: int) -> float:
    """Return the resident memory of a process [MB]."""
    words = Path(f"/proc/{process}/status").read_text().split()
    return float(words[words.index("VmRSS:") + 1]) / 1e3


def measure_pages(browser: Any) -> Figures:
    """Measure one page of Chromium, and two."""
    name = "live, 2 Chromium pages"
    with run_scene(REAL_TIME_SCENE) as (_, url):
        tab, _ = open_page(browser, url), open_page(browser, url)
        time.sleep(WARM_UP)
        now = "[performance.now() / 1000, window.uwsim.page.player.end]"
        tab.evaluate(COUNT)
        first_times = tab.evaluate(now)
        time.sleep(DURATION)
        last_times, n = tab.evaluate(now), tab.evaluate("window.n")
        wall_time = last_times[0] - first_times[0]
        figures: Figures = {
            f"{name}: real-time factor": lower_target_figure(
                (last_times[1] - first_times[1]) / wall_time, 0.99
            ),
            f"{name}: rows a second": lower_target_figure(n / wall_time, 30.0),
        }
        close_pages(browser)
    for n in (1, 2):
        key_delays = measure_page_key_delays(browser, n)
        pages = "page" if n == 1 else "pages"
        figures |= delay_figures(f"live, {n} Chromium {pages}: key to moved vehicle", key_delays)
    return figures


def measure_page_key_delays(browser: Any, n_pages: int) -> list[float]:
    """Press keys on the first page; return the delays until it shows a moved vehicle [s]."""
    with run_scene(PILOTED_SCENE, *SIZE) as (_, url):
        tab, *_ = [open_page(browser, url) for _ in range(n_pages)]
        tab.wait_for_function("window.uwsim.page.link.pilot.isOn")
        time.sleep(WARM_UP)
        tab.evaluate(WATCH, [BODY, MIN_DISPLACEMENT])
        for k in range(N_KEYS):
            time.sleep(REST_TIME + 0.0137 * k)
            tab.keyboard.down("w")
            tab.wait_for_function(f"window.found.length === {k + 1}")
            time.sleep(HOLD_TIME)
            tab.keyboard.up("w")
        key_delays = [delay / 1000.0 for delay in tab.evaluate("window.found")]
        close_pages(browser)
    return key_delays


def open_page(browser: Any, url: str) -> Any:
    """Open a page in a new window."""
    view: Any = {"width": 1024, "height": 768}
    tab = browser.new_context(viewport=view, bypass_csp=True).new_page()
    tab.set_default_timeout(1000.0 * LIMIT)
    tab.goto(url)
    tab.wait_for_function("window.uwsim !== undefined")
    return tab


def close_pages(browser: Any) -> None:
    """Close all windows."""
    for context in browser.contexts:
        context.close()


def delay_figures(name: str, delays: Sequence[float]) -> Figures:
    """Return median and 95th percentile of delays [ms]."""
    median_ms, p95_ms = (1000.0 * float(np.percentile(delays, share)) for share in (50, 95))
    return {
        f"{name}, median: ms": round(median_ms, 1),
        f"{name}, p95: ms": upper_target_figure(p95_ms, 100.0),
    }


if __name__ == "__main__":
    main(measure_receivers)
