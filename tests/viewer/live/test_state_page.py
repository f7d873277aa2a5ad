"""The page of a running simulation: state of the vehicle, topics, views, sticks and labels."""

from __future__ import annotations

import json
import math
import re
import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from tests.support.opened import open_scene
from tests.viewer.live.test_pilot_page import page_of
from uwsim.base.geometry import Pose
from uwsim.runs.trial.pilot_topics import pilot_topics
from uwsim.scene.reader import read_scene
from uwsim.simulation import Simulation
from uwsim.viewer.document import document
from uwsim.viewer.live.mapping import PilotMapping
from uwsim.viewer.live.server import LiveServer
from uwsim.viewer.live.session import LiveSession

pytestmark = pytest.mark.slow
PHONE, DESKTOP = (390, 844), (1280, 800)
WALL = """<UWSimScene xmlns:u="urn:uwsim:1">
  <oceanState> <fog><density>0</density></fog> <oceanSurfaceHeight>1.5</oceanSurfaceHeight>
  </oceanState>
  <vehicle> <name>rov</name> <file>rexrov.urdf</file>
    <position> <x>X</x> <y>0</y> <z>-5</z> </position> </vehicle>
  <object> <name>wall</name> <file>objects/box.osg</file>
    <position> <x>-3</x> <y>0</y> <z>-5</z> </position>
    <scaleFactor> <x>0.2</x> <y>20</y> <z>20</z> </scaleFactor> </object>
  <object> <name>floor</name> <file>objects/box.osg</file>
    <position> <x>0</x> <y>0</y> <z>-9.5</z> </position>
    <scaleFactor> <x>60</x> <y>60</y> <z>1</z> </scaleFactor> </object>
</UWSimScene>"""


@pytest.fixture(scope="module")
def server() -> Iterator[LiveServer]:
    made = LiveServer(lambda: document("scene", None))
    yield made
    made.close()


def shown(
    browser: Any, server: LiveServer, simulation: Simulation, move: Callable[[], object] = lambda: 0
) -> Any:
    """Open the page of a simulation that stands still, piloted; ``move`` is done before."""
    session = LiveSession(server, mapping=PilotMapping(), allows_reset=True)
    session.open(simulation, "scene", pilot_topics(simulation))
    move()
    session.view._due = dict.fromkeys(session.view._due, 0.0)
    session.view.publish_due()
    session.close()
    page = page_of(browser, server)
    page.wait_for_function(
        "uwsim.page.drawnKey !== '' && document.querySelectorAll('#hud button').length"
    )
    return page


def resized(page: Any, size: tuple[int, int]) -> None:
    """Give the window a size."""
    page.set_viewport_size(dict(zip(("width", "height"), size, strict=True)))
    page.evaluate(
        "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
    )


def state(page: Any) -> dict[str, str]:
    """Names and values of the head-up display, once it has shown the same for half a second.

    The page gets the start of a scene, then what a test has moved; the display follows a few times
    a second.
    """
    page.wait_for_function(
        """() => {
            const text = document.querySelector("#hud").innerText, now = performance.now();
            if (window.seen?.text !== text) window.seen = { text, since: now };
            return now - window.seen.since > 500;
        }""",
        polling=50,
    )
    cells = page.locator("#hud button").all()
    return dict(cell.inner_text().split("\n") for cell in cells)


def number(text: str) -> float:
    found = re.match(r"[−\d.]+", text)
    assert found is not None, text
    return float(found[0].replace("−", "-"))


def rov(path: Path, x: float = 0.0) -> Simulation:
    """A vehicle whose z axis points up, 3 m ahead of a wall, over a floor 4 m below."""
    path.write_text(WALL.replace("X", f"{x}"))
    return open_scene(read_scene(path))


@pytest.mark.parametrize(("roll", "pitch", "heading"), [(10.0, -20.0, 300.0), (-35.0, 5.0, 75.0)])
@pytest.mark.parametrize("is_down", [True, False])
def test_the_state_is_that_of_the_vehicle_whichever_way_its_z_axis_points(
    browser: Any,
    server: LiveServer,
    tmp_path: Path,
    is_down: bool,
    roll: float,
    pitch: float,
    heading: float,
) -> None:
    """Heading from north, W's y, to east, x; roll to starboard and pitch bow up are positive."""
    h, p, r = np.radians([heading, pitch, roll])
    ahead = np.array([np.sin(h) * np.cos(p), np.cos(h) * np.cos(p), np.sin(p)])
    level = np.array([np.cos(h), -np.sin(h), 0.0])  # to starboard
    above = np.cross(level, ahead)
    starboard = np.cos(r) * level - np.sin(r) * above
    y = starboard if is_down else -starboard
    with uwsim.load("grasp-scene") if is_down else rov(tmp_path / "scene.xml") as simulation:
        world = simulation.world
        live = world.vehicles.find(world.vehicles.names[0])
        assert bool(live.world_from_base.rotation[2, 2] < 0.0) is is_down
        place = np.array([0.3, 0.2, world.model.scene.ocean_state.ocean_surface_height - 2.75])

        def move() -> None:
            live.place(Pose(place, np.column_stack([ahead, y, np.cross(ahead, y)])))
            live.set_joints(np.linspace(0.1, 0.3, len(live.joint_names)))

        page = shown(browser, server, simulation, move)
        found = state(page)
        page.context.close()
    assert number(found["depth"]) == pytest.approx(2.75)
    assert number(found["heading"]) == pytest.approx(heading, abs=0.06)
    assert number(found["roll"]) == pytest.approx(roll, abs=0.06)
    assert number(found["pitch"]) == pytest.approx(pitch, abs=0.06)
    for joint, angle in zip(live.joint_names, np.degrees(live.joints), strict=True):
        assert number(found[joint]) == pytest.approx(angle, abs=0.06), joint


def test_the_altitude_is_the_distance_to_what_is_below_and_not_to_the_vehicle_itself(
    browser: Any, server: LiveServer, tmp_path: Path
) -> None:
    with rov(tmp_path / "scene.xml") as simulation:
        page = shown(browser, server, simulation)
    assert number(state(page)["altitude"]) == pytest.approx(4.0, abs=0.006)
    page.context.close()


def test_a_speed_is_that_over_ground(browser: Any, server: LiveServer, tmp_path: Path) -> None:
    with rov(tmp_path / "scene.xml") as simulation:
        page = shown(browser, server, simulation)
        motion = page.evaluate("uwsim.page.pack.head.motion")
        body = page.evaluate("uwsim.page.pack.head.vehicles[0].body")
        n = 7 * len(motion["bodies"]) + len(motion["signals"])
        for k in range(8):  # 0.3 m/s east, 0.4 m/s down
            row = np.zeros(n, "<f4")
            at = 7 * motion["bodies"].index(body)
            row[at : at + 4] = (0.3 * k / 30, 0.0, -5.0 - 0.4 * k / 30, 1.0)
            header = struct.pack("<BBHId", 1, 0, 0, k, 1.0 + k / 30)
            server.publish("row", header + row.tobytes())
            page.wait_for_function(f"uwsim.page.player.end > {1.0 + (k - 0.5) / 30}")
        page.wait_for_function("document.getElementById('hud').innerText.includes('0.50 m/s')")
    page.context.close()


def test_a_number_of_the_state_is_a_curve_on_request_and_no_panel_is_empty(
    browser: Any, server: LiveServer
) -> None:
    with uwsim.load("currents-scene") as simulation:
        page = shown(browser, server, simulation)
        heads = "[...document.querySelectorAll('aside h2')].filter((h) => h.checkVisibility())"
        assert "Measures" not in page.evaluate(f"{heads}.map((h) => h.textContent)")
        sections = page.locator("aside > section").all()
        for section in (each for each in sections if each.is_visible()):
            assert section.locator("canvas, select, button, .bar").count() > 0
        assert page.locator("#state .fold, #state figcaption").count() == 2
        page.locator("#hud button", has_text="heading").click()
        page.wait_for_function("document.querySelectorAll('#state canvas').length === 3")
        for name in ("heading", "depth", "speed"):
            page.locator("#hud button", has_text=name).click()
        page.wait_for_function("document.getElementById('state-box').hidden")
        page.keyboard.press("z")
        assert not page.locator("#hud").is_visible()
    page.context.close()


def test_topics_are_shown_on_request(browser: Any, server: LiveServer) -> None:
    with uwsim.load("currents-scene") as simulation:
        page = shown(browser, server, simulation)
        names = page.evaluate("[...document.querySelectorAll('#topic option')].map((o) => o.value)")
        assert names[1:] == list(simulation.topics)
        page.select_option("#topic", "dataNavigator")
        assert "No message yet" in page.locator(".topic").inner_text()
        for k in range(3):
            fields = [["status", "fine"], ["pose.x", 1.5 + k], ["pose.y", None]]
            text = {"type": "topic", "name": "dataNavigator", "time": 0.1 * k, "fields": fields}
            while "?topic/dataNavigator" not in server.channels():
                page.wait_for_timeout(20)
            server.publish("?topic/dataNavigator", json.dumps({**text, "is_cut": False}))
            page.wait_for_function(
                f"document.querySelector('.topic').innerText.includes('{1.5 + k}')"
            )
        lines = page.locator(".field").all_inner_texts()
        assert [line.split() for line in lines] == [
            ["status", "fine"],
            ["pose.x", "3.5"],
            ["pose.y", "–"],
        ]
        page.evaluate("uwsim.page.draw()")
        assert page.locator(".topic canvas").count() == 1
        page.locator(".topic h3 button").click()
        assert page.locator(".topic").count() == 0
        while server.channels() & {"?topic/dataNavigator"}:
            page.wait_for_timeout(20)
    page.context.close()


OVERLAPS = """() => {
    const boxes = [...document.querySelectorAll("#pictures figure, .thumb, .keyline, #hud")]
        .filter((one) => one.checkVisibility())
        .map((one) => [one.className || one.id || one.tagName, one.getBoundingClientRect()])
    const inside = document.getElementById("view").getBoundingClientRect()
    const out = boxes.filter(([, b]) => b.left < inside.left - 1 || b.bottom > inside.bottom + 1)
    const both = boxes.flatMap(([a, p], i) => boxes.slice(i + 1).filter(([, q]) =>
        p.left < q.right - 1 && p.right > q.left + 1 && p.top < q.bottom - 1 && p.bottom > q.top + 1
    ).map(([b]) => [a, b]))
    return [...out.map(([name]) => name), ...both]
}"""


def test_sticks_have_labels_in_the_lower_corners_and_nothing_covers_anything(
    browser: Any, server: LiveServer
) -> None:
    with uwsim.load("grasp-scene") as simulation:
        page = shown(browser, server, simulation)
    for size in (PHONE, (390, 664), (800, 600), (1024, 768), DESKTOP):
        resized(page, size)
        assert page.evaluate(OVERLAPS) == [], size
        view = page.locator("#view").bounding_box()
        left, right = (stick.bounding_box() for stick in page.locator(".stick").all())
        assert left["x"] - view["x"] < 20
        assert view["x"] + view["width"] - right["x"] - right["width"] < 20
    labels = page.locator(".thumb .label").all_inner_texts()
    assert [label.split("\n") for label in labels] == [
        ["↕ up / down", "↔ turn"],
        ["↕ forward / back", "↔ left / right"],
    ]
    page.context.close()


def test_a_line_of_keys_has_the_names_of_the_joints_until_somebody_pilots(
    browser: Any, server: LiveServer
) -> None:
    with uwsim.load("grasp-scene") as simulation:
        joints = simulation.world.vehicles.find("girona500").joint_names
        page = shown(browser, server, simulation)
    line = " ".join(page.locator(".keyline").inner_text().split())
    for words in ("WS forward / back", "EQ turn right / left", "? all keys", f"TG {joints[0]}"):
        assert words in line
    rows = page.evaluate("uwsim.page.connection.helpGroups().Pilot.map(({ action }) => action)")
    assert [f"{joint} +, −" for joint in joints] == [
        row for row in rows if row.split()[0] in joints
    ]
    page.keyboard.press("w")
    assert page.locator(".keyline.leaves").count() == 1
    page.context.close()


@pytest.mark.parametrize("scene", ["currents-scene", "grasp-scene"])
def test_a_letter_means_the_same_with_and_without_an_arm(
    browser: Any, server: LiveServer, scene: str
) -> None:
    with uwsim.load(scene) as simulation:
        page = shown(browser, server, simulation)
    trails = "uwsim.page.switches.trails"
    assert page.evaluate(trails) is True
    page.keyboard.press("t")  # a joint, which the first scene has nothing to command with
    assert page.evaluate(trails) is True
    page.keyboard.press("Shift+T")
    assert page.evaluate(trails) is False
    page.context.close()


LABELS = """() => {
    const boxes = []
    const fill = CanvasRenderingContext2D.prototype.fillText
    CanvasRenderingContext2D.prototype.fillText = function (text, x, y, ...rest) {
        boxes.push([text, x, y - 9, x + this.measureText(text).width, y + 2])
        fill.call(this, text, x, y, ...rest)
    }
    uwsim.page.draw()
    CanvasRenderingContext2D.prototype.fillText = fill
    return boxes
}"""


@pytest.mark.parametrize("scene", ["grasp-scene", "two-vehicles-scene"])
def test_labels_of_frames_do_not_overlap(browser: Any, server: LiveServer, scene: str) -> None:
    with uwsim.load(scene) as simulation:
        page = shown(browser, server, simulation)
    page.keyboard.press("f")
    boxes = [box for box in page.evaluate(LABELS) if box[0]]
    assert len(boxes) > 10
    for i, (_, left, top, right, bottom) in enumerate(boxes):
        for other in boxes[i + 1 :]:
            is_beside = other[1] >= right or other[3] <= left
            assert is_beside or other[2] >= bottom or other[4] <= top, (boxes[i], other)
    page.context.close()


LENGTHS = """() => {
    const lines = []
    const to = CanvasRenderingContext2D.prototype.lineTo
    CanvasRenderingContext2D.prototype.lineTo = function (x, y) {
        lines.push([x, y])
        to.call(this, x, y)
    }
    const boxes = (LABELS)()
    CanvasRenderingContext2D.prototype.lineTo = to
    const [[left], [right]] = lines.slice(-3)
    const { intrinsics, worldFromCamera } = uwsim.page.views.viewCamera(
        uwsim.page.picture.canvas.clientWidth, uwsim.page.picture.canvas.clientHeight)
    return [boxes.map(([text]) => text), (right - left) / intrinsics.fx, worldFromCamera[11]]
}""".replace("LABELS", LABELS)


def test_a_map_has_north_and_a_scale_at_the_depth_of_the_vehicle(
    browser: Any, server: LiveServer, tmp_path: Path
) -> None:
    with rov(tmp_path / "scene.xml") as simulation:
        page = shown(browser, server, simulation)
    page.keyboard.press("Shift+M")
    lengths = set()
    for _ in range(4):
        texts, share, height = page.evaluate(LENGTHS)
        assert "N" in texts
        (scale,) = (text for text in texts if re.fullmatch(r"[\d.]+ c?m", text))
        metres = float(scale.split()[0]) / (100 if scale.endswith("cm") else 1)
        assert metres == pytest.approx(share * (height + 5.0), rel=1e-3)
        lengths.add(metres)
        page.evaluate("uwsim.page.views.zoom(2.5)")
    assert len(lengths) == 4
    page.context.close()


def test_the_chase_view_is_nearer_where_something_hides_the_vehicle(
    browser: Any, server: LiveServer, tmp_path: Path
) -> None:
    ways = {}
    for x in (0.0, 20.0):  # behind it is the wall, or far away
        with rov(tmp_path / "scene.xml", x) as simulation:
            page = shown(browser, server, simulation)
        page.evaluate("uwsim.page.views.mode = 'chase'")
        page.evaluate("uwsim.page.views.zoom(8 / uwsim.page.views.orbit.distance)")
        eye = page.evaluate("Array.from(uwsim.page.views.viewCamera(800, 600).worldFromCamera)")
        ways[x] = np.subtract([eye[3], eye[7], eye[11]], [x, 0.0, -5.0])
        page.context.close()
    assert np.linalg.norm(ways[20.0]) == pytest.approx(8.0)
    assert -2.9 < ways[0.0][0] < -2.0  # ahead of the wall
    aim = [way / np.linalg.norm(way) for way in ways.values()]
    assert aim[0] == pytest.approx(aim[1], abs=1e-6)


def test_the_view_of_the_file_is_one_of_its_own(browser: Any, server: LiveServer) -> None:
    with uwsim.load("currents-scene") as simulation:
        camera = simulation.world.model.scene.camera
        page = shown(browser, server, simulation)
    assert camera is not None
    sight = "uwsim.page.views.viewCamera(800, 600)"
    orbit = page.evaluate(f"Array.from({sight}.worldFromCamera)")
    page.keyboard.press("p")
    eye = page.evaluate(f"Array.from({sight}.worldFromCamera)")
    assert [eye[3], eye[7], eye[11]] == pytest.approx(camera.position, abs=1e-6)
    intrinsics = page.evaluate(f"{sight}.intrinsics")
    wanted = 2 * math.degrees(math.atan(intrinsics["height"] / 2 / intrinsics["fy"]))
    assert wanted == pytest.approx(camera.fov)
    page.evaluate("uwsim.page.views.drag(0.1, 0.1, false)")
    page.keyboard.press("Shift+O")
    assert page.evaluate(f"Array.from({sight}.worldFromCamera)") == pytest.approx(orbit)
    page.context.close()
