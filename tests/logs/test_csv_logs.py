"""Logs as CSV files and their mapping files: units, frames, and every mistake at once."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from uwsim.errors import UwsimError
from uwsim.logs import LogError, MappingError, read_log, read_mapping
from uwsim.logs.csv_columns import template_text
from uwsim.logs.frames import (
    convert_orientations,
    multiply_quaternions,
    quaternions_from_rpy,
    rotate_vectors,
)
from uwsim.logs.smoothing import estimate_twists
from uwsim.logs.vehicle_log import VehicleLog

MAPPING = """
vehicle = "rov"
[time]
column = "T"
unit = "ms"
[frames]
world = "enu"
body = "flu"
[motion]
position = ["e", "n", "up"]
rpy = ["roll", "pitch", "yaw"]
angle_unit = "deg"
velocity = ["ve", "vn", "vup"]
velocity_frame = "world"
angular_velocity = ["p", "q", "r"]
angular_velocity_unit = "deg/s"
[commands.thrusters]
columns = ["a", "b"]
names = ["port", "starboard"]
unit = "pwm"
signs = [1, -1]
delay = 0.5
[sensors.dvl]
kind = "dvl"
columns = ["du", "dv", "dw"]
names = ["u", "v", "w"]
units = ["cm/s", "cm/s", "cm/s"]
"""
TABLE = """T,e,n,up,roll,pitch,yaw,ve,vn,vup,p,q,r,a,b,du,dv,dw
1000,1,2,-3,10,0,90,0,0.5,0,1,2,3,1900,1300,50,10,20
2000,1,2.5,-3,10,0,90,0,0.5,0,1,2,3,,,,,
3000,1,3,-3,10,0,90,0,0.5,0,1,2,3,1500,1500,,,
"""


def read(tmp_path: Path, table: str, mapping: str | None = None) -> VehicleLog:
    path = tmp_path / "log.csv"
    path.write_text(table)
    if mapping is None:
        return read_log(path)
    (tmp_path / "map.toml").write_text(mapping)
    return read_log(path, mapping=tmp_path / "map.toml")


def test_a_mapping_converts_units_and_frames(tmp_path: Path) -> None:
    log = read(tmp_path, TABLE, MAPPING)
    assert (log.vehicle, log.start, log.duration) == ("rov", 1.0, 2.5)
    motion = log.motion
    assert motion is not None
    assert motion.twists is not None
    np.testing.assert_allclose(motion.positions[0], [2.0, 1.0, 3.0])  # north, east, down
    # yaw 90 degrees in east-north-up is north: no turn in north-east-down; the roll changes its
    # sign twice, once with each frame
    expected = quaternions_from_rpy(np.radians([[10.0, 0.0, 0.0]]))[0]
    np.testing.assert_allclose(np.abs(motion.quaternions[0]), np.abs(expected), atol=1e-12)
    np.testing.assert_allclose(motion.twists[0, :3], [0.5, 0.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(motion.twists[0, 3:], np.radians([1.0, -2.0, -3.0]))
    [commands] = log.commands
    assert commands.names == ("port", "starboard")
    np.testing.assert_allclose(commands.values, [[1.0, 0.5], [0.0, 0.0]])
    np.testing.assert_allclose(commands.times, [0.5, 2.5])
    sensor = log.sensors["dvl"]
    assert sensor.units == ("m/s", "m/s", "m/s")
    np.testing.assert_allclose(sensor.values, [[0.5, -0.1, -0.2]])


@pytest.mark.parametrize("yaw", [0.0, 0.7, math.pi / 2, -2.0])
def test_a_heading_of_ros_is_the_heading_of_a_compass(yaw: float) -> None:
    """Compare headings: that of ROS counts from east to north, that of L from north to east."""
    quaternion = convert_orientations(quaternions_from_rpy(np.array([[0, 0, yaw]])), "enu", "flu")
    north, east, down = rotate_vectors(quaternion, np.array([[1.0, 0.0, 0.0]]))[0]
    np.testing.assert_allclose([north, east, down], [math.sin(yaw), math.cos(yaw), 0], atol=1e-12)
    _, _, down = rotate_vectors(quaternion, np.array([[0.0, 0.0, 1.0]]))[0]
    assert down == pytest.approx(1.0)


def test_thruster_commands_beyond_their_range_are_remarked(tmp_path: Path) -> None:
    mapping = MAPPING.replace('unit = "pwm"\nsigns', 'unit = "1"\nsigns')
    remarks = read(tmp_path, TABLE, mapping).remarks
    assert (
        "commands.thrusters: 2 of 2 samples are beyond -1 to 1, up to 1900; is the unit right?"
        in remarks
    )
    assert not any("beyond" in remark for remark in read(tmp_path, TABLE, MAPPING).remarks)


def test_all_mistakes_of_a_table_are_reported_with_their_lines(tmp_path: Path) -> None:
    table = "time,x,y,z,qw,qx,qy,qz,thrusters.a\n0,1,2,3,1,0,0,0,0.5\n1,a,2,3,1,0,0,0\n"
    table += "2,1,2,inf,1,0,0,0,k\n"
    with pytest.raises(LogError) as error:
        read(tmp_path, table)
    lines = [(mistake.line, mistake.message) for mistake in error.value.diagnostics]
    assert lines == [
        (3, "8 fields; expected 9"),
        (4, "z is 'inf'; expected at most 1e+12"),
        (4, "thrusters.a is 'k'; expected a number"),
    ]


def test_all_mistakes_of_a_mapping_are_reported_with_their_lines(tmp_path: Path) -> None:
    path = tmp_path / "map.toml"
    path.write_text(
        '[tim]\ncolumn="a"\n[motion]\npositon=["a"]\nrpy=["a","b"]\nangle_unit="degs"\n'
        '[commands.thrusters]\ncolumns=["a","b"]\nsigns=[1]\n[sensors.x]\nkind="dv"\n'
        'columns=["a"]\nunits=["m/ss"]\n'
    )
    with pytest.raises(MappingError) as error:
        read_mapping(path)
    text = str(error.value)
    for part in (
        "map.toml:1: 'tim' is not a key of the file. Did you mean 'time'?",
        "map.toml:4: 'positon' is not a key of [motion]. Did you mean 'position'?",
        "map.toml:5: rpy of [motion] has 2 columns; expected 3",
        "map.toml:6: angle_unit: 'degs' is not a unit of angle. Did you mean 'deg'?",
        "map.toml:9: [commands.thrusters] has 2 columns, but 1 signs",
        "map.toml:11: kind is 'dv'. Did you mean 'dvl'?",
        "map.toml:13: 'm/ss' is not a unit. Did you mean 'm/s'?",
    ):
        assert part in text


def test_text_that_is_no_toml_is_an_error_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "map.toml"
    path.write_text("[time]\ncolumn = \n")
    with pytest.raises(MappingError, match=r"map\.toml:2: not TOML"):
        read_mapping(path)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[" * 100_000, r"map\.toml:1: not TOML: Invalid initial character"),
        ("[time]\nunit = " + "[" * 100_000, r"map\.toml: not TOML: lists or tables are nested"),
        ("\n[commands.wrench]\ndelay = " + "1" * 5000, r"map\.toml:3: a number has more than 4000"),
        (
            "[commands.wrench]\ncolumns = ['a']\ndelay = 0x" + "f" * 5000,
            r"map\.toml:3: delay of \[commands\.wrench\] is a number of thousands of digits",
        ),
        ("vehicle" + ".a" * 20_000 + " = 1", "vehicle of the file is a table of many levels"),
    ],
)
def test_hostile_toml_is_an_error_of_the_file(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "map.toml"
    path.write_text(text)
    with pytest.raises(MappingError, match=message) as error:
        read_mapping(path)
    assert len(str(error.value)) < 300


def test_a_name_twice_and_a_sign_of_zero_are_errors_of_a_mapping(tmp_path: Path) -> None:
    path = tmp_path / "map.toml"
    path.write_text(
        '[commands.thrusters]\ncolumns = ["a", "b"]\nnames = ["port", "port"]\nsigns = [1, 0]\n'
    )
    with pytest.raises(MappingError) as error:
        read_mapping(path)
    text = str(error.value)
    assert "map.toml:3: names of [commands.thrusters] has 'port' twice" in text
    assert "map.toml:4: signs of [commands.thrusters] has 0; expected -1 or 1" in text


def test_the_template_is_a_valid_mapping(tmp_path: Path) -> None:
    path = tmp_path / "map.toml"
    path.write_text(template_text(["Timestamp", "x"]))
    assert read_mapping(path).time.column == "Timestamp"


def test_a_column_that_the_table_lacks_has_a_suggestion(tmp_path: Path) -> None:
    mapping = MAPPING.replace('"e", "n"', '"east", "n"')
    with pytest.raises(LogError, match="no column is called 'east'"):
        read(tmp_path, TABLE, mapping)


def test_a_table_of_unknown_columns_names_the_template(tmp_path: Path) -> None:
    with pytest.raises(LogError, match="--write-mapping"):
        read(tmp_path, "a,b\n1,2\n")


def test_samples_out_of_order_are_sorted_and_reported(tmp_path: Path) -> None:
    rows = [f"{t},{t},0,0,1,0,0,0" for t in (0.0, 0.2, 0.1, 0.3, 0.3, 0.4)]
    log = read(tmp_path, "time,x,y,z,qw,qx,qy,qz\n" + "\n".join(rows) + "\n")
    assert log.motion is not None
    np.testing.assert_allclose(log.motion.times, [0.0, 0.1, 0.2, 0.3, 0.4])
    np.testing.assert_allclose(log.motion.positions[:, 0], log.motion.times)
    assert "motion: 1 sample out of order; sorted by time." in log.remarks
    assert any("with the time of another" in remark for remark in log.remarks)


def test_a_clock_that_was_set_back_is_an_error(tmp_path: Path) -> None:
    rows = [f"{t},0,0,0,1,0,0,0" for t in (0.0, 10.0, 2.0, 3.0)]
    with pytest.raises(LogError, match="goes back from 10 s to 2 s"):
        read(tmp_path, "time,x,y,z,qw,qx,qy,qz\n" + "\n".join(rows) + "\n")


def test_missing_twists_are_estimated_and_marked(tmp_path: Path) -> None:
    rows = [
        f"{t:.2f},{0.3 * t!r},{0.1 * t * t!r},0,{math.cos(0.1 * t)!r},0,0,{math.sin(0.1 * t)!r}"
        for t in np.arange(0.0, 4.0, 0.05).tolist()
    ]
    log = read(tmp_path, "time,x,y,z,qw,qx,qy,qz\n" + "\n".join(rows) + "\n")
    assert log.motion is not None
    assert log.motion.twists is not None
    assert log.motion.twist_source == "smoothed"
    assert any("Savitzky-Golay" in remark for remark in log.remarks)
    middle = slice(10, -10)
    np.testing.assert_allclose(log.motion.twists[middle, 5], 0.2, atol=1e-4)
    speeds = np.hypot(*log.motion.twists[middle, :2].T)
    times = log.motion.times[middle]
    np.testing.assert_allclose(speeds, np.hypot(0.3, 0.2 * times), atol=1e-6)


def test_the_smoother_is_exact_for_cubic_motion() -> None:
    """Check full windows, to whose samples a polynomial of order 3 fits exactly."""
    times = np.arange(0.0, 3.0, 0.02)
    positions = np.array([times**3 - times, 2.0 * times**2, 0.5 * times]).T
    quaternions = np.tile([1.0, 0.0, 0.0, 0.0], (len(times), 1))
    twists = estimate_twists(times, positions, quaternions)
    full_windows = slice(15, -15)
    expected = np.array([3.0 * times**2 - 1.0, 4.0 * times, 0.5 + 0.0 * times]).T
    np.testing.assert_allclose(twists[full_windows, :3], expected[full_windows], atol=1e-9)


def test_the_noise_of_the_smoother_is_that_of_its_formula() -> None:
    rng, half, interval = np.random.default_rng(0), 10, 0.025
    times = interval * np.arange(40_000)
    positions = 0.01 * rng.standard_normal((len(times), 3))
    quaternions = np.tile([1.0, 0.0, 0.0, 0.0], (len(times), 1))
    twists = estimate_twists(times, positions, quaternions)
    i = np.arange(-half, half + 1, dtype=float)
    s2, s4, s6 = ((i**power).sum() for power in (2, 4, 6))
    expected = 0.01 * math.sqrt(s6 / (s2 * s6 - s4**2)) / interval
    assert twists[:, 0].std() == pytest.approx(expected, rel=0.05)


def test_quaternions_multiply_as_rotations() -> None:
    rng = np.random.default_rng(1)
    a, b, v = rng.standard_normal((5, 4)), rng.standard_normal((5, 4)), rng.standard_normal((5, 3))
    a, b = (q / np.linalg.norm(q, axis=1)[:, None] for q in (a, b))
    product = rotate_vectors(multiply_quaternions(a, b), v)
    np.testing.assert_allclose(product, rotate_vectors(a, rotate_vectors(b, v)), atol=1e-12)


@pytest.mark.parametrize("name", ["log.txt", "log", "missing.csv"])
def test_a_file_of_no_known_format_is_an_error(name: str, tmp_path: Path) -> None:
    if name != "missing.csv":
        (tmp_path / name).write_text("x")
    with pytest.raises(UwsimError, match=r"is not a format|does not exist"):
        read_log(tmp_path / name)


BOAT = """
[motion]
position = ["x", "y", 0]
rpy = [0, 0, "heading"]
velocity = ["u", "v", 0]
angular_velocity = [0, 0, "r"]
[commands.thrusters]
columns = ["port", "starboard"]
"""
BOAT_TABLE = "time,x,y,heading,u,v,r,port,starboard\n" + "".join(
    f"{k},{0.5 * k},0,0.1,0.5,0,0,0.2,0.2\n" for k in range(5)
)


def test_a_number_in_place_of_a_column_is_a_constant(tmp_path: Path) -> None:
    motion = read(tmp_path, BOAT_TABLE, BOAT).motion
    assert motion is not None
    assert motion.twists is not None
    np.testing.assert_array_equal(motion.positions[:, 2], 0.0)
    np.testing.assert_array_equal(motion.twists[0], [0.5, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert motion.twist_source == "log"
    assert motion.is_planar


def test_a_log_with_a_depth_is_not_planar(tmp_path: Path) -> None:
    table = BOAT_TABLE.replace("heading", "heading,z").replace(",0.1,0.5", ",0.1,{k},0.5")
    lines = [line.replace("{k}", str(k)) for k, line in enumerate(table.splitlines())]
    motion = read(tmp_path, "\n".join(lines), BOAT.replace('"y", 0', '"y", "z"')).motion
    assert motion is not None
    assert not motion.is_planar


def test_columns_with_two_places_wrong_signs_and_delays_are_reported_at_once(
    tmp_path: Path,
) -> None:
    path = tmp_path / "map.toml"
    path.write_text(
        '[motion]\nposition = ["x", "x", "z"]\nrpy = [0, "z", true]\n'
        '[commands.thrusters]\ncolumns = ["a", "a"]\nnames = ["port", "port"]\nsigns = [5, -1]\n'
        "delay = -5\n"
        '[sensors.dvl]\nkind = "dvl"\ncolumns = ["z", "z"]\n'
    )
    with pytest.raises(MappingError) as error:
        read_mapping(path)
    lines = sorted(str(mistake).split("map.toml:")[1] for mistake in error.value.diagnostics)
    assert lines == [
        "11: columns of [sensors.dvl] has 'z' twice",
        "2: position of [motion] has 'x' twice",
        "3: rpy of [motion] is [0, 'z', True]; expected a list of texts, or numbers for constants",
        "5: columns of [commands.thrusters] has 'a' twice",
        "6: names of [commands.thrusters] has 'port' twice",
        "7: signs of [commands.thrusters] has 5; expected -1 or 1",
        "8: delay of [commands.thrusters] is -5; expected 0 to 10 s",
    ]


def make_track(**positions: str) -> str:
    """Return a log of 40 samples at 10 Hz along x, with some positions replaced."""
    rows = [f"{0.1 * k:.1f},{positions.get(f'x{k}', 0.1 * k)},0,5,1,0,0,0" for k in range(40)]
    return "time,x,y,z,qw,qx,qy,qz\n" + "\n".join(rows) + "\n"


def test_spikes_of_a_position_are_removed_with_their_lines(tmp_path: Path) -> None:
    log = read(tmp_path, make_track(x10="1e11", x20="-40", x21="60"))
    assert log.motion is not None
    assert len(log.motion.times) == 37
    assert np.abs(log.motion.positions).max() < 6.0
    assert any(
        "3 samples with a position beyond 1 m and 30 m/s" in remark
        and remark.endswith("removed: lines 12, 22, 23.")
        for remark in log.remarks
    )


def test_a_step_of_a_position_that_lasts_is_no_spike(tmp_path: Path) -> None:
    """Keep a correction of the navigation, which is a step."""
    log = read(tmp_path, make_track(**{f"x{k}": str(0.1 * k + 30.0) for k in range(20, 40)}))
    assert log.motion is not None
    assert len(log.motion.times) == 40


def test_a_coordinate_that_most_samples_lack_removes_none(tmp_path: Path) -> None:
    log = read(tmp_path, make_track(**{f"x{k}": "" for k in range(40) if k % 5}))
    assert log.motion is not None
    assert len(log.motion.times) == 40


def test_a_header_of_ten_million_columns_is_refused_before_the_file_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "wide.csv"
    path.write_text("a," * 10_000_000 + "\n")
    monkeypatch.setattr("uwsim.logs.csv_log.read_document", lambda *a, **k: pytest.fail("read"))
    with pytest.raises(LogError, match=r"wide\.csv:1: has more than 262144 bytes"):
        read_log(path)


def test_a_row_longer_than_any_row_can_be_is_an_error_with_its_line(tmp_path: Path) -> None:
    with pytest.raises(LogError, match=r"log\.csv:\d+: not CSV: a line has more than 262144"):
        read(tmp_path, make_track(x5="1" * 300_000))
