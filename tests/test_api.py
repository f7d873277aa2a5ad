"""What ``import uwsim`` offers."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import uwsim
from uwsim.messages import TwistStamped, Vector3


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
        own = simulation.pose("girona500", of="girona500")
        np.testing.assert_allclose(own.matrix, np.eye(4), atol=1e-12)


def test_poses_are_given_in_the_frame_asked_for() -> None:
    with uwsim.load("currents-scene") as simulation:
        in_world, in_file = simulation.pose("blackbox", of="W"), simulation.pose("blackbox")
        world_from_file = simulation.world.world_from_localized
        np.testing.assert_allclose((world_from_file @ in_file).matrix, in_world.matrix, atol=1e-12)


def test_the_latest_message_is_there_although_nobody_had_read_the_topic() -> None:
    with uwsim.load("cirs") as simulation:
        simulation.advance(0.1)
        odometry = simulation.latest("/uwsim/girona500/odom")
        assert odometry is not None
        stamp = odometry.header.stamp
        simulation.advance(0.5)
        assert simulation.latest("/uwsim/girona500/odom").header.stamp != stamp
        with pytest.raises(uwsim.UwsimError, match="Did you mean"):
            simulation.latest("/uwsim/girona500/odm")


def test_images_are_published_once_somebody_has_asked() -> None:
    with uwsim.load("visibility-scene") as simulation:
        assert simulation.latest("/uwsim/camera1") is None
        simulation.advance(0.2)
        assert simulation.latest("/uwsim/camera1").width == 320


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


@pytest.mark.slow
def test_a_benchmark_in_python_is_that_of_the_command(tmp_path: Path) -> None:
    levels = {"fog": [0.5]}
    result = uwsim.bench("visibility", algorithm="esm", levels=levels, seeds=(1,))
    out = tmp_path / "command.result"
    command = [sys.executable, "-m", "uwsim", "bench", "visibility", "--seed", "1"]
    command += ["--level", "fog=0.5", "--algorithm", "esm", "--out", str(out)]
    subprocess.run(command, check=True, capture_output=True)
    stored = uwsim.read_result(out)
    assert stored.rows == result.rows
    assert json.loads((out / "result.json").read_text())["rows"] == [list(result.rows[0])]


def test_seeds_that_are_not_consecutive_are_refused() -> None:
    with pytest.raises(uwsim.UwsimError, match=r"range\(6\)"):
        uwsim.bench("visibility", seeds=(1, 3))


def test_check_gives_the_errors_of_files(tmp_path: Path) -> None:
    bad = tmp_path / "bad.xml"
    bad.write_text("<UWSimScene><oceanState><windx>fast</windx></oceanState></UWSimScene>")
    errors = uwsim.check(str(bad))
    assert any(diagnostic.severity == "error" and diagnostic.line == 1 for diagnostic in errors)
