"""A recording on a full disk keeps the messages that were accepted, and is a valid file."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import numpy as np
import pytest
from rosbags.highlevel import AnyReader

from uwsim.bus import Bus
from uwsim.errors import BadSetting, RunFailed
from uwsim.messages import Float64, UInt8MultiArray
from uwsim.middleware.recording import Recorder

SUFFIXES = (".mcap", ".bag")
pytestmark = pytest.mark.skipif(
    not hasattr(os, "posix_fallocate"), reason="the system cannot reserve space"
)


class SmallDisk:
    """A disk of a limited size, as `os.posix_fallocate` and the file's size show it."""

    def __init__(self, size: int, monkeypatch: pytest.MonkeyPatch) -> None:
        self.size = size
        monkeypatch.setattr(os, "posix_fallocate", self._allocate)

    def _allocate(self, file: int, start: int, size: int) -> None:
        if start + size > self.size:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        os.ftruncate(file, max(os.fstat(file).st_size, start + size))


def record(path: Path, n_steps: int, n_bytes: int = 5000) -> None:
    """Record noise, which no compression makes smaller, and a number in each step."""
    bus, now, rng = Bus(), [0.0], np.random.default_rng(1)
    numbers, noise = bus.publisher("/depth", Float64), bus.publisher("/noise", UInt8MultiArray)
    with Recorder(bus, path) as recorder:
        recorder.start(lambda: now[0])
        for step in range(n_steps):
            now[0] = 0.1 * step
            numbers(Float64(data=float(step)))
            noise(UInt8MultiArray(data=rng.integers(0, 256, n_bytes, np.uint8)))
            bus.deliver()
            recorder.check()


@pytest.mark.parametrize("suffix", SUFFIXES)
@pytest.mark.parametrize("size", [200_000, 3_000_000, 7_654_321])
def test_a_recording_is_complete_up_to_the_time_at_which_the_disk_was_full(
    tmp_path: Path, suffix: str, size: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    SmallDisk(size, monkeypatch)
    path = tmp_path / f"run{suffix}"
    with pytest.raises(RunFailed, match=r"No space left on device: .*complete up to") as raised:
        record(path, 3000)
    end = float(str(raised.value).split("up to ")[1].split(" s")[0])
    assert size - 1_500_000 < path.stat().st_size <= size
    with AnyReader([path]) as reader:
        times = [time for connection, time, _ in reader.messages() if connection.topic == "/depth"]
    n_complete = round(10 * end)
    assert n_complete > 10
    assert times[:n_complete] == [10**8 * i for i in range(n_complete)]
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_a_disk_without_space_for_anything_is_an_error_before_the_run(
    tmp_path: Path, suffix: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    SmallDisk(10_000, monkeypatch)
    with pytest.raises(BadSetting, match=r"cannot be written: No space left on device"):
        record(tmp_path / f"run{suffix}", 10)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_reserved_space_changes_no_byte(
    tmp_path: Path, suffix: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    record(tmp_path / f"with{suffix}", 500)
    monkeypatch.delattr(os, "posix_fallocate")
    record(tmp_path / f"without{suffix}", 500)
    first, second = ((tmp_path / f"{name}{suffix}").read_bytes() for name in ("with", "without"))
    assert first == second
