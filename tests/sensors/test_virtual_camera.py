"""The pinhole of a camera, from a field of view or from a calibration."""

from __future__ import annotations

import numpy as np
import pytest

from uwsim.sensors import SENSORS
from uwsim.sensors.virtual_camera import CameraParametersSpec, VirtualCamera, VirtualCameraSpec

PARAMETERS = CameraParametersSpec(fx=250.0, fy=260.0, x0=150.0, y0=100.0, f=10.0, n=0.5, k=2.0)


def test_a_field_of_view_of_50_degrees_is_the_originals_pinhole() -> None:
    pinhole = VirtualCameraSpec(name="c", relative_to="l", resw=320, resh=240).intrinsics()
    assert pinhole.fx == pinhole.fy == pytest.approx(257.34083, abs=1e-5)
    assert (pinhole.cx, pinhole.cy, pinhole.near, pinhole.far) == (160, 120, 0.18, 2000)


def test_parameters_override_the_field_of_view() -> None:
    camera = VirtualCameraSpec(name="c", relative_to="l", resw=320, resh=240, parameters=PARAMETERS)
    pinhole = camera.intrinsics()
    assert (pinhole.fx, pinhole.fy, pinhole.skew) == (250, 260, 2)
    assert (pinhole.cx, pinhole.cy) == (150, 100)
    assert (pinhole.near, pinhole.far) == (0.5, 10)


def test_y0_counts_from_the_bottom_only_when_asked() -> None:
    camera = VirtualCameraSpec(name="c", relative_to="l", resw=320, resh=240, parameters=PARAMETERS)
    ahead = np.array([[0.0, 0.0, -1.0]])
    assert camera.intrinsics().project(ahead)[0, 1] == 100
    assert camera.intrinsics(frozenset({"y0"})).project(ahead)[0, 1] == 140


def test_every_sensor_stands_on_a_link_and_knows_where() -> None:
    for spec in SENSORS.values():
        fields = spec.__dataclass_fields__
        assert {"name", "relative_to", "position", "orientation"} <= set(fields)


def test_camera_info_counts_from_the_first_pixels_centre_and_has_the_skew() -> None:
    """A pinhole of OpenCV's with this K puts a point where the camera draws it."""
    parameters = CameraParametersSpec(fx=200.0, fy=210.0, x0=150.0, y0=100.0, f=100, n=0.1, k=4.0)
    spec = VirtualCameraSpec(name="c", relative_to="l", resw=320, resh=240, parameters=parameters)
    camera = VirtualCamera.__new__(VirtualCamera)
    lens = spec.intrinsics(frozenset())
    camera._intrinsics, camera._published_cy, camera._baseline = lens, lens.cy, 0.0
    camera.frame_id = "c"
    matrix = camera.info(0.0).k.reshape(3, 3)
    point = np.array([0.3, -0.2, -2.0])  # x right, y up, z backwards
    u, v, w = matrix @ [point[0], -point[1], -point[2]]
    drawn = lens.project(point[None])[0]
    assert (matrix[0, 2], matrix[1, 2]) == (149.5, 99.5)
    assert [v / w, abs(matrix[0, 1])] == pytest.approx([drawn[1] - 0.5, 4.0])
    assert u / w == pytest.approx(drawn[0] - 0.5)
