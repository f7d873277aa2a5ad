"""The files of a run whose benchmark or scene a program has made."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from pathlib import Path

from ..results.directory import INPUTS_FOLDER
from .benchmark import Benchmark
from .scene import Scene


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
        spec = benchmark.checked_spec()
        if written_files:
            named_benchmark = Benchmark(spec, plugins=benchmark._plugins)
            named_benchmark.scene = written_files[0].name
            text = named_benchmark.to_xml()
        else:
            text = benchmark.to_xml()
        file = folder / _file_name(benchmark.path, "benchmark.xml")
        file.write_text(text, encoding="utf-8")
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


def _file_name(path: str, default: str) -> str:
    return Path(path).name if path else default
