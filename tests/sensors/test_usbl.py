"""The USBL: exact positions without noise, noise of its size, lost replies, unknown beacons."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.sensors.acoustic_world import AcousticWorld, FakeCarrier
from tests.support.fakes import FakeBody
from uwsim.base.geometry import Pose, rotation_z
from uwsim.checks import check_file
from uwsim.sensors.usbl import Usbl, UsblSpec

BEACON = (30.0, 40.0, -12.0)  # in W [m]


class BeaconWorld(AcousticWorld):
    """A world with one body, turned by half a turn, which carries the beacon."""

    def body(self, name: str) -> FakeBody:
        assert name == "dock"
        return FakeBody((30.0, 40.5, -12.0), rotation=rotation_z(math.pi))


def make(**fields: float) -> Usbl:
    """Return a transceiver at (0, 0, 1) of a vehicle in the origin, with its bow to the north."""
    spec = UsblSpec(
        name="usbl", relative_to="base", position=(0.0, 0.0, 1.0), beacon="dock",
        beacon_position=(0.0, 0.5, 0.0), **fields,
    )  # fmt: skip
    carrier = FakeCarrier(Pose(np.zeros(3), rotation_z(math.pi / 2)))
    return spec.bind(BeaconWorld(), carrier)  # type: ignore[arg-type]


def replies(sensor: Usbl, n: int) -> np.ndarray:
    points = [message.point for _ in range(n) if (message := sensor.sample(0.0)) is not None]
    return np.array([(point.x, point.y, point.z) for point in points])


def test_without_noise_it_measures_the_beacon_in_its_own_axes() -> None:
    # the bow points along W's y: x ahead is y of W, y to port is -x of W
    [position] = replies(make(), 1)
    assert position == pytest.approx([40.0, -30.0, -13.0], abs=1e-9)


def test_the_noise_of_distance_and_direction_has_its_size() -> None:
    """2000 replies: deviations within 6 %, which is 3.8 standard errors."""
    positions = replies(make(range_std=0.4, angle_std=0.01), 2000)
    truth = np.array([40.0, -30.0, -13.0])
    distance = np.sqrt(np.sum(truth * truth))
    lengths = np.sqrt(np.sum(positions**2, axis=1))
    assert lengths.mean() == pytest.approx(distance, abs=0.04)
    assert lengths.std() == pytest.approx(0.4, rel=0.06)
    cosines = positions @ truth / (lengths * distance)
    angles = np.arccos(np.minimum(cosines, 1.0))
    assert np.sqrt(np.mean(angles**2) / 2.0) == pytest.approx(0.01, rel=0.06)


def test_lost_replies_change_no_other_reply() -> None:
    reference, lossy = make(range_std=0.4), make(range_std=0.4, dropout=0.25)
    pairs = [(reference.sample(0.0), lossy.sample(0.0)) for _ in range(400)]
    pairs_received = [pair for pair in pairs if pair[1] is not None]
    assert len(pairs_received) == pytest.approx(300, abs=35)  # 4 standard errors
    assert all(first.point == second.point for first, second in pairs_received)  # type: ignore[union-attr]


def test_beyond_its_range_there_is_no_reply() -> None:
    assert make(range=51.0).sample(0.0) is None
    assert make(range=52.0).sample(0.0) is not None  # 51.7 m


def test_a_beacon_on_an_unknown_body_is_an_error(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    path.write_text(
        """<UWSimScene xmlns:u="urn:uwsim:1">
  <vehicle> <name>rov</name> <file>bluerov2_heavy.urdf</file>
    <u:usbl> <name>usbl</name> <relativeTo>base_link</relativeTo> <beacon>dok</beacon> </u:usbl>
  </vehicle>
  <object> <name>dock</name> <file>objects/box.osg</file> </object>
</UWSimScene>"""
    )
    messages = [str(item) for item in check_file(path)]
    assert any("'usbl'" in text and "'dok'" in text and "'dock'" in text for text in messages)
