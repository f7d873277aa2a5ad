"""``uwsim check``: every fault of scene, robot and benchmark files at once, with its line."""

from __future__ import annotations

from pathlib import Path, PurePosixPath
from typing import Annotated

import typer

from ..errors import Fault, FileError
from .faults import WRONG_INPUT, printable


def check(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE.xml ...", help="Scenes, robots, benchmarks.")
    ],
    scene: Annotated[
        Path | None,
        typer.Option(metavar="SCENE.xml", help="The scene that the benchmarks play in."),
    ] = None,
    strict: Annotated[
        bool, typer.Option("--strict", help="Also hold files against the original's order.")
    ] = False,
    data_path: Annotated[
        list[Path] | None,
        typer.Option(metavar="DIR", help="Look for files here, too; may be repeated."),
    ] = None,
) -> None:
    """Say everything that is wrong with scene, robot and benchmark files.

    Exit status 0 without faults, else 2; what is read and not simulated yet is a notice.
    """
    folders = tuple(data_path or ())
    asked = [*files, *([scene] if scene is not None and scene not in files else [])]
    n_faults = 0
    for file in asked:
        found = faults_of(file, strict=strict, data_path=folders)
        wrong = [fault for fault in found if fault.severity == "fault"]
        n_faults += len(wrong)
        for fault in found:
            mark = "" if fault.severity == "fault" else " (notice)"
            typer.echo(printable(f"{fault}{mark}"))
        typer.echo(printable(f"{file}: {_count(len(wrong))}"))
    if n_faults:
        raise typer.Exit(WRONG_INPUT)


def faults_of(file: Path, *, strict: bool = False, data_path: tuple[Path, ...] = ()) -> list[Fault]:
    """Return everything wrong or worth knowing about a file; its root element says its kind."""
    from ..dialect import parse
    from ..scene.reader import ROOT, check_robot, check_scene

    try:
        root = str(parse(file).root.tag)
    except FileError as error:
        return list(error.faults)
    library = Folders(data_path)
    if root == "robot":
        return check_robot(file, library=library)
    if root == "benchmark":
        from ..benchmark.reader import check_benchmark

        return check_benchmark(file, strict=strict)
    if root == ROOT:
        return check_scene(file, strict=strict, library=library)
    message = f"the root element is <{root[:60]}>; expected <{ROOT}>, <benchmark> or <robot>"
    return [Fault(file=str(file), line=1, message=message)]


class Folders:
    """Files and models in the folders that `uwsim.assets` searches."""

    def __init__(self, data_path: tuple[Path, ...]) -> None:
        self._data_path = data_path

    def find(self, name: str, beside: Path) -> Path | None:
        """Return the file ``name``, which the file ``beside`` names."""
        from ..assets import find

        return find(name, beside=beside, data_path=self._data_path)

    def has_model(self, name: str, beside: Path) -> bool:
        """Tell whether there is a model of that name: its file, its stem's, or a stand-in."""
        from ..assets import READABLE, STAND_INS

        stem = name.rpartition(".")[0] or name
        if any(self.find(each, beside) for each in (name, *(stem + end for end in READABLE))):
            return True
        parts = PurePosixPath(stem.replace("\\", "/")).parts
        return any("/".join(parts[k:]) in STAND_INS for k in range(len(parts)))

    def searched(self, beside: Path) -> str:
        """Return the folders that were searched, those that exist."""
        from ..assets import folders_searched

        folders = folders_searched(beside=beside, data_path=self._data_path)
        return ", ".join(str(folder) for folder in folders if folder.is_dir())


def _count(number: int) -> str:
    return {0: "no faults", 1: "1 fault"}.get(number, f"{number} faults")
