"""Caustics and light shafts in the page, against the images of the renderer."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from tests.viewer.test_surface_page import SCALE, SEED, draw_page, draw_scene, look_at, make_trial
from uwsim.optics import find_water
from uwsim.simulation import Simulation
from uwsim.viewer.caustics import describe_focusing_waves
from uwsim.viewer.document import document
from uwsim.viewer.head import scene_head
from uwsim.viewer.pack import Blob, make_pack
from uwsim.viewer.surface import describe_moving_surface

pytestmark = pytest.mark.slow
POOL, PIER = "shapes-scene", "pier-waves-scene"
VIEWS = {
    "floor": ((2.0, -2.5, -1.0), (0.0, 0.0, -3.0)),
    "piles": ((5.0, -6.0, -1.2), (0.0, 0.0, -2.0)),
    "sunward": ((3.0, -4.0, -5.0), (0.0, -3.5, -1.0)),
}
"""The positions of cameras in W and the points at which they look [m]."""


def change_water(simulation: Simulation, **changes: Any) -> None:
    """Change the physical water of a scene."""
    state = simulation.world.scenery.state
    assert state.water.physical_water is not None
    water = replace(state.water.physical_water, **changes)
    state.water = replace(state.water, physical_water=water)


def check_page(tab: Any, image: Any, view: str) -> Any:
    """Compare the image of the page with that of the renderer, and return it."""
    page_image = draw_page(tab, look_at(*VIEWS[view]), image.shape)
    off = np.abs(page_image - image)
    assert image.mean() > 10.0
    assert off.mean() <= 1.0
    assert np.percentile(off, 99) <= 4.0
    return page_image


def open_page(tab: Any, folder: Path, head: dict[str, Any], blob: Blob) -> None:
    (folder / "page.html").write_text(document("x", make_pack(head, blob)), encoding="utf-8")
    tab.goto((folder / "page.html").as_uri())
    tab.wait_for_function("window.uwsim !== undefined")


def test_ripples_focus_the_sun_on_the_floor_of_a_pool(tab: Any, tmp_path: Path) -> None:
    blob, view = Blob(), look_at(*VIEWS["floor"])
    with uwsim.load(POOL) as simulation:
        head = scene_head(simulation, POOL, blob)
        images = [draw_scene(simulation, view, time) for time in (0.0, 0.9)]
        change_water(simulation, has_caustics=False, has_light_shafts=False)
        plain_image = draw_scene(simulation, view, 0.0)
    assert np.abs(images[0].astype(np.int16) - images[1]).mean() > 1.0
    assert np.abs(images[0].astype(np.int16) - plain_image).mean() > 1.0
    head["trials"] = [make_trial("pool")]
    open_page(tab, tmp_path, head, blob)
    for time, image in zip((0.0, 0.9), images, strict=True):
        tab.evaluate("(time) => uwsim.seek(time)", time)
        check_page(tab, image, "floor")


@pytest.mark.parametrize("part", ["has_caustics", "has_light_shafts"])
def test_waves_shift_caustics_and_light_shafts(tab: Any, tmp_path: Path, part: str) -> None:
    """In clear or in green water, at two times, and with another seed."""
    other = {"has_caustics": "has_light_shafts", "has_light_shafts": "has_caustics"}[part]
    view = {"has_caustics": "piles", "has_light_shafts": "sunward"}[part]
    cases, blob = [(0, 0.0), (0, 4.5), (1, 2.25)], Blob()
    with uwsim.load(PIER) as first, uwsim.load(PIER, seed=SEED) as second:
        for simulation in (first, second):
            change_water(simulation, **{other: False})
            if part == "has_caustics":
                change_water(simulation, medium=find_water("jerlov-I"))
            simulation.world.water.state.wave_scale[0] = SCALE
        head = scene_head(first, PIER, blob)
        entries = {
            "surface": describe_moving_surface(second.world, blob),
            "caustics": describe_focusing_waves(second.world, blob),
        }
        head["trials"] = [make_trial("first"), make_trial("second") | entries]
        pose = look_at(*VIEWS[view])
        images = [draw_scene((first, second)[trial], pose, time) for trial, time in cases]
        change_water(first, **{part: False})
        plain_image = draw_scene(first, pose, 0.0)
    assert np.abs(images[0].astype(np.int16) - plain_image).mean() > 0.5
    open_page(tab, tmp_path, head, blob)
    for (trial, time), image in zip(cases, images, strict=True):
        tab.evaluate("(level) => uwsim.go(level)", trial)
        tab.evaluate("(time) => uwsim.seek(time)", time)
        check_page(tab, image, view)
