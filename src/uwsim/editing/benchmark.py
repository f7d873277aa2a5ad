"""Benchmarks that a program reads, changes, checks and writes: `Benchmark`.

.. code-block:: python

    benchmark = uwsim.Benchmark()
    benchmark.add("distance", name="trip", target="bluerov2")
    benchmark.function.text = "trip"
    benchmark.add("sceneFogUpdater", initial_value=0, final_value=1, step=0.5, interval=2)
    result = uwsim.bench(benchmark, scene=scene, algorithm="pilot.py:Pilot")
"""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from ..benchmark.environment import EnvironmentSpec
from ..benchmark.measures import MeasureSpec
from ..benchmark.plugin import Plugin
from ..benchmark.plugin_tables import Tables
from ..benchmark.reader import read_benchmark as read_benchmark_file
from ..benchmark.spec import BenchmarkSpec, FunctionSpec
from ..benchmark.triggers import NeverSpec, OnInitSpec, TriggerSpec
from ..benchmark.updaters import NoneSpec, SceneUpdaterSpec
from ..benchmark.writer import write_benchmark
from ..checks.benchmark_tables import read_plugins
from ..errors import BadSetting, BenchmarkError, Diagnostic
from ..scene.variation import VariationSpec
from .attributes import Part, Parts
from .document import Document, check_equal, write_document
from .element import Element
from .file_names import move_file_names
from .scene import Scene
from .text_diagnostics import locate_diagnostics
from .tree import (
    check_name,
    references_to,
    remove_with_references,
    rename_element,
)

NAME = "the benchmark"
"""The name in messages of a benchmark that was not read from a file."""
EMPTY_BENCHMARK = BenchmarkSpec(
    measures=(),
    start_on=OnInitSpec(),
    stop_on=NeverSpec(),
    function=FunctionSpec(text="0"),
    scene_updater=NoneSpec(),
)
"""The contents of a new benchmark: it starts at once, and measures nothing."""


class Benchmark(Document[BenchmarkSpec]):
    """A benchmark that a program changes.

    Its attributes are the elements of a benchmark file: ``measures``, ``function``, ``start_on``,
    ``scene_updater``. ``benchmark["trip"]`` is the measure of that name. A scene updater that is
    added to another one is nested in it.

    Args:
        spec: the first contents; None: a benchmark without measures, which starts at once.
        plugins: the plugins whose measures, triggers and updaters are known, and their tables.
    """

    measures: Parts[MeasureSpec]
    start_on: Part[TriggerSpec]
    stop_on: Part[TriggerSpec]
    function: Part[FunctionSpec]
    scene_updater: Part[SceneUpdaterSpec]
    scene: str | None
    algorithm: str | None
    plugin: tuple[str, ...]
    mode: Literal["sequential", "independent"] | None
    prelude: bool
    compatibility: tuple[str, ...]
    patience: float | None
    timestep: float | None
    vary: Parts[VariationSpec]
    environments: Parts[EnvironmentSpec]
    path: str

    def __init__(
        self,
        spec: BenchmarkSpec | None = None,
        *,
        plugins: tuple[tuple[Plugin, ...], Tables] | None = None,
    ) -> None:
        tables = None if plugins is None else plugins[1]
        super().__init__(EMPTY_BENCHMARK if spec is None else spec, tables=tables)
        self._plugins = plugins

    @property
    def environment(self) -> Element[EnvironmentSpec]:
        """The first ``<u:environment>``, that of a benchmark in which one vehicle has a policy.

        Raises:
            BadSetting: the benchmark has none.
        """
        if not len(self.environments):
            raise BadSetting("The benchmark has no <u:environment>.")
        return self.environments[0]

    def rename(self, path: str, new_name: str) -> None:
        """Rename a measure, also in the score, the reward and the criterion of success."""
        element = check_name(self, path, new_name)
        references = references_to(self, path, new_name)
        rename_element(element, new_name, references)

    def remove(self, path: str) -> None:
        """Remove the element at a path, such as a measure.

        Raises:
            UnknownName: there is no such element.
            BadSetting: the score or another element names it; the error lists them.
        """
        remove_with_references(self, path, with_references=False)

    def check(
        self, scene: Scene | str | Path | None = None, *, data_path: Sequence[str | Path] = ()
    ) -> tuple[Diagnostic, ...]:
        """Return the errors and warnings of ``uwsim check``, with paths instead of lines.

        Args:
            scene: the scene; None: the scene that the benchmark names.
            data_path: more folders in which files are searched.
        """
        from ..assets.bundled import scene_file
        from ..checks import check_file

        text, folders = self.to_xml(), self.folders(data_path)
        with tempfile.TemporaryDirectory(prefix="uwsim-") as folder:
            file, scene_path = Path(folder) / "benchmark.xml", None
            file.write_text(text, encoding="utf-8")
            if isinstance(scene, Scene):
                scene_path = Path(folder) / "scene.xml"
                scene_path.write_text(scene.to_xml(), encoding="utf-8")
                folders += scene.folders()
            elif scene is not None:
                scene_path = scene_file(str(scene), folders)
            diagnostics = check_file(
                file, data_path=folders, scene=scene_path, plugins=self._plugins
            )
            return locate_diagnostics(diagnostics, text, str(file), self.path or NAME)

    def checked_spec(self) -> BenchmarkSpec:
        """Return the spec after the checks of a reader.

        Raises:
            BenchmarkError: the benchmark is invalid; the error has every mistake in it.
        """
        text, spec, tables = self.to_xml(), self.spec, self._tables
        with tempfile.TemporaryDirectory(prefix="uwsim-") as folder:
            file = Path(folder) / "benchmark.xml"
            file.write_text(text, encoding="utf-8")
            try:
                read_spec = read_benchmark_file(
                    file,
                    measures=tables.measures,
                    triggers=tables.triggers,
                    updaters=tables.updaters,
                )
            except BenchmarkError as error:
                diagnostics = locate_diagnostics(
                    error.diagnostics, text, str(file), self.path or NAME
                )
                raise BenchmarkError(diagnostics) from None
        check_equal(spec, read_spec)
        return spec

    def to_xml(self) -> str:
        """Return the text of a benchmark file, without values that equal their defaults."""
        tables = self._tables
        return write_benchmark(
            self.spec,
            measures=tables.measures,
            triggers=tables.triggers,
            updaters=tables.updaters,
        )

    def write(self, path: str | Path) -> Path:
        """Write a benchmark file, which reads back to an equal spec, and return its path.

        The names of files are changed so that they are found from the new folder.

        Raises:
            UwsimError: the benchmark is invalid, or the folder does not exist.
        """
        new_path = Path(path)
        moved_benchmark = Benchmark(self.checked_spec(), plugins=self._plugins)
        move_file_names(moved_benchmark, self.path, new_path)
        write_document(new_path, moved_benchmark.to_xml())
        return new_path

    @property
    def plugin_files(self) -> tuple[Path, ...]:
        """The files of the plugins with which the benchmark was read."""
        return tuple(Path(plugin.path) for plugin in (self._plugins or ((),))[0])


def read_benchmark(
    benchmark: str | Path,
    *,
    plugins: Sequence[str | Path] = (),
    data_path: Sequence[str | Path] = (),
) -> Benchmark:
    """Read a benchmark that a program can change; comments of the file are not kept.

    Args:
        benchmark: a benchmark file, or a bundled name (``uwsim list benchmarks``).
        plugins: the files with the user's measures, triggers and updaters; this runs them.
        data_path: more folders in which files are searched.

    Raises:
        UwsimError: there is no such file, or it is invalid.
    """
    from ..assets.bundled import benchmark_file

    path = benchmark_file(str(benchmark), tuple(Path(folder) for folder in data_path))
    loaded_plugins = read_plugins([Path(file) for file in plugins])
    tables = loaded_plugins[1]
    spec = read_benchmark_file(
        path, measures=tables.measures, triggers=tables.triggers, updaters=tables.updaters
    )
    return Benchmark(spec, plugins=loaded_plugins if plugins else None)
