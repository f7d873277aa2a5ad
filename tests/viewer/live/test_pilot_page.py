"""A pilot in a browser: what the page sends, what it says, and what it follows."""

from __future__ import annotations

import base64
import json
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import uwsim
from tests.simulation.test_lamp import LAMP, night
from tests.support.opened import open_scene
from uwsim.base.geometry import Pose
from uwsim.messages import Float64
from uwsim.runs.trial.pilot_topics import pilot_topics
from uwsim.viewer.document import document
from uwsim.viewer.live.mapping import KEYS, PilotMapping
from uwsim.viewer.live.server import LiveServer
from uwsim.viewer.live.session import LiveSession

pytestmark = pytest.mark.slow
LIMIT = 120_000
"""How long a page may take before it counts as hanging [ms]."""
MAPPING = PilotMapping(
    keys={"w": "+thruster1 +thruster2", "s": "-thruster1 -thruster2", "e": "thruster3", "z": ""}
)


@pytest.fixture(scope="module")
def server() -> Iterator[LiveServer]:
    made = LiveServer(lambda: document("scene", None))
    yield made
    made.close()


def opened(browser: Any, server: LiveServer, mapping: PilotMapping, height: int) -> Any:
    """Open the page of a scene that stands still, in a window of some height."""
    session = LiveSession(server, mapping=mapping)
    with uwsim.load("currents-scene") as simulation:
        session.open(simulation, "scene")
        session.close()
    return page_of(browser, server, height)


def page_of(browser: Any, server: LiveServer, height: int = 768) -> Any:
    """Open the page in a window of some height."""
    window = {"width": 1024, "height": height}
    page = browser.new_context(viewport=window, bypass_csp=True).new_page()
    page.set_default_timeout(LIMIT)
    page.goto(server.url)
    page.wait_for_function("window.uwsim !== undefined && uwsim.page.connection.pilot.isOn")
    page.wait_for_function("uwsim.page.player.trails.length > 0 && uwsim.page.drawnKey !== ''")
    page.evaluate("uwsim.page.draw()")
    return page


@pytest.mark.parametrize("height", [300, 420, 768])
def test_no_row_of_the_help_is_behind_its_button_in_a_low_window(
    browser: Any, server: LiveServer, height: int
) -> None:
    page = opened(browser, server, PilotMapping(keys=KEYS), height)
    page.keyboard.press("?")
    button = page.get_by_role("button", name="Close").bounding_box()
    assert button["y"] + button["height"] <= height
    for way in ("Home", "PageDown", "End"):
        page.keyboard.press(way)
        page.wait_for_timeout(500)  # it scrolls smoothly
        assert page.evaluate(SEEN) <= button["y"] + 0.5, way
    last = page.get_by_text("with a letter").bounding_box()
    assert last["y"] + last["height"] <= button["y"] + 0.5
    page.keyboard.press("Escape")
    assert not page.get_by_role("dialog").is_visible()
    page.context.close()


SEEN = """() => {
    const seen = (row) => {
        let { top, bottom } = row.getBoundingClientRect()
        for (let box = row.parentElement; box.id !== "help"; box = box.parentElement) {
            if (getComputedStyle(box).overflowY !== "auto") continue
            const cut = box.getBoundingClientRect()
            bottom = Math.min(bottom, cut.bottom)
            if (top >= cut.bottom) return 0
        }
        return bottom
    }
    const lowest = document.getElementById("help").getBoundingClientRect().bottom
    return Math.max(...[...document.querySelectorAll("#help dd")].map(seen).filter(y => y < lowest))
}"""
"""How far down rows of the help are seen [px]."""


@pytest.mark.parametrize("brightness", [1.0, 0.3, 0.0])
def test_a_dimmed_lamp_looks_in_the_page_as_in_a_camera(
    browser: Any, server: LiveServer, brightness: float
) -> None:
    with open_scene(night(LAMP)) as simulation:
        simulation.publish("headlight/brightness", Float64(data=brightness))
        simulation.advance(0.01)
        session = LiveSession(server)
        session.open(simulation, "scene")
        session.close()
        drawn = simulation.image("bowtech1").colour
    assert drawn is not None
    assert bool(drawn.max() > 30) is (brightness > 0.0)
    page = browser.new_context(bypass_csp=True).new_page()
    page.set_default_timeout(LIMIT)
    page.goto(server.url)
    page.wait_for_function("window.uwsim !== undefined")
    pixels = np.frombuffer(base64.b64decode(page.evaluate("uwsim.image('bowtech1')")), np.uint8)
    seen = pixels.reshape(*drawn.shape[:2], 4)[..., :3].astype(np.int16)
    assert np.abs(seen - drawn).mean() <= 1.0
    assert np.percentile(np.abs(seen - drawn), 99) <= 4.0
    page.context.close()


def test_a_page_begins_again_after_its_graphics_context_was_lost(
    browser: Any, server: LiveServer
) -> None:
    page = opened(browser, server, MAPPING, 500)
    message = "document.getElementById('message').textContent"
    for restore in ("setTimeout(() => lost.restoreContext(), 0)", "0", "0"):
        page.evaluate(LOSE)
        page.wait_for_function(f"{message}.includes('process has ended')")
        page.evaluate(restore)
        page.wait_for_function("window.lost === undefined && window.uwsim?.page.drawnKey")
    page.evaluate(LOSE)  # a fourth time within a minute
    page.wait_for_function(f"{message}.includes('ends again and again')")
    page.context.close()


LOSE = """() => {
    const context = document.getElementById('image').getContext('webgl2');
    window.lost = context.getExtension('WEBGL_lose_context');
    window.lost.loseContext();
}"""
"""Loses the context of the page, as the end of the graphics process does."""


def test_the_help_names_all_axes_of_a_key(browser: Any, server: LiveServer) -> None:
    page = opened(browser, server, MAPPING, 768)
    rows = page.evaluate(
        "uwsim.page.connection.helpGroups().Pilot.map(({ keys, action }) => keys + ': ' + action)"
    )
    assert rows[:-1] == ["w  s: thruster1 thruster2 +, −", "e  –: thruster3 +, −"]
    page.context.close()


def test_the_keys_for_the_speed_select_the_next_one_also_from_a_speed_outside_the_list(
    browser: Any, server: LiveServer
) -> None:
    page = opened(browser, server, PilotMapping(keys={}), 768)
    for speed, slower, faster in (
        (3, 2, 5),
        (1, 0.5, 2),
        (0.1, 0.1, 0.25),
        (40, 20, 0),
        (0, 20, 0),
    ):
        for direction, expected in ((-1, slower), (1, faster)):
            page.evaluate(f"uwsim.page.setState(false, {speed})")
            page.evaluate(f"uwsim.page.changeSpeed({direction})")
            assert page.evaluate("uwsim.page.speed") == expected, (speed, direction)
    page.context.close()


def test_trails_of_a_running_simulation_begin_again_after_a_reset(
    browser: Any, server: LiveServer
) -> None:
    page = opened(browser, server, PilotMapping(keys={}), 768)
    length = """([clearTime, times]) => {
        const { page } = uwsim, { row, end } = page.player
        for (let time = end; time <= clearTime; time += 0.5) page.player.push(time, row)
        page.clearTrails()
        for (const time of times) page.player.push(time, row)
        return page.player.trail(page.pack.head.vehicles[0].body, page.player.end).length
    }"""
    assert page.evaluate(length, [10, [10.5, 11]]) == 2
    assert page.evaluate(length, [20, [1, 1.5, 2]]) >= 2  # a reset
    page.context.close()


def test_a_simulation_as_fast_as_it_can_and_one_of_any_speed_say_so(
    browser: Any, server: LiveServer
) -> None:
    page = opened(browser, server, MAPPING, 768)
    shown = "document.getElementById('speed').selectedOptions[0].text"
    for speed, text in ((0, "fastest"), (1.5, "1.5×"), (1, "1×")):
        page.evaluate(f"uwsim.page.setState(false, {speed})")
        assert page.evaluate(shown) == text
    for key, text in ((">", "2×"), ("<", "1×")):
        page.keyboard.press(key)
        assert page.evaluate(shown) == text
    page.context.close()


def test_a_drawing_that_fails_once_is_not_the_end(browser: Any, server: LiveServer) -> None:
    page = opened(browser, server, MAPPING, 768)
    page.evaluate("""() => {
        const { page } = window.uwsim, draw = page.draw.bind(page)
        window.n = 0
        page.draw = () => { if (++window.n === 1) throw new Error("no"); draw() }
        setInterval(() => { page.views.version += 1 }, 20)
    }""")
    page.wait_for_function("window.n > 2")
    page.context.close()


@pytest.mark.parametrize("width", [390, 1024])
def test_sticks_and_images_of_cameras_do_not_cover_each_other(
    browser: Any, server: LiveServer, width: int
) -> None:
    page = opened(browser, server, MAPPING, 768)
    page.set_viewport_size({"width": width, "height": 768})
    image = page.locator("#pictures figure").bounding_box()
    for stick in page.locator(".stick").all():
        box = stick.bounding_box()
        is_beside = box["x"] >= image["x"] + image["width"]
        assert is_beside or box["y"] >= image["y"] + image["height"]
    page.context.close()


def test_keys_that_move_nothing_are_not_in_the_help_and_no_letter_has_two_meanings(
    browser: Any, server: LiveServer
) -> None:
    session = LiveSession(server, mapping=PilotMapping(), allows_reset=True)
    with uwsim.load("currents-scene") as simulation:
        session.open(simulation, "scene", pilot_topics(simulation))
        session.close()
    page = page_of(browser, server)
    rows = page.evaluate("uwsim.page.connection.helpGroups().Pilot.map(({ action }) => action)")
    assert rows[:-1] == [f"{axis} +, −" for axis in ("surge", "sway", "yaw", "heave")]
    keys = page.evaluate("[...document.querySelectorAll('#help dt')].map((dt) => dt.textContent)")
    letters = [key for text in keys for key in text.split() if len(key) == 1 and key.isalpha()]
    assert len(letters) == len(set(letters))
    assert {"Shift+r", "r"} <= set(" ".join(keys).split())
    assert page.locator(".stick").count() == 2
    page.context.close()


def test_where_nothing_can_be_steered_the_page_says_why_and_has_no_sticks(
    browser: Any, server: LiveServer, capsys: pytest.CaptureFixture[str]
) -> None:
    session = LiveSession(server, mapping=PilotMapping())
    with uwsim.load("dredging-scene") as simulation:
        session.open(simulation, "scene", pilot_topics(simulation))
        session.close()
    assert "No vehicle can be steered" in capsys.readouterr().err
    page = page_of(browser, server)
    assert page.locator(".stick").count() == 0
    assert "<ROSTwistToPAT>" in page.locator("#pilot").inner_text()
    page.context.close()


def test_the_orbit_goes_along_with_the_piloted_vehicle_and_keeps_its_distance(
    browser: Any, server: LiveServer
) -> None:
    ways: dict[int, np.ndarray] = {}
    with uwsim.load("two-vehicles-scene") as simulation:
        parameters = pilot_topics(simulation)
        other = next(
            spec.topic
            for spec in simulation.world.model.scene.ros_interfaces
            if type(spec).__name__ == "ROSTwistToPATSpec"
            and spec.vehicle_name == simulation.world.vehicles.names[1]
        )
        for index, topic in enumerate((parameters["twist_topic"], other)):
            session = LiveSession(server, mapping=PilotMapping())
            session.open(simulation, "scene", {**parameters, "twist_topic": topic})
            began = simulation.pose(simulation.world.vehicles.names[index], "W")
            moved = Pose(np.add(began.position, (3.0, -2.0, 0.5)), began.rotation)
            simulation.world.engine.place_vehicle(index, moved)
            session.view._due["row"] = 0.0
            session.view.publish_due()
            session.close()
            page = page_of(browser, server)
            page.wait_for_function("uwsim.page.drawnKey !== ''")
            eye = "uwsim.page.views.viewCamera(800, 600).worldFromCamera"
            first = page.evaluate("uwsim.page.pack.head.view.pose")
            now = page.evaluate(f"Array.from({eye})")
            ways[index] = np.array([now[3], now[7], now[11]]) - first[:3]
            page.evaluate("uwsim.page.views.drag(0.1, 0.1, true)")  # moved on by hand
            panned = page.evaluate(f"Array.from({eye})")
            assert np.abs(np.subtract(panned, now)).max() > 0.1
            page.keyboard.press("Shift+K")
            assert page.evaluate(f"Array.from({eye})") == panned
            page.context.close()
    for way in ways.values():
        assert way == pytest.approx([3.0, -2.0, 0.5], abs=0.01)


WORDS = """() => {
    window.words = new Set()
    const fill = CanvasRenderingContext2D.prototype.fillText
    CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
        window.words.add(text)
        fill.call(this, text, ...rest)
    }
}"""
"""Keeps what is written on canvases."""


def test_names_of_frames_of_two_vehicles_begin_with_the_vehicles(
    browser: Any, server: LiveServer
) -> None:
    with uwsim.load("two-vehicles-scene") as simulation:
        session = LiveSession(server)
        session.open(simulation, "scene")
        session.close()
        vehicles = simulation.world.vehicles.names
    page = browser.new_context(bypass_csp=True).new_page()
    page.set_default_timeout(LIMIT)
    page.goto(server.url)
    page.wait_for_function("window.uwsim !== undefined")
    page.evaluate(WORDS)
    page.keyboard.press("f")
    page.wait_for_function("words.size > 4")
    page.evaluate("uwsim.page.views.drag(Math.PI / 4, 0, false)")  # the second is behind it
    for vehicle in vehicles:
        page.wait_for_function(f"words.has('{vehicle} base_link')")
    page.context.close()


def test_the_status_of_a_level_that_is_over_is_shown_at_once(
    browser: Any, server: LiveServer
) -> None:
    page = opened(browser, server, MAPPING, 768)
    level = {"label": "fog 0.5", "status": "running", "why": "", "start": 0.0, "end": 0.0}
    for status in ("running", "ok"):
        levels = [{**level, "status": status, "values": {"fog": 0.5}}]
        server.publish("levels", json.dumps({"type": "levels", "levels": levels}))
        page.wait_for_function(f"document.getElementById('now').textContent.endsWith('{status}')")
        assert page.locator("#levels button").inner_text().split() == ["fog", "0.5", status]
    page.context.close()


def test_a_curve_has_more_than_one_number_at_its_side(browser: Any, server: LiveServer) -> None:
    page = opened(browser, server, MAPPING, 768)
    # its axis had one number: 50
    samples = [["offset", "px", 0.1 * k, 12.0 + 5.0 * k] for k in range(11)]
    server.publish("samples/0", json.dumps({"type": "samples", "samples": samples}))
    server.publish("levels", json.dumps({"type": "levels", "levels": []}))  # it is drawn
    page.wait_for_function("uwsim.page.curves.charts.length === 1")
    n = page.evaluate("uwsim.page.curves.charts[0].plot.axes[1]._splits.length")
    assert 3 <= n <= 8
    page.context.close()
