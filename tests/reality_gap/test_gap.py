"""The reality gap of logs of an independent simulator, and of the simulator's own."""

from __future__ import annotations

import io
import json
import math
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rich.console import Console

from tests.logs.dataflash_files import FORMAT_OF_FORMATS, FORMATS, format_message, message
from tests.reality_gap.fossen import Rov, rotation_of, write_log
from uwsim.assets.bundled import scene_file
from uwsim.errors import BadSetting
from uwsim.logs import read_log, write_csv_log
from uwsim.physics.compile_scene import compile_scene
from uwsim.reality_gap import Gap, GapSettings, measure_gap
from uwsim.reality_gap.report import WRITTEN_FILES, print_gap, write_gap
from uwsim.reality_gap.sensor_residuals import SensorResidual, describe_offsets
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec

SCENE = Path(__file__).parent / "scene.xml"
NOISE = np.array([0.005] * 3 + [0.001] * 4 + [0.01] * 3 + [0.002] * 3)
"""The standard deviations of positions [m], quaternions, velocities [m/s] and rates [rad/s]."""


def weaken_bow_port(rov: Rov) -> None:
    rov.strength[1] = 0.8


def raise_yaw_drag(rov: Rov) -> None:
    rov.quadratic[5] *= 1.5


def raise_surge_added_mass(rov: Rov) -> None:
    rov.added_mass[0] *= 1.4


@pytest.fixture(scope="module")
def scene() -> SceneSpec:
    return read_scene(SCENE)


def measure(path: Path, scene: SceneSpec, **settings: object) -> Gap:
    values = {"n_windows": 40, "horizons": (1.0, 5.0), **settings}
    return measure_gap(read_log(path), compile_scene(scene), settings=GapSettings(**values))  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def true_log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_log(tmp_path_factory.mktemp("log") / "true.csv", Rov(), duration=24.0)


@pytest.mark.parametrize(
    ("change", "name", "factor"),
    [
        (raise_yaw_drag, "yaw drag", 1.5),
        pytest.param(raise_surge_added_mass, "surge added mass", 1.4, marks=pytest.mark.slow),
        pytest.param(weaken_bow_port, "thrust of bow_port", 0.8, marks=pytest.mark.slow),
    ],
)
def test_the_verdict_names_the_coefficient_that_is_wrong(
    change: Callable[[Rov], None], name: str, factor: float, scene: SceneSpec, tmp_path: Path
) -> None:
    rov = Rov()
    change(rov)
    path = write_log(tmp_path / "log.csv", rov, duration=42.0, noise=NOISE)
    gap = measure(path, scene)
    assert gap.attribution is not None
    cause = gap.attribution.causes[0]
    assert cause.coefficient.name == name
    assert cause.low is not None
    assert cause.high is not None
    assert cause.low - 0.03 < factor < cause.high + 0.03
    assert cause.factor == pytest.approx(factor, rel=0.05)
    assert f"{name}: {cause.factor:.3g} times its value" in gap.verdict
    assert "dominates" in gap.verdict


def test_the_simulation_follows_an_independent_integrator_of_the_same_equations(
    true_log: Path, scene: SceneSpec
) -> None:
    gap = measure(true_log, scene, has_attribution=False)
    first, second = gap.horizons
    assert first.distance.value < 1e-4
    assert second.distance.value < 2e-3
    assert all(axis.rms.value < np.radians(0.5) for axis in second.axes[3:])
    assert gap.verdict.startswith("The simulation follows the log")


def test_a_log_of_the_simulator_itself_has_no_gap(true_log: Path, scene: SceneSpec) -> None:
    import uwsim
    from uwsim.logs import CommandSeries, MotionSeries, VehicleLog

    log = read_log(true_log)
    [commands] = log.commands
    rows, times = [], []
    with uwsim.load(SCENE) as simulation:
        vehicle = simulation.world.vehicles.find("bluerov2")
        for time, values in zip(commands.times[:120], commands.values[:120], strict=True):
            vehicle.autopilot.set_thrusters(values)  # type: ignore[union-attr]
            for k in range(5):
                pose = simulation.pose("bluerov2")
                state = [pose.position, pose.quaternion, simulation.velocity("bluerov2")]
                rows.append(np.concatenate(state))
                times.append(time + 0.02 * k)
                simulation.advance(0.02)
    table = np.array(rows)
    own_log = VehicleLog(
        path="own.csv",
        format="csv",
        sha256="",
        vehicle="bluerov2",
        motion=MotionSeries(
            times=np.array(times),
            positions=table[:, :3],
            quaternions=table[:, 3:7],
            twists=table[:, 7:],
        ),
        commands=(
            CommandSeries(
                kind="thrusters",
                names=commands.names,
                times=commands.times[:120],
                values=commands.values[:120],
            ),
        ),
    )
    gap = measure_gap(
        own_log, compile_scene(scene), settings=GapSettings(n_windows=8, horizons=(1.0, 5.0))
    )
    assert gap.horizons[1].distance.value < 1e-6
    assert gap.attribution is not None
    assert gap.attribution.causes == ()


def test_the_same_log_gives_the_same_bytes(
    true_log: Path, scene: SceneSpec, tmp_path: Path
) -> None:
    gap = measure(true_log, scene, n_windows=6)
    write_gap(gap, tmp_path / "a")
    write_gap(measure(true_log, scene, n_windows=6), tmp_path / "b")
    files = sorted(path.relative_to(tmp_path / "a") for path in (tmp_path / "a").rglob("*.*"))
    assert all(WRITTEN_FILES.fullmatch(str(path)) for path in files)
    for path in files:
        assert (tmp_path / "a" / path).read_bytes() == (tmp_path / "b" / path).read_bytes()
    document = json.loads((tmp_path / "a" / "gap.json").read_text())
    assert document["horizons"][0]["n_windows"] == 6
    with pytest.raises(BadSetting):
        write_gap(gap, tmp_path / "a")


def test_names_of_thrusters_that_the_vehicle_lacks_are_errors(
    true_log: Path, scene: SceneSpec, tmp_path: Path
) -> None:
    path = tmp_path / "log.csv"
    path.write_text(true_log.read_text().replace("thrusters.bow_port", "thrusters.bow_prot"))
    with pytest.raises(BadSetting, match=r"bow_prot.*Did you mean 'bow_port'"):
        measure(path, scene)


def test_a_log_without_commands_is_an_error(
    true_log: Path, scene: SceneSpec, tmp_path: Path
) -> None:
    path = tmp_path / "log.csv"
    path.write_text(true_log.read_text().replace("thrusters.", "t_"))
    with pytest.raises(BadSetting, match="has no commands"):
        measure(path, scene)


def test_a_log_of_few_poses_without_twists_is_an_error(
    true_log: Path, scene: SceneSpec, tmp_path: Path
) -> None:
    lines = [line.split(",") for line in true_log.read_text().splitlines()]
    rows = [lines[0], *lines[1::250]]
    path = tmp_path / "log.csv"
    path.write_text("\n".join(",".join([*row[:8], *row[14:]]) for row in rows) + "\n")
    with pytest.raises(BadSetting, match="too few poses"):
        measure(path, scene)


def test_no_window_spans_a_gap_of_the_log(true_log: Path, scene: SceneSpec, tmp_path: Path) -> None:
    lines = true_log.read_text().splitlines(keepends=True)
    kept_lines = [line for line in lines[1:] if not 8.0 < float(line.split(",")[0]) < 10.0]
    path = tmp_path / "log.csv"
    path.write_text("".join([lines[0], *kept_lines]))
    gap = measure(path, scene, has_attribution=False)
    starts = gap.windows.starts
    assert not ((starts > 7.0 + 1e-6) & (starts < 10.0 - 1e-6)).any()
    assert any("no sample from 8.00 s to 10.00 s" in remark for remark in gap.remarks)


@pytest.mark.parametrize(
    ("text", "remark"),
    [
        ("nan", "without all coordinates of the position; removed: line {line}."),
        ("1e11", "from the median of 7 samples; removed: line {line}."),
    ],
)
def test_a_position_that_is_wrong_is_removed_with_its_line(
    text: str, remark: str, true_log: Path, scene: SceneSpec, tmp_path: Path
) -> None:
    lines = true_log.read_text().splitlines()
    row = next(i for i, line in enumerate(lines[1:], 1) if float(line.split(",")[0]) > 8.0)
    cells = lines[row].split(",")
    cells[lines[0].split(",").index("y")] = text
    lines[row] = ",".join(cells)
    path = tmp_path / "log.csv"
    path.write_text("\n".join(lines) + "\n")
    gap = measure(path, scene, has_attribution=False)
    assert any(remark.format(line=row + 1) in text for text in gap.remarks)
    assert gap.windows.n_left_out == 0
    assert all(error.distance.value < 0.005 for error in gap.horizons)


def test_the_tables_of_the_terminal_have_units(true_log: Path, scene: SceneSpec) -> None:
    gap = measure(true_log, scene, has_attribution=False)
    text = io.StringIO()
    print_gap(gap, Console(file=text, width=120))
    assert "surge [m]" in text.getvalue()
    assert "yaw [°]" in text.getvalue()


def test_a_log_survives_writing_and_reading(true_log: Path, tmp_path: Path) -> None:
    log = read_log(true_log)
    path = tmp_path / "again.csv"
    path.write_text(write_csv_log(log))
    copied_log = read_log(path)
    assert log.motion is not None
    assert copied_log.motion is not None
    assert (copied_log.motion.twists == log.motion.twists).all()  # type: ignore[union-attr]
    assert (copied_log.commands[0].values == log.commands[0].values).all()


@pytest.mark.parametrize("horizons", [(), (5.0, 1.0), (0.001,), (1.0, float("inf"))])
def test_invalid_horizons_are_errors(horizons: tuple[float, ...]) -> None:
    with pytest.raises(BadSetting, match="horizons"):
        GapSettings(horizons=horizons)


def write_dataflash(path: Path, csv_log: Path) -> Path:
    """Write a log as ArduSub of the frame vectored_6dof would; its motors 1 and 2 push back."""
    log = read_log(csv_log)
    motion, [commands] = log.motion, log.commands
    assert motion is not None
    assert motion.twists is not None
    entries = []
    for index in range(0, len(motion.times), 5):
        time = round(1e6 * motion.times[index]) + 5_000_000
        rotation, twist = rotation_of(motion.quaternions[index]), motion.twists[index]
        angles = (
            math.atan2(rotation[2, 1], rotation[2, 2]),
            -math.asin(rotation[2, 0]),
            math.atan2(rotation[1, 0], rotation[0, 0]) % (2 * math.pi),
        )
        roll, pitch, yaw = (round(100 * math.degrees(angle)) for angle in angles)
        velocity = rotation @ twist[:3]
        position = motion.positions[index] - [0.0, 0.0, 17.5]
        entries.append((time, message("RATE", time, *np.degrees(twist[3:]))))
        numbers = (*velocity, 0.0, *position)
        entries.append((time, message("XKF1", time, 0, roll, pitch, yaw % 36000, *numbers)))
    signs = np.array([-1, -1, 1, 1, 1, 1, 1, 1])
    step = round(0.1 / float(np.median(np.diff(commands.times))))  # ArduSub logs 10 in a second
    for time, values in zip(commands.times[::step].tolist(), commands.values[::step], strict=True):
        stamp = round(1e6 * time) + 5_000_000
        pulses = [round(1500 + 400 * value) for value in (signs * values).tolist()]
        entries.append((stamp, message("RCOU", stamp, *pulses)))
    parts = [FORMAT_OF_FORMATS, *map(format_message, FORMATS)]
    for motor in range(8):
        name = f"SERVO{motor + 1}_FUNCTION".encode()
        parts.append(message("PARM", 0, name, 33.0 + motor))
    parts += [data for _, data in sorted(entries, key=lambda entry: entry[0])]
    path.write_bytes(b"".join(parts))
    return path


def test_the_motors_of_an_autopilots_log_drive_the_thrusters_of_the_scene(tmp_path: Path) -> None:
    scene = read_scene(scene_file("bluerov2-scene", ()))
    log = write_log(tmp_path / "dive.csv", Rov(), duration=24.0, command_rate=100.0)
    path = write_dataflash(tmp_path / "dive.bin", log)
    gap = measure(path, scene, n_windows=10, has_attribution=False)
    assert gap.horizons[0].distance.value < 0.02  # angles of 0.01 degrees, pulses of 1 us
    assert gap.horizons[1].distance.value < 0.1
    [commands] = read_log(path).commands
    assert commands.interval == pytest.approx(0.1)
    assert np.diff(commands.times).max() < 0.021


def test_a_log_of_outputs_at_10_hz_does_not_measure_the_lag_of_the_thrusters(
    tmp_path: Path,
) -> None:
    scene = read_scene(scene_file("bluerov2-scene", ()))
    log = write_log(tmp_path / "dive.csv", Rov(), duration=24.0, command_rate=100.0)
    gap = measure(write_dataflash(tmp_path / "dive.bin", log), scene, horizons=(1.0,))
    assert gap.attribution is not None
    assert "thruster_lag" not in [row.coefficient.key for row in gap.attribution.shares]
    assert any("commands at 10 Hz" in remark for remark in gap.remarks)
    assert gap.attribution.evident_cause is None
    assert "no coefficient" in gap.verdict or "follows" in gap.verdict


def shift_stamps(path: Path, shift: float) -> None:
    """Shift the stamps of the commands of a log, as another clock does."""
    lines = [line.split(",") for line in path.read_text().splitlines()]
    header, rows = lines[0], []
    for row in lines[1:]:
        rows.append([*row[:14], *[""] * 8])
        if row[14]:
            rows.append([f"{float(row[0]) + shift:.3f}", *[""] * 13, *row[14:]])
    rows.sort(key=lambda row: float(row[0]))
    path.write_text("\n".join(",".join(row) for row in [header, *rows]) + "\n")


def test_a_late_clock_of_the_commands_is_named_and_no_coefficient(
    scene: SceneSpec, tmp_path: Path
) -> None:
    path = write_log(tmp_path / "log.csv", Rov(), duration=42.0, noise=NOISE)
    shift_stamps(path, 0.15)
    gap = measure(path, scene, horizons=(1.0,))
    assert gap.attribution is not None
    cause = gap.attribution.evident_cause
    assert cause is not None
    assert cause.coefficient.is_clock
    assert cause.shift == pytest.approx(-0.15, abs=0.02)
    assert re.search(r"the clock of the commands is 0\.1\d+ s \(.*\) late", gap.verdict)


def test_a_log_below_the_floor_of_the_scene_is_said_before_the_first_window(
    true_log: Path,
) -> None:
    scene = read_scene(scene_file("bluerov2-scene", ()))
    with pytest.raises(BadSetting, match=r"The log is below '\w+' of the scene.*Set origin"):
        measure(true_log, scene, has_attribution=False)


def test_a_log_of_a_surface_craft_has_a_planar_gap(scene: SceneSpec, tmp_path: Path) -> None:
    true_log = write_log(tmp_path / "planar.csv", Rov(is_planar=True), duration=24.0)
    mapping = tmp_path / "map.toml"
    names = [name for name in true_log.read_text().split("\n", 1)[0].split(",") if "thr" in name]
    thrusters = [name.split(".")[1] for name in names]
    mapping.write_text(
        '[motion]\nposition = ["x", "y", 20]\nrpy = [0, 0, "heading"]\n'
        'velocity = ["u", "v", 0]\nangular_velocity = [0, 0, "r"]\n'
        f"[commands.thrusters]\ncolumns = {names}\nnames = {thrusters}\n"
    )
    header, *lines = true_log.read_text().splitlines()
    rows = [line.split(",") for line in lines]
    yaws = [2.0 * math.atan2(float(row[7]), float(row[4])) for row in rows]
    path = tmp_path / "boat.csv"
    table = [f"{line},{yaw}" for line, yaw in zip(lines, yaws, strict=True)]
    path.write_text("\n".join([f"{header},heading", *table]) + "\n")
    gap = measure_gap(
        read_log(path, mapping=mapping),
        compile_scene(scene),
        settings=GapSettings(n_windows=4, horizons=(1.0,), has_attribution=False),
    )
    assert gap.is_planar
    [error] = gap.horizons
    assert [error.axes[index].rms.value for index in (2, 3, 4)] == pytest.approx(
        [0, 0, 0], abs=1e-9
    )
    assert max(error.axes[index].rms.value for index in (0, 1)) < 0.002
    assert error.axes[5].rms.value < 0.2  # degrees
    assert any("surge, sway and yaw" in remark for remark in gap.remarks)
    text = io.StringIO()
    print_gap(gap, Console(file=text, width=120))
    assert "surge [m]" in text.getvalue()
    assert "heave" not in text.getvalue()


def test_a_vehicle_of_the_mapping_that_the_scene_lacks_is_an_error_with_its_line(
    true_log: Path, scene: SceneSpec, tmp_path: Path
) -> None:
    from uwsim.logs.csv_columns import derive_mapping

    header = true_log.read_text().split("\n", 1)[0].split(",")
    mapping = replace(derive_mapping(header), path="dive.toml", vehicle="bluerov", vehicle_line=1)
    log = read_log(true_log, mapping=mapping)
    with pytest.raises(BadSetting, match=r"dive\.toml:1: the scene has no vehicle 'bluerov'"):
        measure_gap(log, compile_scene(scene))


def test_a_constant_residual_of_a_range_is_another_origin() -> None:
    def make(bias: float, rms: float) -> SensorResidual:
        return SensorResidual(
            sensor="range",
            topic="/range",
            quantity="range",
            unit="m",
            n_readings=100,
            rms=rms,
            bias=bias,
            measured_deviation=0.2,
        )

    [remark] = describe_offsets([make(0.265, 0.276)])
    assert "the log's depth lies 0.27 m above that of the scene" in remark
    assert "Add 0.27 to z of origin" in remark or "Add 0.26 to z of origin" in remark
    assert describe_offsets([make(0.1, 0.276), make(0.01, 0.01)]) == []
