"""Motion tracks: what is written is read back, equal tracks are equal bytes, damage is named."""

import gzip
import json
from pathlib import Path

import numpy as np
import pytest

from tests.support.short_benchmark import run, write_benchmark
from uwsim.errors import ResultError
from uwsim.results.journal import track_path
from uwsim.results.motion import Signal, TrackLevel, load_track, read_track, track_bytes
from uwsim.results.motion.motion_track import quantise, steps_of
from uwsim.results.motion.packing import pack_table, unpack_table

LEVELS = (TrackLevel(values={"fog": 0.5}, start_time=1.0, duration=2.0, status="ok"),)
SIGNALS = (Signal(name="fog", unit="1/m"),)


@pytest.mark.parametrize("shape", [(0, 3), (1, 2), (2, 2), (3, 1), (100, 5)])
def test_packing_loses_nothing(shape: tuple[int, int]) -> None:
    random = np.random.default_rng(0)
    table = random.integers(-(2**31), 2**31, shape, dtype=np.int64).astype(np.int32)
    assert (unpack_table(pack_table(table), *shape) == table).all()


def written(n: int = 900) -> tuple[bytes, np.ndarray]:
    time = np.arange(n) / 30.0
    rows = np.zeros((n, 8))
    rows[:, 0], rows[:, 1] = np.sin(time), -0.3 * time
    rows[:, 3], rows[:, 6] = np.cos(0.1 * time), np.sin(0.1 * time)
    rows[:, 7] = 0.5
    rows[n // 2, 7] = np.nan
    table = quantise(rows, steps_of(1, SIGNALS))
    return track_bytes(["rov/base"], SIGNALS, table, LEVELS), rows


def test_a_track_is_read_back_to_its_resolution_and_a_missing_value_stays_missing() -> None:
    data, rows = written()
    track = read_track(data)
    assert track.bodies == ("rov/base",)
    assert track.levels == LEVELS
    assert track.duration == pytest.approx(899 / 30.0)
    np.testing.assert_allclose(track.poses[:, 0], rows[:, :7], atol=1e-4)
    fog = track.signal("fog")
    assert fog is not None
    assert np.isnan(fog[450])
    np.testing.assert_allclose(np.delete(fog, 450), 0.5)


def test_a_body_takes_little_room_and_equal_tracks_are_equal_bytes() -> None:
    data, _ = written(1800)
    assert len(data) < 9_000  # a minute
    assert data == written(1800)[0]


def headed(data: bytes, name: str, value: float) -> bytes:
    """The track with another value in its head."""
    line, _, rest = gzip.decompress(data).partition(b"\n")
    head = json.dumps({**json.loads(line), name: value}).encode()
    return gzip.compress(head + b"\n" + rest)


@pytest.mark.parametrize(
    "damage",
    [
        lambda data: data[:-20],
        lambda data: b"",
        lambda data: b"not a track",
        lambda data: headed(data, "rate", 0.0),
        lambda data: headed(data, "length", float("inf")),
        lambda data: headed(data, "n", float("inf")),
        lambda data: headed(data, "quaternion", 1e-320),
        lambda data: data[:40] + bytes([data[40] ^ 1]) + data[41:],
    ],
)
def test_a_damaged_track_is_an_error_that_says_so(damage: object, tmp_path: Path) -> None:
    path = tmp_path / "00000.motion"
    path.write_bytes(damage(written()[0]))  # type: ignore[operator]
    with pytest.raises(ResultError, match=r"00000\.motion: is no motion track of version 1 to 3: "):
        load_track(path)
    with pytest.raises(ResultError, match="cannot be read"):
        load_track(tmp_path / "none.motion")


DEEP = json.loads("[" * 900 + "]" * 900)


@pytest.mark.parametrize(
    "change",
    [
        {"began": [1.0]},
        {"began": 10**400},
        {"began": True},
        {"duration": "2.0"},
        {"duration": {"s": 2.0}},
        {"status": ["ok"]},
        {"status": 7},
        {"values": [0.5]},
        {"values": {"fog": [0.5]}},
        {"values": {"fog": DEEP}},
        {"more": 1.0},
    ],
)
def test_a_level_of_other_kinds_is_an_error_when_the_track_is_read(
    change: dict[str, object], tmp_path: Path
) -> None:
    line, _, rest = gzip.decompress(written(9)[0]).partition(b"\n")
    for part in ("levels", "signals"):
        head = json.loads(line)
        if part == "signals":
            name, value = next(iter(change.items()))
            change = {{"began": "step", "duration": "unit"}.get(name, "name"): value}
            if isinstance(value, str):
                continue
        head[part] = [{**head[part][0], **change}]
        path = tmp_path / "00000.motion"
        path.write_bytes(gzip.compress(json.dumps(head).encode() + b"\n" + rest))
        with pytest.raises(ResultError, match="is no motion track") as refused:
            load_track(path)
        assert "\n" not in str(refused.value)


def test_a_bench_keeps_the_motion_of_each_trial_with_its_fog_and_its_quadrangles(
    tmp_path: Path,
) -> None:
    result = run(write_benchmark(tmp_path, "0.2"), tmp_path / "out")
    track = load_track(track_path(tmp_path / "out", 0))
    assert [level.values for level in track.levels] == [{"fog": 0.0}, {"fog": 0.4}, {"fog": 0.8}]
    assert [level.status for level in track.levels] == [row[-2] for row in result.rows]
    fog = track.signal("fog")
    assert fog is not None
    for level in track.levels:
        assert level.duration == pytest.approx(0.2)
        k = round((level.start_time + 0.1) * track.rate)
        assert fog[k] == pytest.approx(level.values["fog"])
        assert np.isfinite(track.signal("truth/bowtech1/0/u")[k])  # type: ignore[index]
    assert np.isnan(track.signal("truth/bowtech1/0/u")[0])  # type: ignore[index]
    assert "girona500/base_link" in track.bodies
    run(write_benchmark(tmp_path, "0.2"), tmp_path / "again")
    assert (
        track_path(tmp_path / "again", 0).read_bytes()
        == track_path(tmp_path / "out", 0).read_bytes()
    )
