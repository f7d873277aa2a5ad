import numpy as np
import pytest

from uwsim.base.geometry import Pose
from uwsim.devices.sway import AXES, SwaySpec, displaced


def swayed(
    position: tuple[float, ...],
    orientation: tuple[float, ...],
    sways: tuple[SwaySpec, ...],
    time: float,
) -> Pose:
    offsets = [(AXES.index(sway.axis), sway.offset(time)) for sway in sways]
    return displaced(position, orientation, offsets)


def test_a_vehicle_sways_about_its_place_in_the_file() -> None:
    sways = (
        SwaySpec(axis="x", amplitude=0.1, period=7.0),
        SwaySpec(axis="yaw", amplitude=0.0873, period=11.0),
    )
    start = swayed((2.0, 0.0, 2.5), (0.0, 0.0, 0.0), sways, 0.0)
    assert start.position == pytest.approx([2.0, 0.0, 2.5])
    quarter = swayed((2.0, 0.0, 2.5), (0.0, 0.0, 0.0), sways, 1.75)
    assert quarter.position == pytest.approx([2.1, 0.0, 2.5])
    turned = swayed((2.0, 0.0, 2.5), (0.0, 0.0, 0.0), sways, 2.75)
    assert np.arctan2(turned.rotation[1, 0], turned.rotation[0, 0]) == pytest.approx(0.0873)


def test_two_sways_on_one_axis_add_up() -> None:
    sway = SwaySpec(axis="z", amplitude=0.2, period=4.0)
    pose = swayed((0.0, 0.0, 1.0), (0.0, 0.0, 0.0), (sway, sway), 1.0)
    assert pose.position[2] == pytest.approx(1.4)
