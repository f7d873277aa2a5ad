"""A copy of a bundled scene or benchmark, with the files that it reads, for the user to edit."""

from __future__ import annotations

from pathlib import Path, PurePosixPath

from ..assets.bundled import bundled_files
from ..assets.find import PACKAGE
from ..base.files.input_files import InputFile, record_inputs
from ..errors import BadSetting, UnknownName
from ..physics.compile_scene import compile_scene
from ..results.atomic_file import atomic_write
from ..scene.reader import read_scene
from ..simulation import Simulation
from .planning.make_plan import make_plan
from .planning.plan_request import PlanRequest
from .prepare import hash_inputs

KINDS = ("scenes", "benchmarks")
SHARED_FOLDERS = ("scenes", "benchmarks", "vehicles")
"""The folders of the package whose files are copied directly into the target folder."""


def copyable_names() -> list[str]:
    """Return the names of all bundled scenes and benchmarks."""
    return [name for kind in KINDS for name in bundled_files(kind)]


def copy_bundled(name: str, folder: Path, *, overwrite: bool = False) -> list[Path]:
    """Copy a bundled scene or benchmark with every bundled file that it reads.

    The copied scene finds the copies before the bundled files. Stand-ins, which are models that
    uwsim generates, have no file and are not copied; the scene names them as before.

    Args:
        name: the name of the scene or benchmark, with or without ``.xml``.
        folder: the folder of the copies; it is created if it does not exist.
        overwrite: whether existing files are replaced.

    Returns:
        The paths of the copies, the named file first.

    Raises:
        UnknownName: no scene or benchmark has that name.
        BadSetting: a file exists already.
    """
    files = _files_of(name.removesuffix(".xml"))
    copies = {folder / _relative_copy(file.path): file.path for file in files}
    existing_copy = next((copy for copy in copies if copy.exists()), None)
    if existing_copy is not None and not overwrite:
        raise BadSetting(
            f"{existing_copy} exists already. Name another folder, or replace it with --overwrite."
        )
    for copy, source in copies.items():
        copy.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(copy) as draft:
            draft.write_bytes(source.read_bytes())
    return list(copies)


def _files_of(name: str) -> list[InputFile]:
    scenes, benchmarks = (bundled_files(kind) for kind in KINDS)
    with record_inputs() as files:
        if name in scenes:
            Simulation(compile_scene(read_scene(scenes[name]))).close()
        elif name in benchmarks:
            hash_inputs(make_plan(PlanRequest(benchmark=name)))
        else:
            raise UnknownName("bundled scene or benchmark", name, copyable_names())
    paths = {file.path: file for file in files}
    data_files = [
        file for path, file in paths.items() if path.suffix != ".py" and _is_bundled(path)
    ]
    return sorted(data_files, key=lambda file: file.path.stem != name)


def _is_bundled(path: Path) -> bool:
    return path.is_relative_to(PACKAGE / "data")


def _relative_copy(path: Path) -> PurePosixPath:
    """Return the path of the copy of a bundled file, relative to the target folder."""
    relative_path = path.relative_to(PACKAGE / "data")
    kind, *parts = relative_path.parts
    return PurePosixPath(*parts) if kind in SHARED_FOLDERS else PurePosixPath(*relative_path.parts)
