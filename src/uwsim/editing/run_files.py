"""The files of a run whose benchmark or scene a program has made."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from pathlib import Path

from ..errors import FileError, SeveralErrors
from ..results.directory import INPUTS_FOLDER
from .benchmark import Benchmark
from .file_names import copy_tables
from .scene import Scene
from .text_diagnostics import locate_diagnostics


@dataclass(frozen=True, kw_only=True)
class RunFiles:
    """The benchmark and the scene of a run as files."""

    benchmark: str
    """The benchmark file, or a bundled name."""
    scene: str | None
    """The scene file, or a bundled name; None: the scene that the benchmark names."""
    folders: tuple[Path, ...] = ()
    """The folders in which the files that they name are searched."""
    plugins: tuple[Path, ...] = ()
    """The plugins of the benchmark."""
    written_files: tuple[Path, ...] = ()
    """The files that were written, which the result keeps."""


def write_run_files(
    benchmark: str | Path | Benchmark, scene: str | Path | Scene | None, folder: Path
) -> RunFiles:
    """Write a benchmark and a scene that a program has made into a folder.

    The written benchmark names the written scene.

    Raises:
        UwsimError: the benchmark or the scene is invalid.
    """
    written_files: list[Path] = []
    folders: list[Path] = []
    plugins: tuple[Path, ...] = ()
    if isinstance(scene, Scene):
        scene.checked_spec()
        file = folder / _file_name(scene.path, "scene.xml")
        if isinstance(benchmark, Benchmark) and file.name == _file_name(benchmark.path, ""):
            file = folder / f"{file.stem}-scene.xml"
        file.write_text(scene.to_xml(), encoding="utf-8")
        written_files.append(file)
        folders += scene.folders()
        scene = str(file)
    if isinstance(benchmark, Benchmark):
        new_benchmark = Benchmark(benchmark.checked_spec(), plugins=benchmark._plugins)
        file = folder / _file_name(benchmark.path, "benchmark.xml")
        if written_files:
            new_benchmark.scene = written_files[0].name
        written_files += copy_tables(new_benchmark, benchmark.path, file)
        file.write_text(new_benchmark.to_xml(), encoding="utf-8")
        written_files.append(file)
        folders += benchmark.folders()
        plugins = benchmark.plugin_files
        benchmark = str(file)
    return RunFiles(
        benchmark=str(benchmark),
        scene=None if scene is None else str(scene),
        folders=tuple(dict.fromkeys(folders)),
        plugins=plugins,
        written_files=tuple(written_files),
    )


@contextmanager
def keep_run_files(
    preparation: AbstractContextManager[None], directory: Path, files: RunFiles
) -> Iterator[None]:
    """Copy the written files into a result directory once it is prepared."""
    with preparation:
        if files.written_files:
            folder = directory / INPUTS_FOLDER
            folder.mkdir(exist_ok=True)
            for file in files.written_files:
                shutil.copyfile(file, folder / file.name)
        yield


@contextmanager
def locate_errors(files: RunFiles) -> Iterator[None]:
    """State the path of the element, instead of a line, in errors about the written files."""
    try:
        yield
    except FileError as error:
        raise _locate_error(error, files) from None
    except SeveralErrors as error:
        errors = [
            _locate_error(item, files) if isinstance(item, FileError) else item
            for item in error.errors
        ]
        raise SeveralErrors(errors) from None


def _locate_error(error: FileError, files: RunFiles) -> FileError:
    diagnostics = error.diagnostics
    for file in files.written_files:
        if file.suffix == ".xml" and file.is_file():
            text = file.read_text(encoding="utf-8")
            diagnostics = locate_diagnostics(diagnostics, text, str(file), file.name)
    return type(error)(diagnostics)


def _file_name(path: str, default: str) -> str:
    return Path(path).name if path else default
