"""A suite: a file with the tasks of a leaderboard, the tracks of its entries, and its seeds.

.. code-block:: xml

    <suite>
      <name>intervention</name>
      <description>Tasks of underwater intervention.</description>
      <split> <name>validation</name> <first>0</first> <count>10</count> </split>
      <track>
        <name>a</name> <description>camera, depth and IMU</description>
        <source>virtualCamera</source> <source>pressureSensor</source> <source>imu</source>
      </track>
      <track> <name>c</name> <description>ground truth</description> </track>
      <task>
        <name>station-v1</name> <benchmark>station-keeping</benchmark>
        <description>Hold a place in a current whose direction swings.</description>
        <failure>missed</failure>
        <baseline>position-p</baseline> <baseline>position-pi</baseline>
        <control>nothing</control>
      </task>
    </suite>

A benchmark is a file relative to the folder of the suite, or the name of a bundled benchmark.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ..assets.bundled import bundled_files
from ..base.files.input_files import compute_hash
from ..devices import DEVICES
from ..errors import AssetNotFound, Diagnostic, FileError, UnknownName, choices, did_you_mean
from ..schema import Diagnostics, Spec, check_head, parse, read
from ..schema.names import prefixed_name
from ..sensors import SENSORS
from ..topics import INTERFACES
from .suite_checks import check_splits, check_tasks
from .suite_spec import SplitSpec, SuiteSpec, TaskSpec, TrackSpec

ROOT = "suite"
"""The name of the root element."""
TEST_SPLIT = "test"
"""The name of the split whose seeds follow from a date and a public text (`draw_test_seeds`)."""
TASK_NAME = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*-v[1-9][0-9]*", re.ASCII)
"""The pattern of the name of a task: words joined by hyphens, and its version."""
NAME = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*", re.ASCII)
"""The pattern of the names of suites, splits and tracks."""


class SuiteError(FileError):
    """An invalid suite file."""


@dataclass(frozen=True, kw_only=True)
class Suite:
    """A suite that was read from a file."""

    spec: SuiteSpec
    """The content of the file."""
    path: Path
    """The file."""
    sha256: str
    """The hash of the file: ``sha256:`` and 64 digits."""

    def benchmark_of(self, task: TaskSpec) -> str:
        """Return the benchmark of a task: a path, or a bundled name."""
        path = self.path.parent / task.benchmark
        return str(path) if path.is_file() else task.benchmark

    def select_tasks(self, names: Sequence[str]) -> Suite:
        """Return the suite with some of its tasks; all for no names; raise UnknownName."""
        tasks = tuple(self.task(name) for name in names) or self.spec.tasks
        return replace(self, spec=replace(self.spec, tasks=tasks))

    def task(self, name: str) -> TaskSpec:
        """Return the task of a name; its version may be left out.

        Raises:
            UnknownName: there is no such task.
        """
        for task in self.spec.tasks:
            if name in (task.name, task.name.rpartition("-v")[0]):
                return task
        raise UnknownName("task", name, [task.name for task in self.spec.tasks])

    def track(self, name: str) -> TrackSpec:
        """Return the track of a name; raise UnknownName if there is none."""
        for track in self.spec.tracks:
            if track.name == name.lower():
                return track
        raise UnknownName("track", name, [track.name for track in self.spec.tracks])

    def split(self, name: str) -> SplitSpec:
        """Return the public split of a name; raise UnknownName if there is none."""
        for split in self.spec.splits:
            if split.name == name:
                return split
        names = [*(split.name for split in self.spec.splits), TEST_SPLIT]
        raise UnknownName("split", name, names)


def find_suite(name: str) -> Path:
    """Return the path of a suite: a file, or a bundled suite of that name.

    Raises:
        AssetNotFound: there is no such suite.
    """
    files = bundled_files("suites")
    path = Path(name)
    if path.is_file():
        return path
    if name in files:
        return files[name]
    raise AssetNotFound(
        f"{name!r} is neither a file nor one of the bundled suites ({', '.join(files)})."
        f"{did_you_mean(name, files)}"
    )


def _check_open_track(spec: SuiteSpec, diagnostics: Diagnostics) -> None:
    if all(track.sources for track in spec.tracks):
        diagnostics.error(spec, "expected a <track> without <source>, which permits all topics")


def read_suite(path: Path) -> Suite:
    """Read a suite file.

    Raises:
        SuiteError: the file is invalid; the error has every mistake in it.
    """
    diagnostics = Diagnostics(path)
    document = parse(path, error=SuiteError)
    check_head(document, ROOT, diagnostics)
    diagnostics.check(SuiteError)
    spec = read(SuiteSpec, document.root, diagnostics)
    if spec is not None:
        _check_names(spec, diagnostics)
        _check_open_track(spec, diagnostics)
        _check_sources(spec.tracks, diagnostics)
        check_splits(spec.splits, diagnostics)
        check_tasks(spec.tasks, path.parent, diagnostics)
    diagnostics.check(SuiteError)
    assert spec is not None
    return Suite(spec=spec, path=path, sha256=compute_hash(path))


def check_suite(path: Path) -> list[Diagnostic] | None:
    """Return the errors of a suite file; None if its root element is another one."""
    try:
        if parse(path).root.tag != ROOT:
            return None
        read_suite(path)
    except FileError as error:
        return list(error.diagnostics)
    return []


def source_kinds() -> tuple[str, ...]:
    """Return the elements that a track may name: sensors, devices, and interfaces of a vehicle."""
    interfaces = [
        prefixed_name(tag)
        for tag, spec in INTERFACES.items()
        if not spec.subscribes
        and (spec.source_kind == prefixed_name(tag) or not {*spec.sources} - {"vehicle", "object"})
    ]
    return (*(prefixed_name(tag) for tag in (*SENSORS, *DEVICES)), *interfaces)


def _check_names(spec: SuiteSpec, diagnostics: Diagnostics) -> None:
    parts: list[tuple[str, str, Spec]] = [
        ("suite", spec.name, spec),
        *(("split", split.name, split) for split in spec.splits),
        *(("track", track.name, track) for track in spec.tracks),
        *(("task", task.name, task) for task in spec.tasks),
    ]
    names: set[tuple[str, str]] = set()
    for kind, name, part in parts:
        pattern, example = (TASK_NAME, "station-v1") if kind == "task" else (NAME, "validation")
        if not pattern.fullmatch(name):
            diagnostics.error(
                part,
                f"<name> of <{kind}> is {name!r}; expected, as {example!r}, "
                "small letters, digits and hyphens" + (", and a version" if kind == "task" else ""),
            )
        if (kind, name) in names:
            diagnostics.error(part, f"{kind} {name!r} is defined twice")
        names.add((kind, name))
        if (kind, name) == ("split", TEST_SPLIT):
            diagnostics.error(part, "the seeds of the split 'test' follow from a date and a text")


def _check_sources(tracks: Sequence[TrackSpec], diagnostics: Diagnostics) -> None:
    kinds = source_kinds()
    for track in tracks:
        for source in track.sources:
            if source not in kinds:
                diagnostics.error(
                    track,
                    f"<source>: no sensor or device is called {source!r}.{choices(source, kinds)}",
                )
