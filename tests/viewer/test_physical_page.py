"""Physical water in the page, against the images of the renderer."""

from __future__ import annotations

import base64
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import uwsim
from uwsim.optics import HenyeyGreenstein, find_water
from uwsim.rendering.grey import grey_truncated
from uwsim.simulation import Simulation
from uwsim.viewer.document import document
from uwsim.viewer.head import scene_head
from uwsim.viewer.pack import Blob, make_pack

pytestmark = pytest.mark.slow
SCENE = "wreck-physical-scene"
NO_FLOATS = """(names) => {
    const original = WebGL2RenderingContext.prototype.getExtension
    WebGL2RenderingContext.prototype.getExtension = function (name) {
        return names.includes(name) ? null : original.call(this, name)
    }
}"""
"""The script of a browser without some extensions of WebGL."""


def set_water(simulation: Simulation, **changes: Any) -> None:
    """Change the physical water of a scene."""
    state = simulation.world.scenery.state
    assert state.water.physical_water is not None
    optics = replace(state.water.physical_water, **changes)
    state.water = replace(state.water, physical_water=optics)


def open_page(tab: Any, head: dict[str, Any], blob: Blob, path: Path) -> None:
    path.write_text(document(SCENE, make_pack(head, blob)), encoding="utf-8")
    tab.goto(path.as_uri())
    tab.wait_for_function("window.uwsim !== undefined")


def draw_page(tab: Any, camera: dict[str, Any], **water: float) -> npt.NDArray[np.int16]:
    text = tab.evaluate("([name, water]) => uwsim.image(name, water)", [camera["name"], water])
    pixels = np.frombuffer(base64.b64decode(text), np.uint8)
    return pixels.reshape(camera["height"], camera["width"], 4)[..., :3].astype(np.int16)


def draw_scene(simulation: Simulation, camera: dict[str, Any], rate: float) -> Any:
    """Return the image of the renderer at a light rate."""
    scenery = simulation.world.scenery
    scenery.set_light_rate(rate)
    view = simulation.world.sensors.camera(camera["name"])
    colour = scenery.render_clean(
        view.world_from_camera, view.intrinsics, targets={"colour"}
    ).colour
    assert colour is not None
    return colour.view(np.uint8)


def check_equal(page: npt.NDArray[np.int16], wanted: npt.NDArray[np.uint8]) -> None:
    off = np.abs(page - wanted.astype(np.int16))
    assert wanted.mean() > 3.0
    assert off.mean() <= 1.0
    assert np.percentile(off, 99) <= 4.0


@pytest.mark.parametrize("rate", [1.0, 0.0])
@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"medium": find_water("jerlov-7C")},
        {"medium": find_water("tank"), "transfer": "linear", "has_lamp_veil": False},
        {"medium": replace(find_water("jerlov-3C"), phase_function=HenyeyGreenstein(0.9))},
        {"has_blur": False},
        {"medium": find_water("jerlov-7C"), "blur_margin": 0.3},
    ],
    ids=["scene", "green", "linear", "other-phase", "sharp", "margin"],
)
def test_cameras_see_what_the_renderer_draws_by_day_and_with_lamps_at_night(
    tab: Any, tmp_path: Path, changes: dict[str, Any], rate: float
) -> None:
    blob = Blob()
    with uwsim.load(SCENE) as simulation:
        set_water(simulation, **changes)
        head = scene_head(simulation, SCENE, blob)
        open_page(tab, head, blob, tmp_path / "page.html")
        (camera,) = head["cameras"]
        wanted = draw_scene(simulation, camera, rate)
    check_equal(draw_page(tab, camera, light_rate=rate), wanted)


def test_a_lamp_in_view_and_its_halo_are_there_in_a_grey_image(tab: Any, tmp_path: Path) -> None:
    blob = Blob()
    with uwsim.load(SCENE) as simulation:
        set_water(simulation)
        head = scene_head(simulation, SCENE, blob)
        (camera,), lamp = head["cameras"], head["lamps"][0]
        assert camera["body"] == lamp["body"]
        # the camera looks back along the lamp's beam, from 3 m ahead of it
        lamp_pose = simulation.world.scenery.mounted_lamps[0].world_from_lamp
        axes = lamp_pose.rotation * [-1.0, 1.0, -1.0]
        eye = uwsim.Pose(lamp_pose.position - 3.0 * lamp_pose.rotation[:, 2], axes)
        body = simulation.world.bodies.find(camera["body"].partition("/")[0]).world_from_body
        body_from_eye = body.inverse() @ eye
        camera["pose"] = [*body_from_eye.position, *body_from_eye.quaternion]
        camera["grey"] = True
        open_page(tab, head, blob, tmp_path / "page.html")
        scenery = simulation.world.scenery
        scenery.set_light_rate(0.0)
        lens = simulation.world.sensors.camera(camera["name"]).intrinsics
        colour = scenery.render_clean(eye, lens, targets={"colour"}).colour
        assert colour is not None
        wanted = grey_truncated(colour.view(np.uint8))
    assert wanted.max() >= 250
    check_equal(draw_page(tab, camera, light_rate=0.0), np.repeat(wanted[..., None], 3, axis=2))


def test_half_floats_are_enough(tab: Any, tmp_path: Path) -> None:
    """As on phones, which cannot interpolate or blend floats."""
    names = '["OES_texture_float_linear", "EXT_float_blend"]'
    tab.add_init_script(f"({NO_FLOATS})({names})")
    blob = Blob()
    with uwsim.load(SCENE) as simulation:
        set_water(simulation)
        head = scene_head(simulation, SCENE, blob)
        open_page(tab, head, blob, tmp_path / "page.html")
        (camera,) = head["cameras"]
        wanted = draw_scene(simulation, camera, 1.0)
    check_equal(draw_page(tab, camera), wanted)


def test_a_browser_without_floats_shows_the_fog_and_says_so(tab: Any, tmp_path: Path) -> None:
    names = '["EXT_color_buffer_float", "EXT_color_buffer_half_float"]'
    tab.add_init_script(f"({NO_FLOATS})({names})")
    blob = Blob()
    with uwsim.load(SCENE) as simulation:
        head = scene_head(simulation, SCENE, blob)
    open_page(tab, head, blob, tmp_path / "page.html")
    assert tab.get_by_text("not its physical water").is_visible()
    assert draw_page(tab, head["cameras"][0]).max() > 0


@pytest.mark.parametrize("height", [-4.0, 1.0])
@pytest.mark.parametrize("is_clear", [True, False])
def test_external_views_are_those_of_an_observer(
    tab: Any, tmp_path: Path, is_clear: bool, height: float
) -> None:
    """Below the surface and above it, where only a part of each ray is in water."""
    blob = Blob()
    with uwsim.load(SCENE) as simulation:
        set_water(simulation)
        head = scene_head(simulation, SCENE, blob)
        eye = head["view"]["pose"]
        eye[2] = height
        open_page(tab, head, blob, tmp_path / "page.html")
        lens = simulation.world.sensors.camera(head["cameras"][0]["name"]).intrinsics
        pose = uwsim.Pose.from_quaternion(np.array(eye[:3]), np.array(eye[3:]))
        colour = simulation.world.scenery.render_view(
            pose, lens, targets={"colour"}, fog=0.0 if is_clear else None
        ).colour
        assert colour is not None
        wanted = colour.view(np.uint8)
    text = tab.evaluate(
        "([pose, isClear]) => uwsim.external(pose, isClear)",
        [pose.matrix.ravel().tolist(), is_clear],
    )
    pixels = np.frombuffer(base64.b64decode(text), np.uint8)
    check_equal(pixels.reshape(*wanted.shape[:2], 4)[..., :3].astype(np.int16), wanted)
