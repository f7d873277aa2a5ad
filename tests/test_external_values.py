"""Numbers, positions and orientations from outside."""

from __future__ import annotations

import math

import numpy as np
import pytest

from uwsim.base.external_values import read_number, read_pose, read_position, read_quaternion
from uwsim.base.geometry import rotation_about
from uwsim.errors import BadMessage, BadSetting
from uwsim.messages import ColorRGBA, Float32MultiArray, Point, Pose, Quaternion, Vector3
from uwsim.middleware.json_encoding import from_json
from uwsim.viewer.live.clock import Clock
from uwsim.viewer.live.mapping import PilotMapping
from uwsim.viewer.live.view import _parse_view
from uwsim.viewer.live.viewer_requests import _width_of

HUGE = 10**400


@pytest.mark.parametrize("value", [HUGE, -HUGE, math.nan, math.inf, True, None, "1", [1.0], {}])
def test_what_is_no_finite_number_is_none(value: object) -> None:
    assert read_number(value) is None


@pytest.mark.parametrize(("value", "number"), [(3, 3.0), (-0.5, -0.5), (1e308, 1e308)])
def test_a_finite_number_is_a_float(value: float, number: float) -> None:
    assert read_number(value) == number


@pytest.mark.parametrize("size", [5e-324, 1e-200, 1e-162, 1e-3, 1.0, 1e154, 1e200, 1.79e308])
def test_the_length_of_a_quaternion_does_not_matter(size: float) -> None:
    pose = read_pose(Pose(Point(1.0, 2.0, 3.0), Quaternion(x=0.0, y=0.0, z=size, w=size)))
    assert pose is not None
    assert np.allclose(pose.rotation, rotation_about(np.array([0.0, 0.0, 1.0]), math.pi / 2))


@pytest.mark.parametrize("wxyz", [(0, 0, 0, 0), (math.nan, 0, 0, 1), (1, math.inf, 0, 0)])
def test_an_invalid_quaternion_is_none(wxyz: tuple[float, float, float, float]) -> None:
    w, x, y, z = map(float, wxyz)
    assert read_quaternion(Quaternion(x, y, z, w)) is None


@pytest.mark.parametrize("value", [math.nan, math.inf, 1.1e6, -1e308])
def test_a_position_far_away_is_none(value: float) -> None:
    for axis in "xyz":
        assert read_position(Point(**{axis: value})) is None


@pytest.mark.parametrize(
    ("cls", "values"),
    [
        (Vector3, {"x": HUGE}),
        (ColorRGBA, {"r": 1e300}),
        (ColorRGBA, {"a": -HUGE}),
        (Float32MultiArray, {"data": [1.0, 1e300]}),
        (Float32MultiArray, {"data": [HUGE]}),
    ],
)
@pytest.mark.filterwarnings("error")
def test_a_number_beyond_the_range_of_its_field_is_refused(
    cls: type, values: dict[str, object]
) -> None:
    with pytest.raises(BadMessage, match="expected"):
        from_json(cls, values)


def test_numbers_of_a_viewer_beyond_all_bounds_do_nothing() -> None:
    assert set(PilotMapping().values({"axes": [HUGE, 1e308], "sticks": [-HUGE]})) <= {
        -1.0,
        0.0,
        1.0,
    }
    assert _width_of({"type": "images", "width": HUGE}) == _width_of({"type": "images"})
    clock = Clock(1.0)
    assert not clock.apply_control({"action": "speed", "speed": HUGE})
    assert clock.real_time_factor == 1.0
    view = {"pose": [HUGE, 0, 0, 1, 0, 0, 0], "width": 320, "height": 240}
    with pytest.raises(BadSetting, match="finite"):
        _parse_view({"type": "view", **view})
