"""The pinhole of a camera, from a field of view or from a calibration."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from uwsim.sensors import SENSORS
from uwsim.sensors.virtual_camera import CameraParametersSpec, VirtualCamera, VirtualCameraSpec

PARAMETERS = CameraParametersSpec(fx=250.0, fy=260.0, x0=150.0, y0=100.0, f=10.0, n=0.5, k=2.0)


def test_a_field_of_view_of_50_degrees_is_the_originals_pinhole() -> None:
    pinhole = VirtualCameraSpec(name="c", relative_to="l", resw=320, resh=240).intrinsics()
    assert pinhole.fx == pinhole.fy == pytest.approx(257.34083, abs=1e-5)
    assert (pinhole.cx, pinhole.cy, pinhole.near, pinhole.far) == (159.5, 119.5, 0.18, 2000)


def test_parameters_override_the_field_of_view() -> None:
    camera = VirtualCameraSpec(name="c", relative_to="l", resw=320, resh=240, parameters=PARAMETERS)
    pinhole = camera.intrinsics()
    assert (pinhole.fx, pinhole.fy, pinhole.skew) == (250, 260, 2)
    assert (pinhole.cx, pinhole.cy) == (150, 100)
    assert (pinhole.near, pinhole.far) == (0.5, 10)


def test_x0_and_y0_count_from_the_left_and_the_bottom_edge_only_when_asked() -> None:
    camera = VirtualCameraSpec(name="c", relative_to="l", resw=320, resh=240, parameters=PARAMETERS)
    ahead = np.array([[0.0, 0.0, -1.0]])
    assert camera.intrinsics().project(ahead)[0].tolist() == [150, 100]
    assert camera.intrinsics(frozenset({"y0"})).project(ahead)[0].tolist() == [149.5, 139.5]


def test_every_sensor_stands_on_a_link_and_knows_where() -> None:
    for spec in SENSORS.values():
        fields = spec.__dataclass_fields__
        assert {"name", "relative_to", "position", "orientation"} <= set(fields)


def bound(spec: VirtualCameraSpec, *quirks: str) -> VirtualCamera:
    world = SimpleNamespace(compatibility=frozenset(quirks))
    return VirtualCamera(spec, None, world, None)  # type: ignore[arg-type]


def test_camera_info_counts_from_the_first_pixels_centre_and_has_the_skew() -> None:
    """A pinhole of OpenCV's with this K puts a point where the camera draws it."""
    parameters = CameraParametersSpec(fx=200.0, fy=210.0, x0=150.0, y0=100.0, f=100, n=0.1, k=4.0)
    spec = VirtualCameraSpec(name="c", relative_to="l", resw=320, resh=240, parameters=parameters)
    camera = bound(spec)
    lens = camera.intrinsics
    matrix = camera.info(0.0).k.reshape(3, 3)
    point = np.array([0.3, -0.2, -2.0])  # x right, y up, z backwards
    u, v, w = matrix @ [point[0], -point[1], -point[2]]
    drawn = lens.project(point[None])[0]
    assert [u / w, v / w] == pytest.approx(drawn.tolist())
    assert (matrix[0, 1], matrix[0, 2], matrix[1, 2]) == (-4.0, 150.0, 100.0)


def test_camera_info_of_a_field_of_view_has_its_centre_between_the_middle_pixels() -> None:
    matrix = bound(VirtualCameraSpec(name="c", relative_to="l", resw=320, resh=240)).info(0.0).k
    assert (matrix[2], matrix[5]) == (159.5, 119.5)


def test_camera_info_repeats_the_principal_point_of_the_file_as_the_originals_does() -> None:
    spec = VirtualCameraSpec(name="c", relative_to="l", resw=320, resh=240, parameters=PARAMETERS)
    for quirks in ((), ("y0",)):
        matrix = bound(spec, *quirks).info(0.0).k
        assert (matrix[2], matrix[5]) == (150.0, 100.0)
