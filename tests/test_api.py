"""What ``import uwsim`` offers."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

import uwsim
from tests.support.failing import RaisedError
from tests.support.short_benchmark import write_benchmark
from uwsim.bus import Node
from uwsim.cli import main
from uwsim.currents import Constant
from uwsim.errors import BadSetting, RunFailed
from uwsim.messages import Empty, TwistStamped, Vector3
from uwsim.results.directory import lock_directory

CLEAR = {"fog": [0]}


class Tuned:
    """Starts the benchmark, and has one parameter."""

    PARAMETERS: ClassVar = {"kp": 0.5}

    def start(self, node: Node) -> None:
        node.parameters["kp"]
        node.call("startBench", Empty())


def test_every_public_name_is_there_and_listed() -> None:
    assert {name for name in uwsim.__all__ if getattr(uwsim, name) is None} == set()
    assert set(uwsim.__all__) <= set(dir(uwsim))


def test_a_name_that_is_not_there_names_the_nearest() -> None:
    with pytest.raises(AttributeError, match=r"no attribute 'lod'\. Did you mean 'load'"):
        uwsim.lod  # noqa: B018


def test_importing_uwsim_loads_nothing_heavy() -> None:
    code = "import sys, uwsim; print([m for m in ('numpy', 'mujoco', 'cv2') if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_five_lines_make_an_image() -> None:
    with uwsim.load("currents-scene") as simulation:
        simulation.advance(0.1)
        image = simulation.image("bowtech1").colour
    assert simulation.time == pytest.approx(0.1)
    assert image is not None
    assert image.shape == (480, 640, 3)
    assert image.std() > 5.0


def test_a_vehicle_is_commanded_and_observed() -> None:
    with uwsim.load(Path("currents-scene")) as simulation:
        before = simulation.pose("girona500").position
        for _ in range(10):
            twist = TwistStamped()
            twist.twist.linear = Vector3(x=0.2, y=0.0, z=0.0)
            simulation.publish("/dataNavigator", twist)
            simulation.advance(0.1)
        after = simulation.pose("girona500").position
        assert np.linalg.norm(after - before) > 0.05
        assert simulation.velocity("girona500")[0] > 0.05
        own = simulation.pose("girona500", frame="girona500")
        np.testing.assert_allclose(own.matrix, np.eye(4), atol=1e-12)


def test_poses_are_given_in_the_frame_asked_for() -> None:
    with uwsim.load("currents-scene") as simulation:
        in_world, in_file = simulation.pose("blackbox", frame="W"), simulation.pose("blackbox")
        world_from_file = simulation.world.model.scene.world_from_localized
        np.testing.assert_allclose((world_from_file @ in_file).matrix, in_world.matrix, atol=1e-12)


def test_the_latest_message_is_there_although_nobody_had_read_the_topic() -> None:
    with uwsim.load("cirs") as simulation:
        simulation.advance(0.1)
        odometry = simulation.latest_message("/uwsim/girona500/odom")
        assert odometry is not None
        stamp = odometry.header.stamp
        simulation.advance(0.5)
        assert simulation.latest_message("/uwsim/girona500/odom").header.stamp != stamp
        with pytest.raises(uwsim.UwsimError, match="Did you mean"):
            simulation.latest_message("/uwsim/girona500/odm")


def test_images_are_published_once_somebody_has_asked() -> None:
    with uwsim.load("visibility-scene") as simulation:
        assert simulation.latest_message("/uwsim/camera1") is None
        simulation.advance(0.2)
        assert simulation.latest_message("/uwsim/camera1").width == 320


def test_a_kinematic_vehicle_has_no_velocity() -> None:
    with (
        uwsim.load("visibility-scene") as simulation,
        pytest.raises(uwsim.UwsimError, match="is kinematic"),
    ):
        simulation.velocity("girona500")


@pytest.mark.parametrize("seconds", [-1.0, float("nan"), float("inf")])
def test_time_that_is_none_is_refused(seconds: float) -> None:
    with (
        uwsim.load("visibility-scene") as simulation,
        pytest.raises(uwsim.UwsimError, match="expected a time >= 0"),
    ):
        simulation.advance(seconds)


def test_a_setting_and_a_scene_that_are_wrong_name_the_right_one() -> None:
    with pytest.raises(uwsim.UwsimError, match="density"):
        uwsim.load("visibility-scene", settings={"oceanState.fog.densty": 1})
    with pytest.raises(uwsim.UwsimError, match="Did you mean 'visibility-scene'"):
        uwsim.load("visibility-scne")


def test_values_of_a_wrong_type_are_refused_in_a_line() -> None:
    with uwsim.load("shapes-scene") as simulation:
        with pytest.raises(uwsim.UwsimError, match=r"set_current\(1\): expected three numbers"):
            simulation.set_current(1)  # type: ignore[arg-type]
        with pytest.raises(uwsim.UwsimError, match=r"\[1, 2, 3\]\): expected a Pose"):
            simulation.set_pose("girona500", [1, 2, 3])  # type: ignore[arg-type]
        with pytest.raises(uwsim.UwsimError, match=r"set_fog\('0.4'\): expected a finite number"):
            simulation.set_fog("0.4")  # type: ignore[arg-type]
        with pytest.raises(uwsim.UwsimError, match=r"advance\('1'\): expected a time"):
            simulation.advance("1")  # type: ignore[arg-type]
    with pytest.raises(uwsim.UwsimError, match=r"load\(seed='x'\): expected a whole number"):
        uwsim.load("shapes-scene", seed="x")  # type: ignore[arg-type]
    with pytest.raises(uwsim.UwsimError, match="expected a dictionary"):
        uwsim.load("shapes-scene", settings=["a=1"])  # type: ignore[arg-type]
    with pytest.raises(uwsim.UwsimError, match="consecutive seeds >= 0"):
        uwsim.bench("visibility", seeds=[-1])


def test_two_simulations_do_not_see_each_other() -> None:
    alone, beside = [], []
    with uwsim.load("currents-scene", seed=3) as one:
        one.advance(0.2)
        alone.append(one.pose("girona500").matrix.tobytes())
    with uwsim.load("currents-scene", seed=3) as one, uwsim.load("cirs") as other:
        for _ in range(100):
            one.advance()
            other.advance()
        beside.append(one.pose("girona500").matrix.tobytes())
    assert alone == beside


TIMES = {"began", "wall_s", "real_time_factor", "load", "command"}
"""What differs in the provenance of two runs."""


def contents(folder: Path) -> dict[str, bytes]:
    """Every file of a result directory, without what two runs do not share.

    That is, in ``provenance.json``, `TIMES`: when the run began, how long it took, the load of the
    machine, and the command that was typed, which is empty from Python. The report shows the
    provenance as a table and the command in a line; both are left out of ``report.html``.
    """
    found = {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }
    provenance = json.loads(found["provenance.json"])
    assert provenance.keys() >= TIMES
    kept = [(name, value) for name, value in provenance.items() if name not in TIMES]
    found["provenance.json"] = json.dumps(kept).encode()
    page = re.sub(r"<pre>uwsim bench .*?\n", "", found["report.html"].decode())
    page = re.sub(r"<h2[^>]*>Provenance.*?(?=<h2|</main|</body)", "", page, flags=re.DOTALL)
    found["report.html"] = page.encode()
    return found


@pytest.mark.slow
@pytest.mark.parametrize("workers", [0, 1])
def test_a_result_directory_of_python_has_the_bytes_of_one_of_the_command(
    workers: int, tmp_path: Path
) -> None:
    """All files byte for byte, but for what two runs of the command do not share (`contents`)."""
    levels = {"fog": [0.5]}
    own = tmp_path / "python" / "one.result"
    result = uwsim.bench(
        "visibility", algorithm="esm", levels=levels, seeds=(1, 2), workers=workers, out=own
    )
    out = tmp_path / "command" / "one.result"
    command = [sys.executable, "-m", "uwsim", "bench", "visibility", "--seed", "1", "--repeat", "2"]
    command += ["--level", "fog=0.5", "--algorithm", "esm", "--workers", str(workers)]
    subprocess.run([*command, "--out", str(out)], check=True, capture_output=True)
    assert uwsim.read_result(out).rows == result.rows
    ours, theirs = contents(own), contents(out)
    assert {"control/result.json", "report.html", "plots/total.png"} <= theirs.keys()
    assert ours.keys() == theirs.keys()
    assert [name for name in ours if ours[name] != theirs[name]] == []


def test_a_class_that_breaks_in_every_row_is_an_error_and_all_is_written(tmp_path: Path) -> None:
    benchmark, out = write_benchmark(tmp_path, "0.2"), tmp_path / "out"
    with pytest.raises(RunFailed, match=r"Every row ended in 'algorithm error': .*no focus"):
        uwsim.bench(benchmark, algorithm=RaisedError, levels={"fog": [0]}, out=out)
    result = uwsim.read_result(out)
    assert result.values("status") == ("algorithm error",)
    assert dict(result.run.clients or ()) == {"tests.support.failing:RaisedError": "in process"}
    assert (out / "report.html").is_file()
    assert (out / "control" / "result.json").is_file()


def test_a_class_is_what_is_tested_also_where_the_benchmark_names_none(tmp_path: Path) -> None:
    benchmark = write_benchmark(tmp_path, "0.2")
    with pytest.raises(uwsim.UwsimError, match="no parameter 'gain'"):
        uwsim.bench(benchmark, algorithm=Tuned, settings={"algorithm.gain": 1})
    benchmark.write_text(benchmark.read_text().replace(' u:algorithm="esm"', ""))
    kp = {"algorithm.kp": 1}
    result = uwsim.bench(benchmark, algorithm=Tuned, settings=kp, levels=CLEAR)
    assert result.run.algorithm == "tests.test_api:Tuned"
    own = type("Own", (Tuned,), {"__module__": "scripted"})  # no pilot of an earlier result
    result = uwsim.bench(benchmark, algorithm=own, settings=kp, levels=CLEAR)
    assert result.run.algorithm == "scripted:Own"


@pytest.mark.slow
def test_a_program_that_does_all_in_its_process_needs_no_guard(tmp_path: Path) -> None:
    program = tmp_path / "program.py"
    call = f"uwsim.bench({str(write_benchmark(tmp_path, '0.2'))!r}, levels={{'fog': [0]}}, out='o')"
    program.write_text(f"import uwsim\nprint('begun')\n{call}\n")
    done = subprocess.run(
        [sys.executable, program], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert (done.stdout, done.stderr) == ("begun\n", "")
    assert (tmp_path / "o" / "report.html").is_file()


def test_progress_is_reported_from_none_to_all_levels(tmp_path: Path) -> None:
    seen: list[tuple[int, int]] = []
    uwsim.bench(
        write_benchmark(tmp_path, "0.2"),
        algorithm="frozen",
        on_progress=lambda done, total: seen.append((done, total)),
    )
    assert seen == [(0, 3), (1, 3), (2, 3), (3, 3)]


def test_all_that_is_wrong_with_a_benchmark_is_reported_at_once(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").touch()
    with pytest.raises(uwsim.UwsimError) as caught:
        uwsim.bench("visibility", algorithm="emm", workers=-1, levels={"fogg": [0]}, out=tmp_path)
    lines = str(caught.value).splitlines()
    for words in ("--workers -1: ", "No algorithm is called 'emm'", "--level fogg: ", "not empty"):
        assert sum(words in line for line in lines) == 1, lines


def test_a_directory_into_which_another_run_writes_is_refused(tmp_path: Path) -> None:
    with (
        lock_directory(tmp_path / "out"),
        pytest.raises(uwsim.UwsimError, match="another run is writing into it"),
    ):
        uwsim.bench(write_benchmark(tmp_path, "0.2"), levels=CLEAR, out=tmp_path / "out")


@pytest.mark.slow
def test_a_run_that_failed_in_python_is_resumed_by_the_command(tmp_path: Path) -> None:
    def interrupt(done: int, total: int) -> None:
        if done == 1:
            raise KeyboardInterrupt

    benchmark, out = write_benchmark(tmp_path, "0.2"), tmp_path / "out"
    with pytest.raises(KeyboardInterrupt):
        uwsim.bench(benchmark, algorithm="frozen", out=out, on_progress=interrupt)
    assert len(uwsim.read_result(out).rows) == 1
    call = ["bench", str(benchmark), "--algorithm", "frozen", "--out", str(out)]
    assert main([*call, "--resume"]) == 0
    assert len(uwsim.read_result(out).rows) == 3


@pytest.mark.parametrize("value", ["0.5", None, True, float("nan")])
def test_a_level_that_is_no_number_is_refused(value: object) -> None:
    with pytest.raises(uwsim.UwsimError, match="expected numbers"):
        uwsim.bench("visibility", levels={"fog": [value]})  # type: ignore[list-item]


HUGE = 10**400


@pytest.mark.parametrize(
    ("argument", "value"),
    [
        ("levels", {3: [0.5]}),
        ("levels", {"fog": []}),
        ("levels", {"fog": [HUGE]}),
        ("levels", {"fog": None}),
        ("seeds", ["1"]),
        ("seeds", [1.5]),
        ("algorithm", 3),
        ("algorithm", Tuned()),
        ("out", 3),
        ("data_path", 3),
        ("data_path", [3]),
        ("on_progress", 3),
    ],
)
def test_an_argument_of_a_wrong_type_is_refused_by_its_name(
    argument: str, value: object, tmp_path: Path
) -> None:
    given: dict[str, Any] = {argument: value}
    with pytest.raises(BadSetting, match=f"^{argument}=.*: expected .*$"):
        uwsim.bench(write_benchmark(tmp_path, "0.2"), **given)


@pytest.mark.parametrize("number", [HUGE, 10**5000], ids=["400 digits", "5000 digits"])
def test_a_number_that_is_too_great_is_refused_in_a_line(number: int) -> None:
    with uwsim.load("currents-scene") as simulation:
        for call in (simulation.set_fog, simulation.set_light, simulation.advance):
            with pytest.raises(BadSetting, match=rf"^{call.__name__}\(.*\): expected a .*>= 0"):
                call(number)
        with pytest.raises(BadSetting, match=r"^set_current\(.*\): expected three numbers"):
            simulation.set_current((number, 0.0, 0.0))


class Swirl(Constant):
    """A flow of a program, which gives what it is told to."""

    def __init__(self, answer: object) -> None:
        super().__init__((0.1, 0.0, 0.0))
        object.__setattr__(self, "answer", answer)

    def motion(self, points: Any, time: float, vehicles: Any = ()) -> Any:
        answer: Any = vars(self)["answer"]
        return answer() if callable(answer) else answer

    def velocity(self, points: Any, time: float, vehicles: Any = ()) -> Any:
        return self.motion(points, time)


def divide() -> float:
    return 1 / 0


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        (divide, "raised ZeroDivisionError: division by zero at 0.*"),
        (None, "returned None at .* s; expected .*"),
        (np.zeros((7, 2)), "returned .* expected .*"),
        ((np.zeros(2), np.zeros(2)), "returned .* expected .*"),
        ("up", "returned 'up' .* expected .*"),
    ],
)
@pytest.mark.parametrize("scene", ["currents-scene", "visibility-scene"])
def test_a_flow_that_fails_is_an_error_with_its_class(
    scene: str, answer: object, said: str
) -> None:
    with uwsim.load(scene, is_blind=True) as simulation:
        simulation.set_current(Swirl(answer))
        with pytest.raises(uwsim.UwsimError, match=rf"^set_current: Swirl(\.\w+)? {said}$"):
            simulation.advance(0.1)


THIRDS = """<benchmark xmlns:u="urn:uwsim:1" u:scene="visibility-scene.xml" u:algorithm="frozen">
  <measures> <distance> <name>trip</name> <target>girona500</target> </distance> </measures>
  <startOn> <type>service</type> <target>startBench</target> </startOn>
  <stopOn> <type>never</type> </stopOn>
  <function>trip</function>
  <sceneUpdater> <sceneFogUpdater>
    <initialFog>0</initialFog> <finalFog>1</finalFog> <step>0.33333333333333331</step>
    <interval>0.1</interval>
  </sceneFogUpdater> </sceneUpdater>
</benchmark>"""


@pytest.mark.slow
def test_a_level_is_named_by_its_number_however_many_digits_it_has(tmp_path: Path) -> None:
    path = tmp_path / "thirds.xml"
    path.write_text(THIRDS)
    result = uwsim.bench(path, levels={"fog": [1 / 3, np.float32(0)]})
    assert [row[0] for row in result.rows] == pytest.approx([0.0, 1 / 3], abs=1e-12)
    assert result.run.levels == (("fog", 1 / 3), ("fog", 0.0))


def test_seeds_that_are_not_consecutive_are_refused() -> None:
    with pytest.raises(uwsim.UwsimError, match=r"range\(6\)"):
        uwsim.bench("visibility", seeds=(1, 3))


def test_check_gives_the_errors_of_files(tmp_path: Path) -> None:
    bad = tmp_path / "bad.xml"
    bad.write_text("<UWSimScene><nedOrigin><lat>north</lat></nedOrigin></UWSimScene>")
    errors = uwsim.check(str(bad))
    assert any(diagnostic.severity == "error" and diagnostic.line == 1 for diagnostic in errors)


class Idle:
    def start(self, node: object) -> None:
        """Do nothing."""


def test_what_is_no_algorithm_is_not_attached() -> None:
    with uwsim.load("visibility-scene") as simulation:
        refusal = r"expected an algorithm|has no method start"
        for wrong in ("esm", Idle, 3):
            with pytest.raises(uwsim.UwsimError, match=refusal):
                simulation.attach(wrong)  # type: ignore[arg-type]
        simulation.reset()
        assert simulation.save()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"seeds": 3}, r"seeds=3: expected a sequence, such as \(3,\) or range\(6\)"),
        ({"levels": {"fog": 0.5}}, "expected names and lists"),
        ({"levels": ["fog=0"]}, "expected names and lists"),
    ],
)
def test_arguments_of_a_wrong_kind_are_refused(options: dict[str, Any], message: str) -> None:
    with pytest.raises(uwsim.UwsimError, match=message):
        uwsim.bench("visibility", **options)


def test_results_are_compared_by_their_directories() -> None:
    with pytest.raises(uwsim.UwsimError, match=r"compare\(dict\): expected the directories"):
        uwsim.compare({}, "a")  # type: ignore[arg-type]


def test_check_takes_bundled_names_as_the_command_does() -> None:
    found = uwsim.check("grasp-scene", "grasp")
    assert {diagnostic.severity for diagnostic in found} <= {"note", "warning"}
    assert any(diagnostic.line for diagnostic in found)


@pytest.mark.parametrize("of", ["L", "W", "girona500"])
@pytest.mark.parametrize("name", ["girona500", "blackbox"])
def test_a_body_is_where_set_pose_puts_it(name: str, of: str) -> None:
    pose = uwsim.Pose.from_rpy((0.7, -0.4, 1.3), (0.1, -0.2, 2.0))
    if name == of:
        pose = uwsim.Pose.from_rpy((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    with uwsim.load("grasp-scene", seed=4) as simulation:
        simulation.set_pose(name, pose, frame=of)
        np.testing.assert_allclose(simulation.pose(name, frame=of).matrix, pose.matrix, atol=1e-12)
        np.testing.assert_allclose(simulation.velocity("girona500"), 0.0, atol=1e-12)


def test_set_pose_names_what_can_be_placed() -> None:
    pose = uwsim.Pose.identity()
    far = uwsim.Pose.from_rpy((1e9, 0.0, 0.0), (0.0, 0.0, 0.0))
    with uwsim.load("grasp-scene") as simulation:
        with pytest.raises(uwsim.UwsimError, match="Did you mean 'blackbox'"):
            simulation.set_pose("blakbox", pose)
        with pytest.raises(uwsim.UwsimError, match=r"it is fixed.*object\[terrain\]\.position"):
            simulation.set_pose("terrain", pose)
        with pytest.raises(uwsim.UwsimError, match="1e\\+06 m at most"):
            simulation.set_pose("girona500", far)


def run_of(simulation: uwsim.Simulation) -> bytes:
    """What follows from now: poses, a sensor's noise."""
    simulation.advance(0.2)
    row = np.zeros(simulation.world.engine.motion.size)
    simulation.world.engine.motion.read(row)
    return row.tobytes()


def test_a_reset_gives_what_a_new_simulation_of_the_seed_gives() -> None:
    fresh = []
    for seed in (3, 8):
        with uwsim.load("grasp-scene", seed=seed) as simulation:
            fresh.append(run_of(simulation))
    assert fresh[0] != fresh[1]
    with uwsim.load("grasp-scene", seed=3) as simulation:
        simulation.latest_message("/girona500/imu")
        simulation.set_fog(0.9)
        simulation.set_current((0.4, 0.0, 0.0))
        run_of(simulation)
        simulation.reset(seed=8)
        assert (simulation.step, run_of(simulation)) == (0, fresh[1])
        simulation.reset()
        assert run_of(simulation) == fresh[1]
        simulation.reset(seed=3)
        assert simulation.latest_message("/girona500/imu") is None
        assert run_of(simulation) == fresh[0]
        assert simulation.latest_message("/girona500/imu") is not None


@pytest.mark.parametrize("seed", [-1, 1.5, "7", True])
def test_a_reset_refuses_what_is_no_seed(seed: object) -> None:
    with (
        uwsim.load("visibility-scene") as simulation,
        pytest.raises(uwsim.UwsimError, match="whole number >= 0"),
    ):
        simulation.reset(seed=seed)  # type: ignore[arg-type]


def test_an_image_names_its_ids_and_has_boxes_and_its_camera() -> None:
    with uwsim.load("visibility-scene") as simulation:
        image = simulation.image("bowtech1")
        view = simulation.world.sensors.camera("bowtech1")
        assert image.ids is not None
        seen = {image.names[number] for number in np.unique(image.ids).tolist() if number}
        assert seen == set(image.boxes)
        assert image.world_from_camera is not None
        np.testing.assert_array_equal(image.world_from_camera.matrix, view.world_from_camera.matrix)
        for name, box in image.boxes.items():
            mask = np.isin(image.ids, [n for n, each in image.names.items() if each == name])
            assert mask[box.top : box.bottom, box.left : box.right].sum() == mask.sum()
            assert mask[box.top].any()
            assert mask[box.bottom - 1].any()
            assert mask[:, box.left].any()
            assert mask[:, box.right - 1].any()


def test_a_box_in_space_is_around_what_the_image_shows() -> None:
    with uwsim.load("visibility-scene") as simulation:
        image = simulation.image("bowtech1")
        assert image.world_from_camera is not None
        assert image.range is not None
        assert image.ids is not None
        boxes = simulation.boxes(frame="W")
        assert set(image.boxes) <= set(boxes)
        points = image.intrinsics.rays() * image.depth[..., None]
        for number in np.unique(image.ids).tolist():
            if not number:
                continue
            world = image.world_from_camera.transform(points[image.ids == number])
            box = boxes[image.names[number]]
            inside = np.abs(box.pose.inverse().transform(world)) <= 0.5 * box.size + 2e-3
            assert inside.all()
            assert box.corners.shape == (8, 3)
        own = simulation.boxes()
        here = simulation.world.model.scene.world_from_localized
        for name, box in boxes.items():
            np.testing.assert_allclose(here.transform(own[name].corners), box.corners, atol=1e-9)


def test_fog_light_and_currents_are_set_from_a_program() -> None:
    with uwsim.load("currents-scene") as simulation:
        clear = simulation.image("bowtech1").colour
        simulation.set_fog(3.0)
        foggy = simulation.image("bowtech1").colour
        simulation.set_fog(0.0)
        simulation.set_light(0.0)
        dark = simulation.image("bowtech1").colour
        assert clear is not None
        assert foggy is not None
        assert dark is not None
        assert foggy[..., 1].std() < 0.5 * clear[..., 1].std()
        assert dark.mean() < 0.5 * clear.mean()
        point = np.zeros((1, 3))
        before = simulation.world.water.velocity(point, 0.0, "girona500")
        simulation.set_current([0.3, -0.1, 0.0])
        simulation.set_current((0.3, 0.2, 0.0))
        added = simulation.world.water.velocity(point, 0.0, "girona500") - before
        turned = simulation.world.model.scene.world_from_localized.rotation @ [0.3, 0.2, 0.0]
        np.testing.assert_allclose(added[0], turned, atol=1e-12)
        simulation.set_current(None)
        now = simulation.world.water.velocity(point, 0.0, "girona500")
        np.testing.assert_array_equal(now, before)
        for wrong in (-0.1, float("nan"), float("inf")):
            with pytest.raises(uwsim.UwsimError, match="expected a finite number >= 0"):
                simulation.set_fog(wrong)
            with pytest.raises(uwsim.UwsimError, match="expected a finite number >= 0"):
                simulation.set_light(wrong)
        for velocity in ((1.0, 2.0), (float("nan"), 0.0, 0.0), (1e9, 0.0, 0.0), "up"):
            with pytest.raises(uwsim.UwsimError, match="expected three numbers"):
                simulation.set_current(velocity)  # type: ignore[arg-type]


def test_a_message_on_an_unknown_topic_is_an_error_with_the_nearest_name() -> None:
    with (
        uwsim.load("currents-scene") as simulation,
        pytest.raises(uwsim.UwsimError, match=r"dataNavigater.*Did you mean 'dataNavigator'"),
    ):
        simulation.publish("/dataNavigater", TwistStamped())


def test_a_message_that_nobody_reads_gives_one_warning(capsys: pytest.CaptureFixture[str]) -> None:
    with uwsim.load("currents-scene") as simulation:
        topic = next(name for name in simulation.topics if not simulation.bus.has_subscribers(name))
        kind = simulation.bus.message_type(topic)
        assert kind is not None
        for _ in range(2):
            simulation.publish(topic, kind())
    assert capsys.readouterr().err.count("the message has no effect") == 1
