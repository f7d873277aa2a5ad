"""The live view under load: two viewers who want a camera's images, and a key that is pressed.

`currents-scene` (a simulated vehicle) says how well real time is kept, and how often rows come.
`cirs` (a kinematic vehicle, which at rest does not move at all) says how long it takes from a key
to the first change of the vehicle's pose. Both have a camera of 640x480 whose images are drawn for
the viewers 10 times a second.

Viewers are of two kinds. A *receiver* reads and decodes all that a page does, and draws nothing:
what is measured is uwsim's own. A *page* is one in Chromium; without a GPU it draws on the same
cores, which the simulation then has to share. On a page, the vehicle counts as moved at the first
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
from measure import kept, main, reached
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

CAMERA = "bowtech1"
PACED, PILOTED = "currents-scene", "cirs"
SIZE = [f"vehicle[girona500].virtualCamera[{CAMERA}].{edge}" for edge in ("resw=640", "resh=480")]
BODY = "girona500/base_link"
WARM_UP, LASTS = 4.0, 15.0  # [s]
N_KEYS = 30
HELD, REST = 0.4, 1.0  # [s]
MOVED = 1e-5  # [m]
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
    const m = page.player.moment(page.time).poses.get(body);
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
    """Reads and decodes what a page does: rows and images."""

    def __init__(self, url: str, stack: ExitStack) -> None:
        address = url.replace("http://", "ws://").replace("/?", "/socket?")
        opened = connect(address, max_size=None, compression=None, open_timeout=LIMIT)
        self.socket = stack.enter_context(opened)
        self.rows: list[tuple[float, float, np.ndarray]] = []
        """Wall time of arrival [s], simulation time [s], numbers."""
        self.n_images = 0
        """Images that were decoded."""
        self.first = 0
        """Column of the vehicle's position in a row."""
        self.socket.send(json.dumps({"type": "images", "cameras": [CAMERA], "rate": 10}))
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        try:
            for data in self.socket:
                if isinstance(data, bytes):
                    self._take(data)
        except ConnectionClosed:
            return

    def _take(self, data: bytes) -> None:
        if data[0] == KIND["head"]:
            content = gzip.decompress(data[16:])
            (length,) = struct.unpack_from("<I", content)
            motion = json.loads(content[4 : 4 + length])["motion"]
            self.first = 7 * motion["bodies"].index(BODY)
        elif data[0] == KIND["row"]:
            (now,) = struct.unpack_from("<d", data, 8)
            numbers = np.frombuffer(data, "<f4", offset=16)
            self.rows.append((time.perf_counter(), now, numbers))
        elif data[0] == KIND["image"]:
            cv2.imdecode(np.frombuffer(data, np.uint8, offset=16), cv2.IMREAD_COLOR)
            self.n_images += 1

    def place(self) -> np.ndarray:
        """Where the vehicle was last, (3,) [m]."""
        return self.rows[-1][2][self.first : self.first + 3]

    def hold(self, *keys: str) -> None:
        """Tell that these keys are held."""
        said = {"type": "input", "keys": keys, "axes": [], "buttons": [], "sticks": []}
        self.socket.send(json.dumps(said))

    def key_to_moved(self) -> float:
        """Press a key at rest until the vehicle moves [s]."""
        before, n = self.place(), len(self.rows)
        began = time.perf_counter()
        self.hold("w")
        while True:
            for arrived, _, numbers in self.rows[n:]:
                n += 1
                if np.abs(numbers[self.first : self.first + 3] - before).max() > MOVED:
                    time.sleep(HELD)
                    self.hold()
                    return arrived - began
            time.sleep(0.0002)


@contextmanager
def running(scene: str, *settings: str) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """A scene that runs in real time, and the address of its page."""
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
def receivers(url: str, n: int) -> Iterator[list[Receiver]]:
    """Receivers who have got rows for a while."""
    with ExitStack() as stack:
        found = [Receiver(url, stack) for _ in range(n)]
        while not all(each.rows for each in found):
            time.sleep(0.01)
        time.sleep(WARM_UP)
        yield found


def with_receivers() -> Figures:
    """Two receivers."""
    name = "live, 2 receivers"
    with running(PACED) as (process, url), receivers(url, 2) as looking:
        one = looking[0]
        first, n = one.rows[-1], one.n_images
        size = resident(process.pid)
        time.sleep(LASTS)
        last, n = one.rows[-1], one.n_images - n
        passed, rows = last[0] - first[0], [row for row in one.rows if first[0] < row[0] <= last[0]]
        figures = {
            f"{name}: real-time factor": reached((last[1] - first[1]) / passed, 0.99),
            f"{name}: rows a second": reached(len(rows) / passed, 30.0),
            f"{name}: images a second": round(n / passed, 1),
            "live, a stalled reader: MB": kept(stalled(url, process.pid, size), 1.0),
        }
    with running(PILOTED, *SIZE) as (_, url), receivers(url, 2) as looking:
        waited = []
        for k in range(N_KEYS):
            time.sleep(REST + 0.0137 * k)  # at any moment between two rows and commands
            waited.append(looking[0].key_to_moved())
    return {**figures, **delays(f"{name}: key to moved vehicle", waited)}


def stalled(url: str, process: int, before: float) -> float:
    """Memory that a viewer costs who wants images and never reads [MB]."""
    address = url.replace("http://", "ws://").replace("/?", "/socket?")
    options: Any = {"max_size": None, "compression": None, "open_timeout": LIMIT, "max_queue": 1}
    with connect(address, ping_interval=None, **options) as socket:
        socket.send(json.dumps({"type": "images", "cameras": [CAMERA], "rate": 10}))
        time.sleep(LASTS)
        return max(0.0, resident(process) - before)


def resident(process: int) -> float:
    """Memory of a process [MB]."""
    words = Path(f"/proc/{process}/status").read_text().split()
    return float(words[words.index("VmRSS:") + 1]) / 1e3


def with_pages(browser: Any) -> Figures:
    """One page of Chromium, and two."""
    name = "live, 2 Chromium pages"
    with running(PACED) as (_, url):
        tab, _ = opened(browser, url), opened(browser, url)
        time.sleep(WARM_UP)
        now = "[performance.now() / 1000, window.uwsim.page.player.end]"
        tab.evaluate(COUNT)
        first = tab.evaluate(now)
        time.sleep(LASTS)
        last, n = tab.evaluate(now), tab.evaluate("window.n")
        passed = last[0] - first[0]
        figures: Figures = {
            f"{name}: real-time factor": reached((last[1] - first[1]) / passed, 0.99),
            f"{name}: rows a second": reached(n / passed, 30.0),
        }
        close(browser)
    for n in (1, 2):
        waited = keys_on_a_page(browser, n)
        pages = "page" if n == 1 else "pages"
        figures |= delays(f"live, {n} Chromium {pages}: key to moved vehicle", waited)
    return figures


def keys_on_a_page(browser: Any, n_pages: int) -> list[float]:
    """Press keys on the first of some pages until it shows the vehicle elsewhere [s]."""
    with running(PILOTED, *SIZE) as (_, url):
        tab, *_ = [opened(browser, url) for _ in range(n_pages)]
        tab.wait_for_function("window.uwsim.page.link.pilot.isOn")
        time.sleep(WARM_UP)
        tab.evaluate(WATCH, [BODY, MOVED])
        for k in range(N_KEYS):
            time.sleep(REST + 0.0137 * k)
            tab.keyboard.down("w")
            tab.wait_for_function(f"window.found.length === {k + 1}")
            time.sleep(HELD)
            tab.keyboard.up("w")
        waited = [delay / 1000.0 for delay in tab.evaluate("window.found")]
        close(browser)
    return waited


def opened(browser: Any, url: str) -> Any:
    """A page of its own window."""
    view: Any = {"width": 1024, "height": 768}
    tab = browser.new_context(viewport=view, bypass_csp=True).new_page()
    tab.set_default_timeout(1000.0 * LIMIT)
    tab.goto(url)
    tab.wait_for_function("window.uwsim !== undefined")
    return tab


def close(browser: Any) -> None:
    """Close all windows."""
    for context in browser.contexts:
        context.close()


def delays(name: str, waited: Sequence[float]) -> Figures:
    """Median and 95th percentile [ms]."""
    half, most = (1000.0 * float(np.percentile(waited, share)) for share in (50, 95))
    return {f"{name}, median: ms": round(half, 1), f"{name}, p95: ms": kept(most, 100.0)}


if __name__ == "__main__":
    main(with_receivers)
