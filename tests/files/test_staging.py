"""A directory is written as a whole, and errors name it as the user does."""

from __future__ import annotations

import errno
from pathlib import Path

import pytest

from uwsim.base.files.staging import stage_directory
from uwsim.results.atomic_file import write_text


def fill_disk(draft: Path) -> None:
    write_text(draft / "first.txt", "text")
    raise OSError(errno.ENOSPC, "No space left on device", str(draft / "plots" / "a.png"))


def test_a_full_disk_names_the_file_in_the_directory_of_the_user(tmp_path: Path) -> None:
    directory = tmp_path / "out"
    with pytest.raises(OSError, match="No space") as raised, stage_directory(directory) as draft:
        fill_disk(draft)
    assert raised.value.filename == str(directory / "plots" / "a.png")
    assert not list(tmp_path.iterdir())


def test_an_error_without_a_name_names_the_directory(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="No space") as raised, stage_directory(tmp_path / "out"):
        raise OSError(errno.ENOSPC, "No space left on device")
    assert raised.value.filename == str(tmp_path / "out")


def test_a_folder_in_which_nothing_can_be_made_is_named_as_the_user_does() -> None:
    with pytest.raises(OSError) as raised, stage_directory(Path("/proc/x")):  # noqa: PT011
        pass
    assert raised.value.filename == "/proc/x"
