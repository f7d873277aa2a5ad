"""The directory of a result: what may stand in it, and who may write into it."""

from __future__ import annotations

import fcntl
import os
import re
import shutil
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

from ..errors import BadSetting
from .whole_file import discard_drafts

CONTROL = "control"
"""Folder of the control's own result."""
REPORT = "report.html"
"""What a reader opens first."""
OURS = re.compile(
    r"""(?x) ((?!units/|plots/|pictures/)[^/]+/)? (control/)? (
        result\.json | result\.dat | summary\.csv | provenance\.json | report\.html
      | measure-[^/]+\.csv | benchmark-[^/]+\.data
      | units/\d+\.(jsonl|part)
      | plots/[^/]+\.(png|pdf)
      | pictures/\d+-[^/]+\.png(\.part)?
      | (plots/|units/|pictures/)?\.[^/]+\.part
    )"""
)
"""Files that uwsim writes into a result directory, or into folders of it for each algorithm."""
FOLDERS = ("units", "plots", "pictures", CONTROL)


@contextmanager
def prepared(
    directory: Path, *, resume: bool, overwrite: bool, results: Sequence[str] = ()
) -> Iterator[None]:
    """Keep other runs out of ``directory``, and make room in it for a result, or several.

    Nothing is removed before the directory is one's own.

    Args:
        directory: need not be there.
        resume: whether what is there is to be gone on with.
        overwrite: whether what is there is to be replaced.
        results: names of the folders of several results.

    Raises:
        BadSetting: it is not empty and nothing was said; or it is to be overwritten and holds
            anything that uwsim did not write; or another run is writing into it.
    """
    with ExitStack() as stack:
        stack.enter_context(alone_in(directory))
        check(directory, resume=resume, overwrite=overwrite, results=results)
        for name in results:
            stack.enter_context(alone_in(directory / name))
        if not resume:
            for name in results:
                empty(directory / name)
            empty(directory, keep=results)
        discard_drafts(directory)
        yield


def check(directory: Path, *, resume: bool, overwrite: bool, results: Sequence[str] = ()) -> None:
    """Refuse what `prepared` refuses but another run; nothing is changed."""
    if resume and overwrite:
        raise BadSetting("--resume and --overwrite exclude each other.")
    if not resume:
        hint = "Use --resume to go on, or --overwrite to start anew."
        folders = (*FOLDERS, *results)
        check_room(directory, overwrite=overwrite, ours=OURS, folders=folders, hint=hint)


def make_room(
    directory: Path,
    *,
    overwrite: bool,
    ours: re.Pattern[str],
    folders: tuple[str, ...],
    hint: str = "Use --overwrite to replace what is there.",
) -> None:
    """Empty a directory, if that was said and all in it is of our making; see `check_room`."""
    check_room(directory, overwrite=overwrite, ours=ours, folders=folders, hint=hint)
    empty(directory)


def check_room(
    directory: Path,
    *,
    overwrite: bool,
    ours: re.Pattern[str],
    folders: tuple[str, ...],
    hint: str,
) -> None:
    """Refuse a directory that may not be emptied; nothing is changed.

    Args:
        directory: need not be there.
        overwrite: whether it was said.
        ours: names of the files that uwsim writes there, relative to it.
        folders: names of the folders that it writes there.
        hint: what to do about one that is not empty.

    Raises:
        BadSetting: it is no directory; it is not empty and nothing was said; or it holds anything
            that uwsim does not write there.
    """
    if directory.exists() and not directory.is_dir():
        raise BadSetting(f"--out {directory}: is a file, not a directory.")
    if not directory.is_dir() or not any(directory.iterdir()):
        return
    if not overwrite:
        raise BadSetting(f"--out {directory}: not empty. {hint}")
    strange = next(_strange(directory, ours, folders), None)
    if strange is not None:
        raise BadSetting(
            f"--out {directory}: holds {strange!r}, which does not belong there; "
            "nothing was overwritten."
        )


def empty(directory: Path, keep: Sequence[str] = ()) -> None:
    """Remove all that is in a directory, which need not be there, but what is to be kept."""
    if not directory.is_dir():
        return
    for name in [path.name for path in directory.iterdir() if path.name not in keep]:
        path = directory / name
        shutil.rmtree(path) if path.is_dir() and not path.is_symlink() else path.unlink()


def _strange(directory: Path, ours: re.Pattern[str], known: tuple[str, ...]) -> Iterator[str]:
    """Names, relative to the directory, of what uwsim did not write."""
    for folder, folders, files in os.walk(directory):
        here = Path(folder).relative_to(directory)
        for name in sorted(folders):
            path = here / name
            if name not in known or (directory / path).is_symlink():
                yield str(path)
        for name in sorted(files):
            path = here / name
            if not ours.fullmatch(path.as_posix()) or (directory / path).is_symlink():
                yield str(path)


@contextmanager
def alone_in(directory: Path) -> Iterator[None]:
    """Keep other runs out of a result directory, which is made if need be.

    Raises:
        BadSetting: another run is writing into it.
    """
    directory.mkdir(parents=True, exist_ok=True)
    handle = os.open(directory, os.O_RDONLY)
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            raise BadSetting(f"--out {directory}: another run is writing into it.") from None
        yield
    finally:
        os.close(handle)
