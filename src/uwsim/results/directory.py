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

CONTROL_FOLDER = "control"
"""The folder of the result of the control run."""
INPUTS_FOLDER = "inputs"
"""The folder of the scene and the benchmark that a Python program has made for the run."""
REPORT = "report.html"
"""The page with the report of a result."""
REPLAY = "replay.html"
"""The page that replays the trials; ``uwsim replay`` writes it."""
FILE_NAMES = re.compile(
    r"""(?x) ((?!units/|plots/|pictures/|inputs/)[^/]+/)? (control/)? (
        result\.json | measures\.json | result\.dat | summary\.csv | provenance\.json
      | report\.html | replay\.html
      | measure-[^/]+\.csv | benchmark-[^/]+\.data
      | units/\d+\.(jsonl|motion|inputs|part)
      | plots/[^/]+\.(png|pdf)
      | pictures/\d+-[^/]+\.png(\.part)?
      | inputs/[^/]+\.(xml|csv)
    )"""
)
"""The paths of the files that uwsim writes into a result directory, or into its subfolder for each
algorithm; each file may have drafts next to it."""
FOLDERS = (journal.FOLDER, "plots", "pictures", CONTROL_FOLDER, INPUTS_FOLDER)


@contextmanager
def prepare_directory(
    directory: Path, *, resume: bool, overwrite: bool, results: Sequence[str] = ()
) -> Iterator[None]:
    """Lock ``directory`` and empty it for one or several results.

    Nothing is removed before the lock is held. Only a run that uwsim has begun is resumed.

    Args:
        directory: the directory, which need not exist.
        resume: whether to continue the run in the directory.
        overwrite: whether to replace the content of the directory.
        results: the subfolders for several results; empty if the directory itself is the result.

    Raises:
        BadSetting: the directory is not empty and neither option is set; or it is to be
            overwritten and holds files that uwsim did not write; or it holds no run to resume; or
            another run is writing into it.
    """
    with ExitStack() as stack:
        stack.enter_context(lock_directory(directory))
        check(directory, resume=resume, overwrite=overwrite, results=results)
        for name in results:
            stack.enter_context(lock_directory(directory / name))
        if not resume:
            for name in results:
                empty(directory / name)
            empty(directory, keep=results)
        discard_drafts(directory, FILE_NAMES, (*FOLDERS, *results))
        yield


def check(directory: Path, *, resume: bool, overwrite: bool, results: Sequence[str] = ()) -> None:
    """Make the checks of `prepare_directory`, except for the lock; change nothing."""
    if resume and overwrite:
        raise BadSetting("--resume and --overwrite exclude each other.")
    folders = (*FOLDERS, *results)
    if resume:
        check_resume(directory, pattern=FILE_NAMES, folders=folders, results=results)
    else:
        hint = "Use --resume to continue, or --overwrite to start anew."
        check_output(directory, overwrite=overwrite, pattern=FILE_NAMES, folders=folders, hint=hint)


def check_resume(
    directory: Path,
    *,
    pattern: re.Pattern[str],
    folders: tuple[str, ...],
    results: Sequence[str] = (),
) -> None:
    """Refuse to resume in a directory with other files; change nothing.

    A run that was killed before it wrote a row leaves empty folders and drafts.

    Args:
        directory: the directory, which need not exist.
        pattern: the paths of the files that uwsim writes there, relative to the directory.
        folders: the names of the folders that uwsim creates there.
        results: the subfolders for several results; empty if the directory itself is the result.

    Raises:
        BadSetting: the path is not a directory; or a folder that is to be written into holds
            files, but no run of uwsim.
    """
    _refuse_file(directory)
    result_folders = [directory / name for name in results] or [directory]
    if results and not any(map(is_begun, result_folders)):
        result_folders = [directory]
    for folder in result_folders:
        if is_begun(folder):
            continue
        file_name = next(_finished_files(folder, pattern, folders), None)
        if file_name is not None:
            raise BadSetting(
                f"--out {folder}: holds {file_name!r}, but no run of uwsim to resume; "
                "nothing was changed. Omit --resume to begin a new run."
            )


def is_begun(directory: Path) -> bool:
    """Return whether a run was begun here: the directory has a provenance or a journal."""
    if isinstance(load_provenance(directory).get("command"), list):
        return True
    files = sorted((directory / journal.FOLDER).glob("*.jsonl"))
    return any("run" in journal.head_of(file) for file in files)


def clear_directory(
    directory: Path,
    *,
    overwrite: bool,
    pattern: re.Pattern[str],
    folders: tuple[str, ...],
    hint: str = "Use --overwrite to replace its content.",
) -> None:
    """Empty a directory if ``overwrite`` is set; refuse foreign files (`check_output`)."""
    check_output(directory, overwrite=overwrite, pattern=pattern, folders=folders, hint=hint)
    empty(directory)


def check_output(
    directory: Path,
    *,
    overwrite: bool,
    pattern: re.Pattern[str],
    folders: tuple[str, ...],
    hint: str,
) -> None:
    """Refuse a directory that may not be emptied; change nothing.

    Args:
        directory: the directory, which need not exist.
        overwrite: whether the directory may be emptied.
        pattern: the paths of the files that uwsim writes there, relative to the directory.
        folders: the names of the folders that uwsim creates there.
        hint: the sentence of the error message that names options for a non-empty directory.

    Raises:
        BadSetting: the path is not a directory; it is not empty and may not be emptied; or it
            holds files that uwsim does not write there.
    """
    _refuse_file(directory)
    if not directory.is_dir() or not any(directory.iterdir()):
        return
    if not overwrite:
        raise BadSetting(f"--out {directory}: not empty. {hint}")
    names = (str(path) for path, is_ours in _files(directory, pattern, folders) if not is_ours)
    file_name = next(names, None)
    if file_name is not None:
        raise BadSetting(
            f"--out {directory}: holds {file_name!r}, which does not belong there; "
            "nothing was overwritten."
        )


def empty(directory: Path, keep: Sequence[str] = ()) -> None:
    """Remove the content of a directory, which need not exist, except entries with these names."""
    if not directory.is_dir():
        return
    for name in [path.name for path in directory.iterdir() if path.name not in keep]:
        path = directory / name
        shutil.rmtree(path) if path.is_dir() and not path.is_symlink() else path.unlink()


def discard_drafts(directory: Path, pattern: re.Pattern[str], folders: tuple[str, ...]) -> None:
    """Remove drafts of uwsim's files that killed processes have left."""
    for path, is_ours in _files(directory, pattern, folders):
        if is_ours and name_of_draft(path.name) is not None:
            (directory / path).unlink(missing_ok=True)


def _finished_files(
    directory: Path, pattern: re.Pattern[str], folders: tuple[str, ...]
) -> Iterator[str]:
    """Yield the paths, relative to the directory, of all files except drafts of uwsim."""
    for path, is_ours in _files(directory, pattern, folders):
        if not is_ours or name_of_draft(path.name) is None:
            yield str(path)


def _files(
    directory: Path, pattern: re.Pattern[str], folders: tuple[str, ...]
) -> Iterator[tuple[Path, bool]]:
    """Yield the path of each file, relative to the directory, and whether uwsim wrote the file.

    Unknown folders and links count as files that uwsim did not write; their content is not read.
    """
    for root, subfolders, files in os.walk(directory):
        parent = Path(root).relative_to(directory)
        extra_names = [n for n in subfolders if n not in folders or (Path(root) / n).is_symlink()]
        subfolders[:] = sorted(set(subfolders) - set(extra_names))
        yield from ((parent / name, False) for name in sorted(extra_names))
        for name in sorted(files):
            target = parent / (name_of_draft(name) or name)
            is_link = (directory / parent / name).is_symlink()
            yield parent / name, not is_link and pattern.fullmatch(target.as_posix()) is not None


def _refuse_file(directory: Path) -> None:
    if directory.exists() and not directory.is_dir():
        raise BadSetting(f"--out {directory}: is a file, not a directory.")


@contextmanager
def lock_directory(directory: Path) -> Iterator[None]:
    """Lock a result directory, which is created if necessary.

    Raises:
        BadSetting: another run is writing into the directory.
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
