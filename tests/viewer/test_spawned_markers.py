"""Markers that an algorithm spawns are in its result: in the track, the replay and the film."""

from __future__ import annotations

import gzip
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import uwsim
from tests.simulation.markers.test_lines import marker
from tests.support import marking
from tests.support.marking import BOX, DELETE_TIME, FLASH, MOVE_TIME, SPAWN_TIME
from tests.support.short_benchmark import run, write_benchmark
from uwsim.errors import ResultError
from uwsim.messages import Marker, Point, SpawnMarker
from uwsim.results.journal import track_path
from uwsim.results.motion import (
    DrawnMarker,
    MarkerChange,
    load_track,
    markers_at,
    read_track,
    track_bytes,
)
from uwsim.runs.trial import motion_events
from uwsim.runs.trial.motion_events import MarkerLog
from uwsim.viewer.film.film import Film, FilmSpec
from uwsim.viewer.film.markers import clip_line
from uwsim.viewer.recorded import RecordedTrial
from uwsim.viewer.replay import Replay

WORDS = f"{marking.__file__}:MarkingAlgorithm"
TIMES = {
    SPAWN_TIME - 0.1: [],
    SPAWN_TIME + 0.1: [BOX],
    MOVE_TIME + 0.1: [BOX, FLASH],
    MOVE_TIME + 0.3: [BOX],
}
TIMES |= {DELETE_TIME + 0.1: []}


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("marked")
    run(write_benchmark(folder, "0.5"), folder / "out", algorithm=WORDS)
    return folder / "out"


def test_a_track_has_the_markers_when_they_were_there(result: Path) -> None:
    track = load_track(track_path(result, 0))
    for time, names in TIMES.items():
        assert list(markers_at(track.markers, int(time * 30.0))) == names, time
    there = [markers_at(track.markers, int(time * 30.0))[BOX] for time in (0.5, 0.9)]
    assert there[1].pose[0] - there[0].pose[0] == pytest.approx(0.0, abs=0.21)
    assert np.hypot(*np.subtract(there[1].pose, there[0].pose)[:2]) == pytest.approx(0.2)
    assert there[0].lines == there[1].lines != ()
    assert there[0].colour == "#ff3300"


def test_a_film_draws_them(result: Path) -> None:
    spec = FilmSpec(size=(240, 180), inset=False, has_curves=False)
    film = Film(RecordedTrial.open(result, 0), spec)
    red = {}
    for time in TIMES:
        image = film.draw(time).astype(int)
        red[time] = int((np.abs(image - [255, 51, 0]).max(axis=2) < 8).sum())
    film.close()
    for time, names in TIMES.items():
        assert (red[time] > 20) == (BOX in names), (time, red)


@pytest.mark.slow
def test_the_page_draws_them(tab: Any, result: Path, tmp_path: Path) -> None:
    tab.goto(Replay(result).save(tmp_path / "replay.html").as_uri())
    tab.wait_for_function("window.uwsim !== undefined")
    look = load_track(track_path(result, 0)).markers[0].marker
    assert look is not None
    for time, names in TIMES.items():
        tab.evaluate("t => uwsim.seek(t)", time)
        found = tab.evaluate("uwsim.markers()")
        assert [each["name"] for each in found] == names, time
    tab.evaluate("uwsim.seek(0.5)")
    (box,) = tab.evaluate("uwsim.markers()")
    assert box["colour"] == "#ff3300"
    assert np.mean(box["lines"][0][:4], axis=0)[:2] == pytest.approx(look.pose[:2], abs=1e-3)


def test_the_switch_of_the_original_offers_no_markers(tmp_path: Path) -> None:
    path = write_benchmark(tmp_path, "0.5")
    run(path, tmp_path / "out", algorithm=WORDS, compat=["no-markers"])
    assert load_track(track_path(tmp_path / "out", 0)).markers == ()


LOOK = DrawnMarker(
    colour="#00ff00", pose=(0.0, 0, 0, 1, 0, 0, 0), lines=(((0.0, 0, 0), (1, 0, 0)),)
)


def test_a_marker_that_moves_takes_few_bytes_and_a_track_without_any_is_of_version_1() -> None:
    table = np.zeros((1800, 0), np.int32)
    moved = [
        MarkerChange(
            frame=3 * k,
            name="1+goal",
            marker=DrawnMarker(
                colour="#00ff00",
                pose=(round(0.01 * k, 4), round(float(np.sin(0.1 * k)), 4), 0, 1, 0, 0, 0),
                lines=LOOK.lines,
            ),
        )
        for k in range(600)
    ]
    assert len(track_bytes((), (), table, (), markers=moved)) < 10_000  # a minute at 10 Hz
    assert b'"uwsim_motion":1' in gzip.decompress(track_bytes((), (), table, ()))


@pytest.mark.parametrize(
    "changes",
    [
        [[0, "a", 1, "#00ff00", [0, 0, 0, 1, 0, 0, 0]]],
        [[0, "a", 0, "<b>", [0, 0, 0, 1, 0, 0, 0]]],
        [[0, "a", 0, "#00ff00", [0, 0]]],
        [[0, "a", 0]],
        [[0]],
        7,
    ],
)
def test_damaged_markers_of_a_track_are_an_error(changes: Any) -> None:
    data = track_bytes(
        (),
        (),
        np.zeros((2, 0), np.int32),
        (),
        markers=[MarkerChange(frame=0, name="a", marker=LOOK)],
    )
    line, _, rest = gzip.decompress(data).partition(b"\n")
    head = json.loads(line)
    head["markers"]["changes"] = changes
    damaged = gzip.compress(json.dumps(head).encode() + b"\n" + rest)
    with pytest.raises(ResultError, match="no motion track"):
        read_track(damaged)


def test_lines_end_before_the_viewer() -> None:
    behind, before = np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, -1.0])
    assert clip_line(np.array([behind, behind])) == []
    ((begin, end),) = clip_line(np.array([behind, before]))
    assert begin[2] == pytest.approx(-0.02)
    assert end.tolist() == before.tolist()
    ((begin, end),) = clip_line(np.array([before, behind]))
    assert end[2] == pytest.approx(-0.02)


def test_a_program_cannot_make_a_track_grow_without_bounds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(motion_events, "MAX_CHANGES", 50)
    monkeypatch.setattr(motion_events, "MAX_STORED_POINTS", 300)
    with uwsim.load("remus-scene") as simulation:
        log = MarkerLog(simulation)
        for k in range(100):
            points = [Point(x=0.1 * i + k, y=0.0, z=0.0) for i in range(20)]
            new = marker(type=Marker.LINE_STRIP, points=points)
            simulation.call("SpawnMarker", SpawnMarker(marker=new))
            log.update(k)
        assert len(log.changes) == 51
        assert log.changes[-1].marker is None
        looks = [change.marker for change in log.changes if change.marker is not None]
        assert sum(len(line) for look in looks for line in look.lines) <= 300
