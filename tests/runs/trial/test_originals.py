"""Every original benchmark file in a folder is checked, played and scored, whichever it is."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from tests.support.opened import open_scene
from tests.support.scripted import ScriptedAlgorithm
from uwsim.base.compatibility import compatibility
from uwsim.benchmark.reader import read_benchmark
from uwsim.benchmark.spec import BenchmarkSpec
from uwsim.benchmark.triggers import NeverSpec
from uwsim.benchmark.unknown_names import find_unknown_names
from uwsim.benchmark.updaters import (
    STILL_WATER_TIME,
    CurrentForceUpdaterSpec,
    SceneUpdaterSpec,
    chain,
    swept_parameters,
)
from uwsim.cli import main
from uwsim.errors import BenchmarkError, NeverStarted, UwsimError
from uwsim.runs.planning.plan import AlgorithmUnderTest, Plan
from uwsim.runs.trial.level_row import LevelRow
from uwsim.runs.trial.trial import execute
from uwsim.scene.reader import read_scene
from uwsim.scene.spec import SceneSpec
from uwsim.topics.ros_twist_to_pat import ROSTwistToPATSpec

ORIGINALS = os.environ.get("UWSIM_ORIGINALS")
pytestmark = pytest.mark.skipif(ORIGINALS is None, reason="UWSIM_ORIGINALS is not set")
SHORT = 0.5
"""What a level lasts here, beside the still water behind a step of a current [s]."""
MAX_DURATION = 3.0
"""What a level lasts here that nothing ends [s]."""
COMMON = {"benchmark", "scene", "auto", "recursive", "simple", "test"}
"""Words that say nothing about which scene a benchmark is for."""


def xml_files(root: bytes) -> list[Path]:
    """The files of the folder with this root element, at any depth."""
    return [
        path
        for path in sorted(Path(ORIGINALS or ".").rglob("*.xml"))
        if ORIGINALS is not None and path.is_file() and root in path.read_bytes()
    ]


BENCHMARKS = xml_files(b"<benchmark")
SCENES = xml_files(b"<UWSimScene")


def words(path: Path) -> set[str]:
    """The words of a file's name: ``dynamicsTrackingScene`` is about dynamics and tracking."""
    split = re.findall(r"[A-Z]?[a-z]+|[A-Z]+|\d+", path.stem)
    return {word.lower().removesuffix("auto") for word in split} - COMMON - {""}


def candidates(benchmark: Path, spec: BenchmarkSpec) -> Iterator[Path]:
    """Scenes to try: the one it names, then those called most alike, then all others."""
    if spec.scene is not None:
        yield benchmark.parent / spec.scene
        return
    wanted = words(benchmark)

    def likeness(scene: Path) -> float:
        has = words(scene)
        return len(wanted & has) / max(1, len(wanted | has))

    yield from sorted(SCENES, key=lambda scene: (-likeness(scene), scene))


def scene_for(benchmark: Path, spec: BenchmarkSpec) -> Path:
    """The first scene that has every name of a benchmark; fails with what the others lack."""
    said = []
    for path in candidates(benchmark, spec):
        try:
            simulation = open_scene(read_scene(path), is_blind=True)
        except UwsimError as error:
            said.append(f"{path}: {error}")
            continue
        errors = find_unknown_names(spec, simulation.world.stage_view)
        simulation.close()
        if not errors:
            return path
        said += [f"{path.name}: {error}" for error in errors]
    pytest.fail("no scene has all names:\n" + "\n".join(said))


def shortened(spec: SceneUpdaterSpec, length: float) -> SceneUpdaterSpec:
    """The same updaters with levels of this length [s]."""
    changes: dict[str, object] = {}
    if hasattr(spec, "interval"):
        changes["interval"] = length
    if spec.child is not None:
        changes["child"] = shortened(spec.child, length)
    return replace(spec, **changes)


def plan_of(file: Path, scene: SceneSpec, compatibility: frozenset[str]) -> Plan:
    """The first two levels of every updater, short and blind, with the scripted algorithm."""
    spec = read_benchmark(file)
    has_current = any(
        isinstance(updater, CurrentForceUpdaterSpec) for updater in chain(spec.scene_updater)
    )
    updater = shortened(spec.scene_updater, SHORT + STILL_WATER_TIME * has_current)
    chosen = [
        (name, value)
        for name, each in zip(swept_parameters(updater), chain(updater), strict=True)
        for value in each.values()[:2]
    ]
    twists = [each for each in scene.ros_interfaces if isinstance(each, ROSTwistToPATSpec)]
    return Plan(
        benchmark=replace(spec, scene_updater=updater),
        scene=scene,
        algorithm=AlgorithmUnderTest(
            cls=ScriptedAlgorithm,
            name="scripted",
            parameters={
                "file": str(file),
                "drive": twists[0].topic if twists else "",
                "stop_after": 2.0,
            },
        ),
        level_choices=tuple(chosen),
        compatibility=compatibility,
        is_blind=True,
    )


def played(plan: Plan) -> list[LevelRow]:
    return [
        row for trial in plan.trials() for row in execute(plan, trial) if isinstance(row, LevelRow)
    ]


def refer(row: LevelRow) -> tuple[float, ...]:
    return tuple(value for _, value in row.values)


def test_there_are_files_in_the_folder() -> None:
    assert BENCHMARKS
    assert SCENES


@pytest.mark.parametrize("file", BENCHMARKS, ids=lambda file: file.stem)
def test_an_original_passes_the_check_with_its_scene(file: Path) -> None:
    scene = scene_for(file, read_benchmark(file))
    assert main(["check", str(file), "--scene", str(scene)]) == 0


@pytest.mark.parametrize("quirks", ["repaired", "uwsim"])
@pytest.mark.parametrize("file", BENCHMARKS, ids=lambda file: file.stem)
def test_an_original_is_played_and_every_cell_has_a_value_or_a_reason(
    file: Path, quirks: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("uwsim.runs.trial.trial.MAX_TASK_DURATION", MAX_DURATION)
    scene = read_scene(scene_for(file, read_benchmark(file)))
    plan = plan_of(file, scene, compatibility([quirks] if quirks == "uwsim" else []))
    if (
        quirks == "uwsim"
        and len(plan.levels()) > 1
        and not isinstance(plan.benchmark.stop_on, NeverSpec)
    ):
        with pytest.raises(NeverStarted, match="stop-once"):  # as in the original
            played(plan)
        return
    rows = played(plan)
    levels = plan.levels()
    assert [refer(row) for row in rows] == [
        tuple(value for _, value in level.values) for level in levels
    ]
    ends_itself = plan.benchmark.scene_updater.seconds_per_level is None
    for row in rows:
        assert row.status == "ok" or (row.status == "timeout" and ends_itself), row.missing_reasons
        for name, (value, _) in row.measures.items():
            assert value is not None or row.missing_reasons[name]
        assert row.total is not None or row.missing_reasons["total"]
        assert row.duration > 0.0


@pytest.mark.slow
@pytest.mark.parametrize("file", BENCHMARKS, ids=lambda file: file.stem)
def test_an_original_is_played_by_the_public_command(file: Path, tmp_path: Path) -> None:
    spec = read_benchmark(file)
    scene = scene_for(file, spec)
    if spec.scene_updater.seconds_per_level is None:
        pytest.skip("it lasts until somebody stops it, at most 600 s")
    chosen = []
    for name, updater in zip(
        swept_parameters(spec.scene_updater), chain(spec.scene_updater), strict=True
    ):
        chosen += ["--level", f"{name}={updater.values()[0]!r}"]
    out = tmp_path / "out"
    status = main(
        ["bench", str(file), "--scene", str(scene),
         "--algorithm", "tests.support.scripted:ScriptedAlgorithm",
         "--set", f"algorithm.file={file}", "--out", str(out), *chosen]
    )  # fmt: skip
    assert status == 0
    lines = (out / "result.dat").read_text().split("\n")
    assert len(lines) == 3
    assert lines[0].endswith("\tTOTAL\tSimTime\t")
    for measure in spec.measures:
        log = out / f"benchmark-{measure.name}.data"
        assert log.exists() == (measure.log is not None)


@pytest.mark.parametrize("file", BENCHMARKS, ids=lambda file: file.stem)
def test_an_original_means_the_same_however_it_is_written(file: Path, tmp_path: Path) -> None:
    data = file.read_bytes()
    copy = tmp_path / "copy.xml"
    for changed in (
        data.replace(b"\r\n", b"\n").replace(b"\n", b"\r\n"),
        b"\xef\xbb\xbf" + data,
        data.decode("utf-8").encode("utf-16"),
        re.sub(rb"<!DOCTYPE[^>]*>", b"", data),
        re.sub(rb">\s+<", b"><", data),
        data.replace(b"<measures>", b"<!-- read by --><measures>"),
    ):
        copy.write_bytes(changed)
        assert read_benchmark(copy) == read_benchmark(file)


@pytest.mark.parametrize("file", BENCHMARKS, ids=lambda file: file.stem)
def test_an_original_that_is_cut_off_is_refused_wherever_it_was_cut(
    file: Path, tmp_path: Path
) -> None:
    data = file.read_bytes().rstrip()
    copy = tmp_path / "copy.xml"
    for length in range(0, len(data), 97):
        copy.write_bytes(data[:length])
        with pytest.raises(BenchmarkError, match="not well-formed XML"):
            read_benchmark(copy)
