"""Imaging, scanning and side-scan sonars: messages, images, and what they keep."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.sensors.acoustic_world import AcousticWorld, FakeCarrier, box, plate, sphere
from uwsim.acoustics import MATERIALS
from uwsim.base.geometry import Pose
from uwsim.messages import ProjectedSonarImage, pixels_of
from uwsim.sensors.sonar.fan_image import FanImage
from uwsim.sensors.sonar.imaging_sonar import ImagingSonar, ImagingSonarSpec
from uwsim.sensors.sonar.message import amplitudes
from uwsim.sensors.sonar.scanning_sonar import ScanningSonarSpec
from uwsim.sensors.sonar.side_scan_sonar import SideScanSonarSpec

STEEL = [MATERIALS["steel"]]
SMALL = {"bins": 100, "rows": 32, "range": 10.0, "noise_level": 40.0}


def imaging(world: AcousticWorld, *, height: float = 0.0, **fields: float) -> ImagingSonar:
    spec = ImagingSonarSpec(
        name="fls", relative_to="base", beams=64, **{**SMALL, "beam_width": 2.0, **fields}  # type: ignore[arg-type]
    )  # fmt: skip
    pose = Pose(np.array([0.0, 0.0, height]), np.eye(3))
    return spec.bind(world, FakeCarrier(pose))  # type: ignore[arg-type]


def brightest(message: ProjectedSonarImage) -> tuple[int, int]:
    """Bin and beam of the strongest echo."""
    echoes = amplitudes(message)
    place = np.unravel_index(int(np.argmax(echoes)), echoes.shape)
    return int(place[0]), int(place[1])


def test_a_target_is_in_the_beam_and_the_bin_where_it_is() -> None:
    turn = math.radians(30.0)  # to port
    ball = sphere((6.0 * math.cos(turn), 6.0 * math.sin(turn), 0.0), 0.2, 24)
    message = imaging(AcousticWorld(ball, materials=STEEL)).sample(1.0)
    bin, beam = brightest(message)
    assert message.ranges[bin] == pytest.approx(5.8, abs=0.1)
    direction = message.beam_directions[beam]  # z ahead, x up, y to starboard
    assert math.atan2(-direction.y, direction.z) == pytest.approx(turn, abs=math.radians(1.5))
    assert direction.x == 0.0


def test_the_message_says_what_the_ping_was() -> None:
    message = imaging(AcousticWorld(plate(1.0, -1000.0))).sample(2.5)
    assert (message.header.frame_id, message.header.stamp.sec) == ("fls", 2)
    assert message.ping_info.frequency == 900e3
    assert message.ping_info.sound_speed == pytest.approx(1508.0, abs=1.0)  # 15 C, 35, 100 m
    assert len(message.ping_info.rx_beamwidths) == len(message.beam_directions) == 64
    assert message.ranges[0] == pytest.approx(0.5 + 0.5 * 0.095)
    assert (message.image.dtype, message.image.beam_count) == (8, 64)
    assert len(message.image.data) == 4 * 64 * 100


def test_two_runs_hear_the_same_bytes_and_another_seed_others() -> None:
    def heard(seed: int) -> list[bytes]:
        sonar = imaging(AcousticWorld(plate(50.0, -2.0), seed=seed))
        return [bytes(sonar.sample(0.0).image.data) for _ in range(2)]

    first = heard(1)
    assert first == heard(1)
    assert first[0] != first[1]
    assert first[0] != heard(2)[0]


def test_ahead_is_up_in_the_image_and_port_is_left() -> None:
    ball = sphere((4.0, 3.0, 0.0), 0.2, 24)
    sonar = imaging(AcousticWorld(ball, materials=STEEL))
    sonar.sample(0.0)
    pixels = pixels_of(sonar.image(0.0))
    height, width = pixels.shape
    row, column = np.argwhere(pixels == pixels.max()).mean(axis=0)
    pixel = 0.095
    assert height * pixel == pytest.approx(10.0, abs=0.2)
    assert width * pixel == pytest.approx(2.0 * 10.0 * math.sin(math.radians(45)), abs=0.2)
    assert (height - row) * pixel == pytest.approx(4.0, abs=0.3)
    assert (0.5 * width - column) * pixel == pytest.approx(3.0, abs=0.3)


def test_the_image_of_a_bottom_is_as_bright_far_away_as_its_target_strength() -> None:
    """Of the same wall at 3 and 6 m: spreading and absorption are compensated."""
    greys = []
    for x in (3.0, 6.0):
        wall = box((x, -0.5, -0.5), (x + 1.0, 0.5, 0.5))
        sonar = imaging(AcousticWorld(wall, materials=STEEL), speckle=False, image_floor=-40.0)
        sonar.sample(0.0)
        greys.append(int(pixels_of(sonar.image(0.0)).max()))
    per_level = 255.0 / 50.0
    # the cell of one bin and one beam is twice as wide at 6 m; the glint covers more of it
    assert greys[1] - greys[0] == pytest.approx(6.0 * per_level, abs=4.0 * per_level)


def test_a_fan_of_a_whole_turn_has_no_seam() -> None:
    azimuths = np.radians(np.arange(-180.0, 180.0, 10.0))
    image = FanImage(azimuths, np.arange(50) * 0.1 + 0.05)
    grey = np.full((50, len(azimuths)), 255, dtype=np.uint8)
    pixels = image.draw(grey)
    size = len(pixels)
    y, x = np.mgrid[:size, : pixels.shape[1]] - 0.5 * (size - 1)
    inside = np.hypot(x, y) < 0.5 * size - 1.0
    assert (pixels[inside] == 255).all()


def scanner(world: AcousticWorld, **fields: float) -> object:
    spec = ScanningSonarSpec(name="msis", relative_to="base", **{**SMALL, **fields})  # type: ignore[arg-type]
    return spec.bind(world, FakeCarrier())  # type: ignore[arg-type]


def angles(sonar: object, n: int) -> list[float]:
    """Azimuths of the next pings, positive to port [deg]."""
    found = []
    for _ in range(n):
        (way,) = sonar.sample(0.0).beam_directions  # type: ignore[attr-defined]
        found.append(round(math.degrees(math.atan2(-way.y, way.z)), 6))
    return found


def test_a_scanning_sonar_turns_round_or_to_and_fro() -> None:
    empty = AcousticWorld(plate(1.0, -1000.0))
    round_ = scanner(empty, angle_incr=90.0)
    assert angles(round_, 5) == [-180.0, -90.0, 0.0, 90.0, -180.0]
    sector = scanner(empty, init_angle=-30.0, final_angle=30.0, angle_incr=30.0)
    assert angles(sector, 6) == [-30.0, 0.0, 30.0, 0.0, -30.0, 0.0]


def test_a_scan_shows_targets_all_round_after_a_turn() -> None:
    """One to port, one astern: both are in the image, where they are."""
    world = AcousticWorld(
        sphere((0.0, 5.0, 0.0), 0.3, 24), sphere((-7.0, 0.0, 0.0), 0.3, 24), materials=STEEL * 2
    )
    sonar = scanner(world, angle_incr=3.0, beam_width=3.0)
    angles(sonar, 120)
    pixels = pixels_of(sonar.image(0.0)).astype(float)  # type: ignore[attr-defined]
    size, middle = 0.095, 0.5 * np.array(pixels.shape)
    for ahead, port in ((0.0, 4.7), (-6.7, 0.0)):
        row, column = (middle - np.array([ahead, port]) / size).astype(int)
        assert pixels[row - 4 : row + 5, column - 4 : column + 5].max() > 200
    assert np.median(pixels) < 50


def side_scan(world: AcousticWorld, **fields: float) -> object:
    spec = SideScanSonarSpec(
        name="sss", relative_to="base", tilt=30.0,
        **{**SMALL, "rows": 64, "lines": 4, "range": 20.0, **fields},
    )  # type: ignore[arg-type]  # fmt: skip
    pose = Pose(np.array([0.0, 0.0, 4.0]), np.eye(3))
    return spec.bind(world, FakeCarrier(pose))  # type: ignore[arg-type]


def test_a_side_scan_hears_the_bottom_from_its_altitude_on_and_a_wreck_on_its_side() -> None:
    wreck = box((-1.0, 8.0, 0.0), (1.0, 8.5, 1.0))  # to port
    message = side_scan(AcousticWorld(plate(100.0, 0.0), wreck), speckle=0).sample(0.0)  # type: ignore[attr-defined]
    port, starboard = amplitudes(message).T
    silent = message.ranges < 4.0 - 0.2
    assert starboard[silent].max() < 0.01 * starboard.max()
    assert message.beam_directions[0].y < 0.0 < message.beam_directions[1].y
    front = np.abs(message.ranges - math.hypot(8.0, 3.5)) < 0.4
    behind = (message.ranges > math.hypot(8.6, 4.0) + 0.2) & (message.ranges < 10.8)
    assert port[front].max() > 3.0 * starboard[front].max()
    assert port[behind].max() < 0.05 * starboard[behind].min()


def test_the_newest_ping_is_at_the_top_of_the_waterfall_and_port_is_on_the_left() -> None:
    wreck = box((-1.0, 8.0, 0.0), (1.0, 8.5, 3.0))
    world = AcousticWorld(plate(100.0, 0.0), wreck)
    sonar = side_scan(world, speckle=0)
    for n in range(6):
        sonar.sample(0.1 * n)  # type: ignore[attr-defined]
        if n == 1:
            early = pixels_of(sonar.image(0.0))  # type: ignore[attr-defined]
            assert (early[2:] == 0).all()
            assert early[:2].any(axis=1).all()
    pixels = pixels_of(sonar.image(0.0))  # type: ignore[attr-defined]
    assert pixels.shape == (4, 200)
    column = int(np.argmax(pixels[0]))
    assert column == pytest.approx(100 - math.hypot(8.0, 3.0) / 0.195, abs=4)
