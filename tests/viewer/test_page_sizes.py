"""Nothing of the page is cut off, whatever its size, and whatever things are called."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from uwsim.viewer.document import document
from uwsim.viewer.head import scene_head
from uwsim.viewer.pack import Blob, make_pack

pytestmark = pytest.mark.slow
EVIL = """a "quoted" <b onclick='x()'>name</b> </script><script>evil = 1</script> \u202e日本 🐟"""
LONG = "a-benchmark-with-a-long-name, package.module:AlgorithmOfALongName, seed 123456"
SIZES = ((1920, 1080), (1024, 768), (1000, 700), (800, 600), (390, 800))
TWO_FRAMES = """() => new Promise(done =>
    requestAnimationFrame(() => requestAnimationFrame(() => done())))"""
CUT_OFF = """() => [...document.querySelectorAll("button, select, input, aside, canvas, output")]
    .filter((one) => one.checkVisibility() && one.closest("dialog") === null)
    .filter((one) => {
        const box = one.getBoundingClientRect()
        return box.left < -1 || box.right > innerWidth + 1 || box.width < 8
    })
    .map((one) => one.id || one.textContent)"""


def page_of(path: Path, title: str, label: str) -> str:
    """A replay of a scene in which nothing moves, with levels."""
    blob = Blob()
    with uwsim.load("shapes-scene") as simulation:
        head = scene_head(simulation, title, blob)
    for camera in head["cameras"]:
        camera["name"] = f"{title} {camera['name']}"
    levels = [
        {"label": f"{label} {k}", "status": "algorithm error", "why": f"{label} " * 9}
        | {"start": k, "end": k + 1.0, "values": {}}
        for k in range(30)
    ]
    curve = {"name": label, "unit": label, "times": blob.add(np.arange(9, dtype="<u4"))}
    curve["values"] = blob.add(np.arange(9, dtype="<f4"))
    trial = {"title": title, "motion": None, "levels": levels, "curves": [curve]}
    path.write_text(document(title, make_pack({**head, "trials": [trial]}, blob)), encoding="utf-8")
    return path.as_uri()


@pytest.mark.parametrize("name", [LONG, EVIL])
def test_nothing_is_cut_off(tab: Any, tmp_path: Path, name: str) -> None:
    tab.goto(page_of(tmp_path / "page.html", name, name))
    tab.wait_for_function("window.uwsim !== undefined")
    tab.evaluate("uwsim.seek(3.5)")
    for width, height in SIZES:
        tab.set_viewport_size({"width": width, "height": height})
        tab.evaluate(TWO_FRAMES)
        assert tab.evaluate(CUT_OFF) == [], (width, height)
        assert tab.evaluate("document.documentElement.scrollWidth") <= width
    assert tab.evaluate("window.evil") is None
    wide, narrow = (
        tab.evaluate(f"uwsim.page.views.viewCamera({w}, 600).intrinsics") for w in (800, 200)
    )
    assert narrow["fx"] / narrow["width"] == pytest.approx(wide["fx"] / wide["width"])
    assert tab.title() == " ".join(name.split())
    assert tab.locator("#title").inner_text() == name
