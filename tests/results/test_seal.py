"""What is written during a run is unreadable until it ends, however it ends."""

from __future__ import annotations

import fcntl
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.stored_rows import stored_end, stored_row
from tests.support.waiting import wait_until
from uwsim.errors import ResultError
from uwsim.results import journal
from uwsim.results.seal import Keeper, Seal

HEAD = {"inputs": {}, "run": {}, "seed": 7, "levels": [[0.5]]}
ROW = stored_row(
    values=[0.5],
    measures={"corners": [1.25, "px"]},
    total=1.25,
    logs={"corners": [[0.5, 17.125]]},
    log_headers={"corners": ["total [px]"]},
)
END = stored_end()


def written(folder: Path, seal: Seal | None, index: int = 0, *, ends: bool = True) -> Path:
    file = journal.Journal(folder, index, HEAD, seal)
    file.add(ROW)
    if ends:
        file.finish(END)
    file.close()
    return journal.path_of(folder, index)


@pytest.mark.parametrize("n", [0, 1, 31, 32, 33, 1_000_003])
def test_what_is_sealed_is_opened_by_the_same_key_alone(n: int) -> None:
    seal, data = Seal(), os.urandom(n)
    closed = seal.encrypt(data)
    assert seal.decrypt(closed) == data
    assert n < 16 or data not in closed
    assert seal.encrypt(data) != closed
    for wrong in (closed[:-1], closed + b"\0", closed[:40] + b"\0" + closed[41:], b""):
        if wrong != closed:
            with pytest.raises(ValueError, match="changed"):
                seal.decrypt(wrong)
    with pytest.raises(ValueError, match="changed"):
        Seal().decrypt(closed)


def test_rows_are_read_with_the_key_and_do_not_exist_without_it(tmp_path: Path) -> None:
    seal = Seal()
    path = written(tmp_path, seal)
    assert b"17.125" not in path.read_bytes()
    assert len(journal.read(tmp_path, 0, HEAD, seal).rows) == 1
    assert journal.read(tmp_path, 0, HEAD) == journal.EMPTY_JOURNAL
    assert journal.head_of(path) == HEAD
    with pytest.raises(ResultError, match="sealed row cannot be read"):
        journal.read(tmp_path, 0, HEAD, Seal())


def test_a_run_that_was_sealed_leaves_the_bytes_of_one_that_was_not(tmp_path: Path) -> None:
    seal = Seal()
    plain = written(tmp_path / "plain", None)
    path = written(tmp_path / "sealed", seal)
    track = journal.track_path(tmp_path / "sealed", 0)
    track.write_bytes(seal.file(b"motion"))
    foreign = journal.track_path(tmp_path / "sealed", 1)
    foreign.write_bytes(Seal().file(b"of another run"))
    kept = foreign.read_bytes()
    seal.open_all(tmp_path / "sealed")
    assert path.read_bytes() == plain.read_bytes()
    assert track.read_bytes() == b"motion"
    assert foreign.read_bytes() == kept
    assert sorted(each.name for each in path.parent.iterdir()) == [
        "00000.jsonl",
        "00000.motion",
        "00001.motion",
    ]


def test_rows_of_an_earlier_part_are_compared_with_sealed_ones(tmp_path: Path) -> None:
    written(tmp_path, None, ends=False)
    seal = Seal()
    file = journal.Journal(tmp_path, 0, HEAD, seal)
    assert file.add(ROW) is False
    file.finish(END)
    seal.open_all(tmp_path)
    assert len(journal.read(tmp_path, 0, HEAD).rows) == 1


KILLED = """
import signal, sys
from pathlib import Path
from tests.results.test_seal import written
from uwsim.results.seal import Keeper, Seal

folder, seal = Path(sys.argv[1]), Seal()
folder.mkdir()
keeper = Keeper(seal, [folder])
written(folder, seal)
print("ready", flush=True)
signal.pause()
"""


def test_the_rows_of_a_run_that_is_killed_are_opened(tmp_path: Path) -> None:
    plain = written(tmp_path / "plain", None)
    root = Path(__file__).parents[2]
    with subprocess.Popen(
        [sys.executable, "-c", KILLED, str(tmp_path / "killed")], stdout=subprocess.PIPE, cwd=root
    ) as run:
        assert run.stdout is not None
        assert run.stdout.readline() == b"ready\n"
        path = journal.path_of(tmp_path / "killed", 0)
        assert b"17.125" not in path.read_bytes()
        run.send_signal(signal.SIGKILL)
    wait_until(lambda: path.read_bytes() == plain.read_bytes())


def test_a_keeper_that_is_dismissed_ends_and_has_its_key_in_no_argument(tmp_path: Path) -> None:
    seal = Seal()
    keeper = Keeper(seal, [tmp_path])
    words = Path(f"/proc/{keeper._process.pid}/cmdline").read_bytes()
    assert seal.key.hex().encode() not in words
    keeper.close()
    assert keeper._process.returncode == 0


def test_a_keeper_that_is_not_needed_does_not_wait_for_the_lock_of_the_run(
    tmp_path: Path,
) -> None:
    keeper = Keeper(Seal(), [tmp_path])
    handle = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(handle, fcntl.LOCK_EX)  # as a run holds it until it has written its result
    keeper.close(is_all_open=True)
    os.close(handle)
    assert keeper._process.returncode == 0  # not killed for its patience


def test_whether_all_files_could_be_opened_is_known(tmp_path: Path) -> None:
    seal = Seal()
    path = written(tmp_path, seal)
    blocked = path.with_name(f".{path.name}.{os.getpid()}.part")
    blocked.mkdir()
    assert not seal.open_all(tmp_path)
    blocked.rmdir()
    assert seal.open_all(tmp_path)
    assert b"17.125" in path.read_bytes()


def test_memory_of_a_process_is_denied_to_others() -> None:
    asks = "import ctypes; print(ctypes.CDLL(None).prctl(3, 0, 0, 0, 0))"
    denies = "from uwsim.results.seal import deny_access_to_memory as deny; deny(); "
    before, after = (
        subprocess.run([sys.executable, "-c", code], capture_output=True, check=True, text=True)
        for code in (asks, denies + asks)
    )
    assert (before.stdout.strip(), after.stdout.strip()) == ("1", "0")
