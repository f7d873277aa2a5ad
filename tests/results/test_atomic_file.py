"""A file is there whole or not at all, whoever else writes it."""

from __future__ import annotations

import errno
import subprocess
import sys
from pathlib import Path

import pytest

from uwsim.results.atomic_file import atomic_write, write_text

OTHER = """
import sys
from pathlib import Path
from uwsim.results.atomic_file import write_text
write_text(Path(sys.argv[1]), "other")
"""


def test_two_processes_may_write_one_file_at_once(tmp_path: Path) -> None:
    file = tmp_path / "report.html"
    with atomic_write(file) as draft:
        draft.write_text("mine")
        subprocess.run([sys.executable, "-c", OTHER, str(file)], check=True)
        assert file.read_text() == "other"
    assert file.read_text() == "mine"
    assert list(tmp_path.iterdir()) == [file]


def test_what_could_not_be_written_leaves_the_old_file_and_no_draft(tmp_path: Path) -> None:
    file = tmp_path / "result.dat"
    write_text(file, "old")
    with pytest.raises(UnicodeEncodeError):
        write_text(file, "new \udcff")
    assert file.read_text() == "old"
    assert list(tmp_path.iterdir()) == [file]


def test_a_full_disk_names_the_file(tmp_path: Path) -> None:
    path = tmp_path / "result.json"

    def write() -> None:
        with atomic_write(path) as draft:
            draft.write_text("half")
            raise OSError(errno.ENOSPC, "No space left on device")

    with pytest.raises(OSError, match="No space left") as caught:
        write()
    assert caught.value.filename == str(path)
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(FileNotFoundError) as lost:
        write_text(tmp_path / "nowhere" / "a.txt", "a")
    assert lost.value.filename == str(tmp_path / "nowhere" / "a.txt")
