"""A file of every kind that the original ships, played by the public command and scored by hand."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from uwsim.assets.bundled import bundled_files
from uwsim.benchmark.reader import read_benchmark
from uwsim.benchmark.updaters import n_levels
from uwsim.cli import main
from uwsim.results.result import Result
from uwsim.results.result_file import load
from uwsim.scene.reader import read_scene

FILES = Path(__file__).parents[2] / "benchmark" / "files"
TWIST = "<ROSTwistToPAT><topic>/twist</topic><vehicleName>girona500</vehicleName></ROSTwistToPAT>"
# Of the scene `visibility`, in L: the vehicle stands at (2, 0, 2.515). Its camera looks down from
# (2.2, -0.1, 3.465), its right is y and its up is x; the origin of the box is at (2, 0.35, 4.735).
RIGHT, UP, DEPTH = 0.45, -0.2, 1.27  # of the box's origin, from the camera [m]
FOCAL = 120.0 / math.tan(math.radians(25.0))  # [px]
CENTROID = (159.5 + FOCAL * RIGHT / DEPTH, 119.5 - FOCAL * UP / DEPTH)  # (u, v) [px]
OFF_CENTRE = FOCAL * math.hypot(RIGHT, UP) / DEPTH  # [px]


@dataclass(frozen=True)
class Played:
    """What a run of ``uwsim bench`` left."""

    folder: Path
    result: Result

    def dat(self) -> list[str]:
        return (self.folder / "result.dat").read_text().split("\n")

    def data(self, measure: str) -> list[str]:
        return (self.folder / f"benchmark-{measure}.data").read_text().split("\n")


def play(
    tmp_path: Path, name: str, *words: str, interval: float | None = None, scene: str = "drivable"
) -> Played:
    """Play a file, with other intervals if asked, and the scripted algorithm."""
    text = (FILES / f"{name}.xml").read_text()
    if interval is not None:
        spec = read_benchmark(FILES / f"{name}.xml")
        for length in {spec.scene_updater.seconds_per_level, 5.0}:
            text = text.replace(f"<interval>{length:g}<", f"<interval>{interval}<")
    file, out = tmp_path / f"{name}.xml", tmp_path / "out"
    file.write_text(text)
    if scene == "drivable":
        plain = bundled_files("scenes")["visibility-scene"].read_text()
        path = tmp_path / "scene.xml"
        path.write_text(plain.replace("</rosInterfaces>", f"{TWIST}</rosInterfaces>"))
        scene = str(path)
    status = main(
        ["bench", str(file), "--scene", scene,
         "--algorithm", "tests.support.scripted:ScriptedAlgorithm",
         "--set", f"algorithm.file={file}", "--out", str(out), *words]
    )  # fmt: skip
    assert status == 0
    return Played(out, load(out))


@pytest.mark.parametrize(
    ("name", "count"),
    [
        ("simple", 1), ("unending", 1), ("pipe-following", 1), ("vision", 27), ("vision-auto", 41),
        ("vision-recursive", 41), ("tracking-auto", 20), ("tracking-dynamics", 16),
        ("reconstruction", 21),
    ],
)  # fmt: skip
def test_a_file_has_as_many_levels_as_the_original_plays(name: str, count: int) -> None:
    assert n_levels(read_benchmark(FILES / f"{name}.xml").scene_updater) == count


def test_there_is_no_other_file() -> None:
    assert len(list(FILES.glob("*.xml"))) == 9


@pytest.mark.parametrize("file", sorted(FILES.glob("*.xml")), ids=lambda file: file.stem)
def test_a_file_stands_in_the_originals_order_and_has_no_error(file: Path) -> None:
    assert main(["check", "--strict", str(file)]) == 0


JUMP = ("--set", "algorithm.drive=/twist", "--set", "algorithm.speed=1.5")
"""The vehicle goes 0.15 m ahead one step after 0.1, 0.2, ... s, and stops at 1 s."""


@pytest.mark.slow
def test_simple_counts_from_the_move_to_the_stop(tmp_path: Path) -> None:
    played = play(tmp_path, "simple", *JUMP)
    # beyond 0.2 m with the second jump, at 0.202 s; nine jumps in all
    assert played.dat() == [
        "None\ttaskTime\tdistance\tTOTAL\tSimTime\t",
        "1\t0.798\t1.35\t0.798\t1\t",
        "",
    ]
    assert played.result.values("status") == ("ok",)


@pytest.mark.slow
def test_simple_with_the_originals_threshold_begins_a_jump_later(tmp_path: Path) -> None:
    played = play(tmp_path, "simple", *JUMP, "--compat", "uwsim")
    assert played.result.numbers("taskTime") == pytest.approx([0.698])  # 0.45 m, of 0.447 m


@pytest.mark.slow
def test_unending_ends_in_timeout_and_keeps_what_the_world_measured(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("uwsim.runs.trial.trial.MAX_TASK_DURATION", 3.0)
    # in this process, where the limit is set
    played = play(tmp_path, "unending", "--workers", "0", scene="cirs")
    result = played.result
    assert result.values("status") == ("timeout",)
    assert result.numbers("taskTime") == (3.0,)
    assert result.numbers("hits") == (1.0,)
    assert result.numbers("distance") == (0.0,)
    [box] = [
        thing for thing in read_scene(bundled_files("scenes")["cirs"]).objects if thing.physics
    ][1:]
    away = math.dist(box.position, (0.0, 0.0, 3.65))
    assert result.numbers("place") == pytest.approx([away], abs=1e-4)  # it lies on the floor
    assert result.numbers("guess") == pytest.approx([0.0], abs=1e-3)  # it waited for nothing
    assert result.values("total") == (None,)
    assert result.reason(0, "total") == "stopOn did not go on within 3 s"
    (guess,) = result.numbers("guess")
    assert played.dat()[1] == f"1\t3\t1\t{away:g}\t0\t{guess:g}\tnan\t3\t"


@pytest.mark.slow
def test_vision_has_27_rows_of_what_the_numbers_are_off(tmp_path: Path) -> None:
    played = play(tmp_path, "vision", "--set", "algorithm.error=1.0", interval=0.2)
    lines = played.dat()
    assert lines[0] == "Fog\tcorners\tcentroid\tTOTAL\tSimTime\t"
    assert lines[1:] == [
        f"{0.05 * i:g}\t2.82843\t1.41421\t4.24264\t{0.2 * (i + 1):g}\t" for i in range(27)
    ] + [""]
    assert set(played.result.values("status")) == {"ok"}


@pytest.mark.slow
def test_vision_auto_answers_with_the_target(tmp_path: Path) -> None:
    played = play(tmp_path, "vision-auto", "--set", "algorithm.error=1.0", interval=0.2)
    result = played.result
    assert result.numbers("fog") == pytest.approx([0.05 * i for i in range(41)])
    assert result.numbers("corners") == pytest.approx([math.sqrt(8.0)] * 41, abs=1e-4)
    # nobody is told the centroid: the estimate is (1, 1)
    off = math.hypot(CENTROID[0] - 1.0, CENTROID[1] - 1.0)
    assert result.numbers("centroid") == pytest.approx([off] * 41, abs=1e-3)
    assert result.numbers("total") == pytest.approx([off + math.sqrt(8.0)] * 41, abs=1e-3)
    units = {column.name: column.unit for column in result.columns}
    assert (units["fog"], units["corners"], units["centroid"]) == ("1/m", "px", "px")


@pytest.mark.slow
def test_vision_recursive_sweeps_fog_within_a_current_that_carries_the_vehicle(
    tmp_path: Path,
) -> None:
    chosen = ["--level", "fog=0", "--level", "fog=0.05", "--level", "fog=2"]
    played = play(tmp_path, "vision-recursive", *chosen, interval=2.2)
    result = played.result
    lines = played.dat()
    assert lines[0] == "Current\tFog\tcorners\tcentroid\tTOTAL\tSimTime\t"
    assert [line.split("\t")[:2] for line in lines[1:4]] == [
        ["0.05", "0"], ["0.05", "0.05"], ["0.05", "2"],
    ]  # fmt: skip
    assert result.numbers("ended_at") == pytest.approx([2.2, 4.4, 6.6])
    # told once a level, where the box is; then it drifts away, by 0.06 m/s and a tenth at most
    for corners in result.numbers("corners")[:2]:
        assert 2.0 < corners < 2.0 * FOCAL * 0.066 * 2.2 / 1.195


def drifted(speed: float, began: float) -> float:
    """Distance of the box from the image's centre at 2.2 s of a current that begins then [px]."""
    x = y = z = 0.0
    for i in range(round((2.2 - began) / 0.002)):
        t = began + 0.002 * (i + 1)
        force = speed + 0.005 * math.sin(2.0 * math.pi * t / 4.0)
        phi = 0.7 * math.sin(2.0 * math.pi * t / 30.0)
        x -= 0.002 * force * math.sin(1.57) * math.sin(phi)
        y += 0.002 * force * math.sin(1.57) * math.cos(phi)
        z += 0.002 * force * math.cos(1.57)
    return FOCAL * math.hypot(RIGHT - y, UP - x) / (DEPTH - z)


@pytest.mark.slow
def test_tracking_auto_carries_a_vehicle_that_nobody_steers(tmp_path: Path) -> None:
    played = play(tmp_path, "tracking-auto", interval=2.2)
    result = played.result
    assert result.numbers("current") == pytest.approx([0.01 * i for i in range(20)])
    assert set(result.values("status")) == {"ok"}
    # the first level is no step: its current flows at once, with 2.2 s of its swelling
    expected = [drifted(0.0, 0.0), *(drifted(0.01 * i, 2.0) for i in range(1, 20))]
    # three random factors, within 1 % each
    moved = [FOCAL * 0.2 * 0.01 * i / DEPTH for i in range(20)]  # [px]
    off = np.abs(np.array(result.numbers("objectCentered")) - expected)
    swollen = FOCAL * 0.005 * 4.0 / math.pi / DEPTH  # half a period of the first level [px]
    assert off[0] < 0.02 * swollen
    assert (off[1:] < 0.001 + 0.02 * np.array(moved[1:])).all()
    assert result.numbers("ended_at") == pytest.approx([2.2 * (i + 1) for i in range(20)])
    log = played.data("objectCentered")
    assert log[0] == "Current\tobjectCentered_total\tobjectCentered_x\tobjectCentered_y\t"
    assert len(log) == 1 + 20 * 23 + 2  # at 0, 0.1, ... 2.2 s of every level, and a blank line
    first = [float(cell) for cell in log[1].split("\t")[:-1]]
    assert first == pytest.approx(
        [0.0, OFF_CENTRE, -FOCAL * RIGHT / DEPTH, -FOCAL * UP / DEPTH], rel=1e-3
    )


@pytest.mark.slow
def test_tracking_dynamics_moves_nothing_itself(tmp_path: Path) -> None:
    result = play(tmp_path, "tracking-dynamics", interval=2.2).result
    assert result.numbers("current") == pytest.approx([0.025 * i for i in range(16)])
    assert result.numbers("objectCentered") == pytest.approx([OFF_CENTRE] * 16, rel=1e-6)
    assert set(result.values("status")) == {"ok"}


@pytest.mark.slow
def test_reconstruction_is_the_mean_of_what_points_are_off_the_box(tmp_path: Path) -> None:
    # kinematic_base stands at L (2, 0, 3.595), turned by pi about z; the box's top is at 4.66
    above = "0 -0.35 1.060 0 -0.35 1.050 0 -0.35 0.865"  # by 5, 15 and 200 mm
    played = play(tmp_path, "reconstruction", "--set", f"algorithm.cloud={above}", interval=1.0)
    result = played.result
    assert result.numbers("light") == pytest.approx([0.05 * i for i in range(21)])
    assert result.numbers("reconstruction") == pytest.approx([0.01] * 21, abs=1e-6)
    lines = played.dat()
    header = "Light\tmean error\terror variance\tcoverage %\toutliers %\tTOTAL\tSimTime\t"
    assert lines[0] == header
    n = 2 * 10  # inliers of a level: two in each of ten clouds
    # the box is 0.13 (a hair less) x 0.433 x 0.15 m; nodes of five faces, a centimetre apart
    nodes = 13 * 44 + 2 * 13 * 15 + 2 * 42 * 15
    for i, line in enumerate(lines[1:22]):
        light, mean, variance, coverage, outliers, total, time = map(float, line.split("\t")[:-1])
        assert (light, time) == pytest.approx((0.05 * i, i + 1.0))
        assert mean == total == pytest.approx(0.01, abs=1e-6)
        assert variance == pytest.approx(n / (n - 1) * 0.005**2, rel=1e-3)
        assert outliers == pytest.approx(1.0 / 3.0, rel=1e-5)
        assert coverage == pytest.approx(4.0 / nodes, rel=1e-5)  # those around the nearest point
    assert played.data("reconstruction")[0].split("\t")[:2] == ["Light", "mean error"]


@pytest.mark.slow
def test_pipe_following_integrates_how_far_the_vehicle_is_from_the_path(tmp_path: Path) -> None:
    played = play(tmp_path, "pipe-following", *JUMP)
    result = played.result
    assert result.values("status") == ("ok",)
    assert result.numbers("taskTime") == result.numbers("total") == (1.0,)
    # the path ends over (2, 0, 0) and turns right there; the vehicle goes straight on, below
    ahead = [0.15 * (max(0, step - 1) // 50) for step in range(501)]  # [m]
    assert result.numbers("pipeEnd") == pytest.approx([math.hypot(2.0 + ahead[-1], 2.515)])
    area = np.trapezoid([math.hypot(x, 2.515) for x in ahead], dx=0.002)
    assert result.numbers("pipe") == pytest.approx([area], rel=1e-6)
    log = played.data("pipe")
    assert log[0] == "None\tISE\tdistanceToPath\twaypoint\t"
    assert [line.split("\t")[0] for line in log[1:-2]] == [f"{0.1 * i:g}" for i in range(11)]
    assert log[-3].split("\t")[2] == f"{math.hypot(ahead[-1], 2.515):g}"
