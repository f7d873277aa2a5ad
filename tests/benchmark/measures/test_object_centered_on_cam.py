"""How far from the middle of the image a body appears."""

from __future__ import annotations

import numpy as np
import pytest

from tests.support.fakes import FakeBody, FakeCamera, FakeWorld
from uwsim.benchmark.measures import ObjectCenteredOnCam, ObjectCenteredOnCamSpec

F = 120.0 / np.tan(np.radians(25.0))


def looking(body: FakeBody, value: str = "last", *quirks: str) -> ObjectCenteredOnCam:
    world = FakeWorld({"box": body}, {"cam": FakeCamera()}, compatibility=frozenset(quirks))
    spec = ObjectCenteredOnCamSpec(name="o", target="box", camera="cam", value=value)  # type: ignore[arg-type]
    return spec.bind(world)


def test_the_components_point_as_the_originals_do() -> None:
    centred = looking(FakeBody((0.03, 0.04, -1.0)))
    centred.start()
    assert centred.value == pytest.approx(0.05 * F)
    assert centred.log_values == pytest.approx((0.05 * F, -0.03 * F, -0.04 * F))


@pytest.mark.parametrize("place", [(5.0, 0.0, -1.0), (0.0, -5.0, -1.0), (0.0, 0.0, 1.0)])
def test_out_of_the_image_is_no_value_and_says_so(place: tuple[float, float, float]) -> None:
    body = FakeBody((0.0, 0.0, -1.0))
    centred = looking(body, "mean")
    assert centred.missing_reason == "it was never on"
    centred.start()
    assert (centred.value, centred.missing_reason) == (0.0, None)
    body.move(*place)
    centred.update()
    assert (centred.value, centred.missing_reason) == (None, "the target is not in the image")
    assert centred.details["visible"] == 0.5
    assert centred.log_values == (None, None, None)
    body.move(0.1, 0.0, -1.0)
    centred.update()
    assert centred.value == pytest.approx(0.05 * F)


@pytest.mark.parametrize(
    ("place", "off"),
    [
        ((5.0, 0.0, -1.0), (-5.0 * F, 0.0)),
        ((0.0, -5.0, -1.0), (0.0, 5.0 * F)),
        ((0.3, 0.4, 1.0), (0.3 * F, 0.4 * F)),  # behind the camera: seen upside down
    ],
)
def test_the_original_does_not_ask_whether_the_target_is_in_the_image(
    place: tuple[float, float, float], off: tuple[float, float]
) -> None:
    centred = looking(FakeBody(place), "last", "unseen")
    centred.start()
    assert centred.value == pytest.approx(float(np.hypot(*off)))
    assert centred.log_values[1:] == pytest.approx(off)
    assert centred.missing_reason is None
    assert looking(FakeBody(place)).value is None


def test_in_the_cameras_own_plane_there_is_nothing_to_see_for_the_original_either() -> None:
    centred = looking(FakeBody((1.0, 0.0, 0.0)), "last", "unseen")
    centred.start()
    assert (centred.value, centred.missing_reason) == (None, "the target is not in the image")
