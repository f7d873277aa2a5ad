"""Motion tracks hold the sand that a dredge takes; a track without any keeps its bytes."""

from __future__ import annotations

import gzip
import json
from dataclasses import replace
from pathlib import Path

import numpy as np

from tests.devices.test_dredge_tool import scene
from tests.support.opened import open_scene
from uwsim.base.geometry import Array, Pose
from uwsim.results.motion import RATE, DugSand, read_track, track_bytes
from uwsim.results.motion.dug_sand import NO_VALUE
from uwsim.runs.trial.motion_recorder import MotionRecorder


def recorded(folder: Path) -> tuple[bytes, list[Array]]:
    """Dig for a while, put the sand back, dig elsewhere; the track, and the sand of each frame."""
    with open_scene(scene(folder, 1.0), is_blind=True) as simulation:
        recorder = MotionRecorder(simulation, ())
        (heap,) = simulation.world.scenery.heaps
        frames: list[Array] = []

        def look() -> None:
            while simulation.step >= round(len(frames) / (RATE * simulation.timestep)):
                frames.append(heap.heights)

        recorder.start()
        simulation.watch(look)
        look()
        for x in (0.0, 0.03):
            simulation.world.vehicles.find("rov").place(
                Pose(np.array([x, 0.01, 0.1234567]), np.eye(3))
            )
            simulation.advance(0.3)
        heap.restore(())
        simulation.world.vehicles.find("rov").place(Pose(np.array([-0.05, 0.0, 0.1]), np.eye(3)))
        simulation.advance(0.2)
        return recorder.track(), frames


def test_sand_of_a_track_is_that_of_the_run_to_the_bit(tmp_path: Path) -> None:
    data, frames = recorded(tmp_path)
    track = read_track(data)
    assert track.n_frames == len(frames)
    with open_scene(scene(tmp_path, 1.0), is_blind=True) as simulation:
        (heap,) = simulation.world.scenery.heaps
        for frame in (*range(len(frames)), 3, 20, 7):  # forwards, and to and fro
            heap.restore(track.sand.spots(0, frame))
            assert (heap.heights == frames[frame]).all(), frame
    assert (frames[5] < frames[0]).any()
    assert len({heights.tobytes() for heights in frames}) > 10
    assert data == recorded(tmp_path)[0]


def test_a_place_of_digging_takes_few_bytes() -> None:
    n = 3600  # a minute of a tool that goes along 10 cm a second and takes sand all the time
    time = np.arange(n) / 60.0
    places = np.stack([0.1 * time, 0.05 * np.sin(time), 0.1 + 0.01 * np.cos(3 * time)], axis=1)
    rows = np.zeros((n, 5), np.int32)
    rows[:, 0], rows[:, 2:] = np.arange(n) // 2, np.rint(places / 1e-6)
    empty = np.zeros((1800, 0), np.int32)
    assert len(track_bytes((), (), empty, (), sand=DugSand(table=rows))) < 20_000


def test_only_a_track_with_digs_is_of_version_2(tmp_path: Path) -> None:
    empty = np.zeros((4, 0), np.int32)
    plain = track_bytes((), (), empty, ())
    assert plain == track_bytes((), (), empty, (), sand=DugSand())
    line = gzip.decompress(plain).partition(b"\n")[0]
    assert json.loads(line)["uwsim_motion"] == 1
    assert "sand" not in json.loads(line)
    dug = DugSand(table=np.array([[1, 0, 5, -6, 7], [2, 0, *[NO_VALUE] * 3], [3, 1, 1, 1, 1]]))
    track = read_track(
        track_bytes((), (), empty, (), sand=replace(dug, table=dug.table.astype("i4")))
    )
    assert track.sand.spots(0, 0) == []
    assert track.sand.spots(0, 1) == [(5, -6, 7)]
    assert track.sand.spots(0, 3) == []
    assert track.sand.spots(1, 3) == [(1, 1, 1)]


def test_a_tool_that_is_nowhere_takes_nothing(tmp_path: Path) -> None:
    with open_scene(scene(tmp_path, 1.0), is_blind=True) as simulation:
        (heap,) = simulation.world.scenery.heaps
        assert heap.dig(np.array([np.nan, 0.0, 0.0])) == 0
        assert heap.dig(np.array([1e9, 0.0, 0.0])) == 0
