"""The directory of a result: its files, its lock and its checks before writing."""

from __future__ import annotations

import fcntl
import os
import re
import shutil
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

from ..errors import BadSetting
from . import journal
from .atomic_file import name_of_draft
from .provenance import load_provenance

CONTROL = "control"
"""Folder of the control's own result."""
REPORT = "report.html"
"""What a reader opens first."""
REPLAY = "replay.html"
"""The page in which the trials are seen again; made on request (``uwsim replay``)."""
OURS = re.compile(
    r"""(?x) ((?!units/|plots/|pictures/)[^/]+/)? (control/)? (
        result\.json | measures\.json | result\.dat | summary\.csv | provenance\.json
      | report\.html | replay\.html
      | measure-[^/]+\.csv | benchmark-[^/]+\.data
      | units/\d+\.(jsonl|motion|inputs|part)
      | plots/[^/]+\.(png|pdf)
      | pictures/\d+-[^/]+\.png(\.part)?
    )"""
)
"""Files that uwsim writes into a result directory, or into folders of it for each algorithm; each
may have drafts next to it."""
FOLDERS = (journal.FOLDER, "plots", "pictures", CONTROL)


@contextmanager
def prepared(
    directory: Path, *, resume: bool, overwrite: bool, results: Sequence[str] = ()
) -> Iterator[None]:
    """Lock ``directory`` and empty it for one or several results.

    Nothing is removed before the directory is one's own, and nothing is gone on with that uwsim
    has not begun.

    Args:
        directory: need not be there.
        resume: whether what is there is to be gone on with.
        overwrite: whether what is there is to be replaced.
        results: names of the folders of several results.

    Raises:
        BadSetting: it is not empty and neither option was given; or it is to be overwritten and
        holds
            anything that uwsim did not write; or it is to be gone on with and holds no run; or
            another run is writing into it.
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
        discard_drafts(directory, OURS, (*FOLDERS, *results))
        yield


def check(directory: Path, *, resume: bool, overwrite: bool, results: Sequence[str] = ()) -> None:
    """Make the checks of `prepared` but that of the lock; changes nothing."""
    if resume and overwrite:
        raise BadSetting("--resume and --overwrite exclude each other.")
    folders = (*FOLDERS, *results)
    if resume:
        check_begun(directory, ours=OURS, folders=folders, results=results)
    else:
        hint = "Use --resume to go on, or --overwrite to start anew."
        check_room(directory, overwrite=overwrite, ours=OURS, folders=folders, hint=hint)


def check_begun(
    directory: Path,
    *,
    ours: re.Pattern[str],
    folders: tuple[str, ...],
    results: Sequence[str] = (),
) -> None:
    """Refuse to resume in a directory with other files; changes nothing.

    What a run leaves that was killed before it wrote anything is empty folders, and drafts.

    Args:
        directory: need not be there.
        ours: names of the files that uwsim writes there, relative to it.
        folders: names of the folders that it writes there.
        results: names of the folders of several results; a result is the directory itself if
            there are none.

    Raises:
        BadSetting: it is no directory; or one of those that are to be written into holds
            something, but no run that uwsim has begun.
    """
    _refuse_file(directory)
    places = [directory / name for name in results] or [directory]
    if results and not any(map(is_begun, places)):
        places = [directory]
    for place in places:
        if is_begun(place):
            continue
        held = next(_kept(place, ours, folders), None)
        if held is not None:
            raise BadSetting(
                f"--out {place}: holds {held!r}, and no run of uwsim to resume; "
                "nothing was changed. Without --resume a new directory is begun."
            )


def is_begun(directory: Path) -> bool:
    """Whether a run was begun here: it has a provenance or a journal."""
    if isinstance(load_provenance(directory).get("command"), list):
        return True
    files = sorted((directory / journal.FOLDER).glob("*.jsonl"))
    return any("run" in journal.head_of(file) for file in files)


def make_room(
    directory: Path,
    *,
    overwrite: bool,
    ours: re.Pattern[str],
    folders: tuple[str, ...],
    hint: str = "Use --overwrite to replace what is there.",
) -> None:
    """Empty a directory if ``overwrite`` is set; refuses foreign files (`check_room`)."""
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
        overwrite: whether the directory may be emptied.
        ours: names of the files that uwsim writes there, relative to it.
        folders: names of the folders that it writes there.
        hint: what to do about one that is not empty.

    Raises:
        BadSetting: it is no directory; it is not empty and may not be emptied; or it holds anything
            that uwsim does not write there.
    """
    _refuse_file(directory)
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


def discard_drafts(directory: Path, ours: re.Pattern[str], folders: tuple[str, ...]) -> None:
    """Remove what processes that were killed had not finished writing, of our own files only."""
    for path, is_ours in _files(directory, ours, folders):
        if is_ours and name_of_draft(path.name) is not None:
            (directory / path).unlink(missing_ok=True)


def _strange(directory: Path, ours: re.Pattern[str], known: tuple[str, ...]) -> Iterator[str]:
    """Names, relative to the directory, of files that uwsim did not write."""
    return (str(path) for path, is_ours in _files(directory, ours, known) if not is_ours)


def _kept(directory: Path, ours: re.Pattern[str], known: tuple[str, ...]) -> Iterator[str]:
    """Names, relative to the directory, of what is neither an empty folder nor a draft of ours."""
    for path, is_ours in _files(directory, ours, known):
        if not is_ours or name_of_draft(path.name) is None:
            yield str(path)


def _files(
    directory: Path, ours: re.Pattern[str], known: tuple[str, ...]
) -> Iterator[tuple[Path, bool]]:
    """Files, relative to the directory, and whether uwsim wrote them.

    A folder that is not known, and a link, is one that it did not write; no other is looked into.
    """
    for folder, folders, files in os.walk(directory):
        here = Path(folder).relative_to(directory)
        strange = [n for n in folders if n not in known or (Path(folder) / n).is_symlink()]
        folders[:] = sorted(set(folders) - set(strange))
        yield from ((here / name, False) for name in sorted(strange))
        for name in sorted(files):
            finished = here / (name_of_draft(name) or name)
            is_link = (directory / here / name).is_symlink()
            yield here / name, not is_link and ours.fullmatch(finished.as_posix()) is not None


def _refuse_file(directory: Path) -> None:
    if directory.exists() and not directory.is_dir():
        raise BadSetting(f"--out {directory}: is a file, not a directory.")


@contextmanager
def alone_in(directory: Path) -> Iterator[None]:
    """Lock a result directory, which is made if necessary.

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
