"""Images of cameras in live views: in the size in which they are shown, and cheap to show."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
import pytest

import uwsim
from tests.viewer.live.desk import Desk
from tests.viewer.live.test_pilot_page import MAPPING, opened, server
from uwsim.errors import BadSetting
from uwsim.simulation.views import FIELD_OF_VIEW, view_from_pose
from uwsim.viewer.live.server import LiveServer
from uwsim.viewer.live.session import LiveSession
from uwsim.viewer.live.view import HEADER, IMAGE, _parse_view, encode_jpeg

__all__ = ["server"]
CAMERA = "bowtech1"
RED = (220, 30, 20)


def newest(desk: Desk) -> np.ndarray:
    """Return the newest image that was sent, BGR."""
    data = np.frombuffer(desk.on(f"?image/{CAMERA}")[-1], np.uint8, offset=HEADER.size)
    return cv2.imdecode(data, cv2.IMREAD_COLOR)


@pytest.mark.parametrize(
    ("said", "width"),
    [
        ([{"width": 200}], 200),
        ([{"width": 200}, {"width": 320.4}], 320),
        ([{"width": 200}, {}], 640),
        ([{"width": 1e9}], 640),
        ([{"width": -5}], 16),
        ([{"width": "wide"}, {"width": None}, {"width": True}], 640),
        ([{"width": float("nan")}], 640),
        ([], 640),
    ],
)
@pytest.mark.parametrize("is_read", [False, True])
def test_images_are_as_wide_as_the_widest_viewer_shows_them(
    said: list[dict[str, Any]], width: int, is_read: bool
) -> None:
    messages = [(number, {"type": "images", **each}) for number, each in enumerate(said)]
    desk, now = Desk(frozenset({f"?image/{CAMERA}"}), messages), [0.0]

    def wall() -> float:
        now[0] += 0.01  # one step in a few sends an image
        return now[0]

    session = LiveSession(desk, real_time_factor=0.0, wall=wall)  # type: ignore[arg-type]
    with uwsim.load("currents-scene") as simulation:
        if is_read:
            simulation.bus.inbox("/uwsim/camera1", uwsim.messages.Image)
        session.open(simulation, "scene")
        simulation.advance(0.2)
        assert newest(desk).shape == (round(0.75 * width), width, 3)
        whole = simulation.image(CAMERA).colour
        assert whole is not None
        seen = cv2.cvtColor(newest(desk), cv2.COLOR_BGR2RGB)
        small = cv2.resize(whole.view(np.uint8), seen.shape[1::-1], interpolation=cv2.INTER_AREA)
        assert np.abs(seen.astype(int) - small).mean() < 8.0  # JPEG, noise, edges


@pytest.mark.parametrize(
    ("said", "wanted"),
    [({"fovy": 0.5}, 0.5), ({}, FIELD_OF_VIEW), ({"fovy": 4.0}, None), ({"fovy": "wide"}, None)],
)
def test_a_view_without_webgl_has_the_field_of_the_page(
    said: dict[str, Any], wanted: float | None
) -> None:
    message = {"pose": [0, 0, 1, 1, 0, 0, 0], "width": 320, "height": 240, **said}
    if wanted is None:
        with pytest.raises(BadSetting):
            _parse_view(message)
    else:
        lens = view_from_pose(*_parse_view(message)).intrinsics
        assert 2.0 * np.arctan(120.0 / lens.fy) == pytest.approx(wanted)


WATCH = """() => {
    window.changes = 0
    const watch = new MutationObserver((all) => { window.changes += all.length })
    watch.observe(document.getElementById("pictures"), { childList: true, subtree: true,
        characterData: true, attributes: true })
}"""
PIXEL = """() => {
    const box = document.querySelector("#pictures figure").getBoundingClientRect()
    const overlay = document.getElementById("overlay"), at = overlay.getBoundingClientRect()
    const scale = overlay.width / at.width
    const [x, y] = [box.left + box.width / 2 - at.left, box.top + box.height / 2 - at.top]
    return [...overlay.getContext("2d").getImageData(x * scale, y * scale, 1, 1).data]
}"""


@pytest.mark.slow
def test_the_page_shows_images_without_being_put_together_again(
    browser: Any, server: LiveServer
) -> None:
    page = opened(browser, server, MAPPING, 768)
    for number, colour in enumerate((RED, (20, 30, 220), RED)):
        image = np.full((150, 200, 3), colour, np.uint8)
        server.publish(
            f"?image/{CAMERA}", HEADER.pack(IMAGE, 0, 0, number, 0.0) + encode_jpeg(image)
        )
        page.wait_for_function(
            f"({PIXEL})().every((c, i) => Math.abs(c - {[*colour, 255]}[i]) < 6)"
        )
        if number == 0:
            assert page.locator("#pictures figcaption").inner_text() == CAMERA
            page.evaluate(WATCH)
    assert page.evaluate("window.changes") == 0
    page.context.close()
