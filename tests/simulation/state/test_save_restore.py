"""Save and restore: what follows a restored state is what followed it before, to the bit."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from uwsim.cli import main
from uwsim.currents import Constant
from uwsim.messages import CameraInfo, TwistStamped, Vector3
from uwsim.simulation.state.saved_bytes import append_checksum

SCENES = ["currents-scene", "visibility-moving-scene", "cirs"]


def record(simulation: uwsim.Simulation, seconds: float) -> list[bytes]:
    """Advance, and note all positions, velocities, messages and images on the way."""
    seen = []
    for _ in range(round(seconds / 0.1)):
        simulation.advance(0.1)
        motion = simulation.world.engine.motion
        row = np.zeros(motion.size)
        motion.read(row)
        seen.append(row.tobytes())
        for topic in sorted(simulation.topics):
            newest = simulation.latest_message(topic)
            seen.append(repr(newest).encode() if newest is not None else b"")
        image = simulation.latest_message("/uwsim/camera1")
        seen.append(b"" if image is None else image.data.tobytes())
    return seen


def command(simulation: uwsim.Simulation) -> None:
    if simulation.topics.get("dataNavigator") != "geometry_msgs/msg/TwistStamped":
        return
    twist = TwistStamped()
    twist.twist.linear = Vector3(x=0.2, y=0.1, z=0.0)
    simulation.publish("/dataNavigator", twist)


@pytest.mark.parametrize("scene", SCENES)
def test_what_follows_is_the_same_to_the_bit(scene: str) -> None:
    with uwsim.load(scene, seed=4) as simulation:
        command(simulation)
        for topic in simulation.topics:
            simulation.latest_message(topic)
        simulation.advance(0.3)
        command(simulation)  # on its way when the state is saved
        simulation.advance()
        saved = simulation.save()
        first = record(simulation, 0.5)
        simulation.restore(saved)
        assert simulation.time == pytest.approx(0.302)
        assert record(simulation, 0.5) == first
    with uwsim.load(scene, seed=4) as other:
        other.restore(saved)
        assert record(other, 0.5) == first


def test_saving_changes_nothing_and_gives_the_same_bytes_twice() -> None:
    with uwsim.load("currents-scene") as simulation:
        simulation.advance(0.1)
        assert simulation.save() == simulation.save()
        watched = record(simulation, 0.2)
    with uwsim.load("currents-scene") as simulation:
        simulation.advance(0.1)
        assert record(simulation, 0.2) == watched


def test_servos_that_follow_a_command_go_on() -> None:
    with uwsim.load("currents-scene") as simulation:
        simulation.advance()
        simulation.world.engine.actuation[0].servos.set_position_targets(
            np.array([0, 1]), np.array([0.4, 0.2])
        )
        simulation.advance(0.05)
        saved = simulation.save()
        simulation.advance(0.5)
        there = simulation.world.vehicles.find("girona500").joints
        simulation.restore(saved)
        assert not np.array_equal(simulation.world.vehicles.find("girona500").joints, there)
        simulation.advance(0.5)
        np.testing.assert_array_equal(simulation.world.vehicles.find("girona500").joints, there)


def test_bytes_of_another_scene_or_of_none_are_refused() -> None:
    with uwsim.load("currents-scene") as simulation, uwsim.load("visibility-scene") as other:
        with pytest.raises(uwsim.UwsimError, match="not of this scene"):
            other.restore(simulation.save())
        saved = simulation.save()
        changed = saved[:300] + bytes([saved[300] ^ 1]) + saved[301:]
        none = append_checksum(pickle.dumps([1]))
        for damaged in (b"", b"x" * 50, saved[:200], changed, none):
            with pytest.raises(uwsim.UwsimError, match="no saved simulation"):
                simulation.restore(damaged)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"seed": 1}, "has seed 0; this one has 1"),
        ({"timestep": 0.004}, "has timestep 0.002 s; this one has 0.004 s"),
        ({"settings": {"oceanState.fog.density": 0.5}}, "not of this scene"),
        ({"settings": {"object[blackbox].position.x": 2.1}}, "not of this scene"),
    ],
)
def test_bytes_of_another_seed_timestep_or_setting_are_refused(
    options: dict[str, Any], message: str
) -> None:
    with (
        uwsim.load("visibility-moving-scene") as simulation,
        uwsim.load("visibility-moving-scene", **options) as other,
    ):
        before = other.save()
        with pytest.raises(uwsim.UwsimError, match=message):
            other.restore(simulation.save())
        assert other.save() == before


def test_bytes_of_another_seed_are_refused_after_a_reset() -> None:
    with uwsim.load("visibility-scene") as simulation:
        saved = simulation.save()
        simulation.reset(seed=1)
        with pytest.raises(uwsim.UwsimError, match="has seed 0; this one has 1"):
            simulation.restore(saved)
        simulation.reset(seed=0)
        simulation.restore(saved)


class Evil:
    def __reduce__(self) -> tuple[object, tuple[str]]:
        return print, ("owned",)


def test_bytes_that_would_run_code_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with uwsim.load("visibility-scene") as simulation:
        with pytest.raises(uwsim.UwsimError, match=r"builtins\.print is no type of a state"):
            simulation.restore(append_checksum(pickle.dumps({"uwsim": Evil()})))
        assert capsys.readouterr().out == ""


class Quiet:
    def start(self, node: uwsim.Node) -> None:
        pass


def test_with_an_algorithm_attached_nothing_is_saved() -> None:
    with uwsim.load("visibility-scene") as simulation:
        simulation.attach(Quiet())
        with pytest.raises(uwsim.UwsimError, match="Quiet is attached"):
            simulation.save()


class Counting:
    """An algorithm that saves itself: it counts messages and drives by a timer."""

    def __init__(self) -> None:
        self.n_heard = 0

    def start(self, node: uwsim.Node) -> None:
        drive = node.publisher("/dataNavigator", TwistStamped)
        random = node.rng

        def steer() -> None:
            twist = TwistStamped()
            twist.twist.linear = Vector3(x=0.1 * random.random(), y=0.01 * self.n_heard, z=0.0)
            drive(twist)

        node.subscribe("/uwsim/camera1_info", CameraInfo, self.hear)
        node.create_timer(0.03, steer)

    def hear(self, _message: CameraInfo) -> None:
        self.n_heard += 1

    def save(self) -> bytes:
        return self.n_heard.to_bytes(4, "little")

    def restore(self, data: bytes) -> None:
        self.n_heard = int.from_bytes(data, "little")


def test_an_algorithm_that_saves_itself_goes_on_with_the_simulation() -> None:
    with uwsim.load("currents-scene", seed=4) as simulation:
        algorithm = Counting()
        simulation.attach(algorithm)
        simulation.advance(0.3)
        saved, state, heard = simulation.save(), simulation.state.copy(), algorithm.n_heard
        assert heard > 0
        simulation.advance(0.3)
        later = simulation.state.copy()
        assert algorithm.n_heard > heard
        for again in (saved, state):
            simulation.restore(again)
            assert algorithm.n_heard == heard
            simulation.advance(0.3)
            assert simulation.state == later


def test_a_copy_of_the_state_stays_and_has_bytes() -> None:
    with uwsim.load("currents-scene") as simulation:
        first = simulation.state.copy()
        assert first == simulation.state
        simulation.advance(0.01)
        assert first != simulation.state
        assert uwsim.State.from_bytes(first.to_bytes()) == first
        assert uwsim.State.from_bytes(simulation.save()) == simulation.state
        simulation.restore(first)
        assert first == simulation.state
        assert simulation.time == 0.0


def test_a_current_that_a_program_has_set_is_saved() -> None:
    with uwsim.load("currents-scene") as simulation:
        simulation.set_current((0.3, 0.0, 0.1))
        simulation.advance(0.1)
        saved = simulation.save()
        simulation.advance(0.1)
        later = simulation.state.copy()
        simulation.set_current(None)
        simulation.restore(saved)
        simulation.advance(0.1)
        assert simulation.state.copy() == later


def test_a_current_of_a_programs_own_class_has_no_bytes() -> None:
    class Own(Constant):
        pass

    with uwsim.load("currents-scene") as simulation:
        simulation.set_current(Own((0.1, 0.0, 0.0)))
        copy = simulation.state.copy()
        with pytest.raises(uwsim.UwsimError, match="The state cannot be saved"):
            simulation.save()
        simulation.set_current(None)
        simulation.restore(copy)
        with pytest.raises(uwsim.UwsimError, match="The state cannot be saved"):
            simulation.save()


def test_bytes_of_another_version_are_refused_though_its_records_are_others() -> None:
    record = [0, "uwsim.simulation.state.state:State", "one field"]
    with pytest.raises(uwsim.UwsimError, match="was not saved by uwsim"):
        uwsim.State.from_bytes(append_checksum(pickle.dumps(("0.0.1", record))))


class Counts:
    """Counts the ticks of its timer."""

    def __init__(self, *, fails_at: int = 1000) -> None:
        self.n, self.fails_at = 0, fails_at

    def start(self, node: uwsim.Node) -> None:
        node.create_timer(0.1, self.tick)

    def tick(self) -> None:
        self.n += 1
        if self.n == self.fails_at:
            raise ValueError("it fails")

    def save(self) -> bytes:
        return bytes([self.n])

    def restore(self, data: bytes) -> None:
        (self.n,) = data


def test_a_restore_that_is_refused_changes_nothing() -> None:
    with uwsim.load("currents-scene") as plain, uwsim.load("currents-scene") as other:
        plain.advance(0.3)
        saved = plain.save()
        other.attach(Counts())
        other.advance(1.0)
        before = other.save()
        with pytest.raises(uwsim.UwsimError, match=r"algorithms \[\], this one has \['Counts'\]"):
            other.restore(saved)
        with pytest.raises(uwsim.UwsimError, match=r"\['Counts'\], this one has \[\]"):
            plain.restore(before)
        assert (other.save(), plain.save()) == (before, saved)


def test_what_an_algorithm_refuses_to_restore_changes_nothing() -> None:
    with uwsim.load("currents-scene") as simulation:
        counts = Counts()
        simulation.attach(counts)
        simulation.advance(0.3)
        saved = simulation.state.copy()
        simulation.advance(0.3)
        before, saved.nodes[0].algorithm = simulation.save(), b"ab"  # type: ignore[assignment]
        with pytest.raises(ValueError, match="too many values"):
            simulation.restore(saved)
        assert simulation.save() == before


def test_an_algorithm_that_has_failed_since_goes_on() -> None:
    with uwsim.load("currents-scene") as simulation:
        counts = Counts(fails_at=4)
        simulation.attach(counts)
        simulation.advance(0.2)
        saved = simulation.save()
        with pytest.raises(ValueError, match="it fails"):
            simulation.advance(0.3)
        simulation.restore(saved)
        counts.fails_at = 1000
        simulation.advance(1.0)
        assert counts.n == 13


def test_a_state_of_other_hydrodynamics_is_refused(tmp_path: Path) -> None:
    folders = [tmp_path / "one", tmp_path / "two"]
    for folder in folders:
        folder.mkdir()
        main(["copy", "currents-scene", str(folder)])
    (file,) = folders[1].glob("g500*.xml")
    file.write_text(file.read_text().replace("<mass>", "<mass>1", 1))
    with uwsim.load(folders[0] / "currents-scene.xml") as simulation:
        saved = simulation.save()
    refused = pytest.raises(uwsim.UwsimError, match="not of this scene")
    with uwsim.load(folders[1] / "currents-scene.xml") as other, refused:
        other.restore(saved)


@pytest.mark.parametrize("data", [None, 3, "saved", memoryview(b"ab")])
def test_what_is_no_bytes_is_refused(data: Any) -> None:
    refused = pytest.raises(uwsim.UwsimError, match="is no saved simulation; expected bytes")
    with uwsim.load("currents-scene") as simulation, refused:
        simulation.restore(data)
