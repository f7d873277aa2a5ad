"""Rebuilding the plan of a result: its files are found by name and identified by hash."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..assets.bundled import bundled_files
from ..errors import AssetNotFound, ResultError
from ..results.inputs import Inputs, input_differences
from ..runs.named_plugins import plugin_names
from ..runs.own_process.program import IN_PROCESS, is_outside
from ..runs.planning.make_plan import make_plan
from ..runs.planning.plan_request import PlanRequest
from ..runs.planning.stored_pilot import PILOT, PREFIX

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.run_info import RunInfo
    from ..runs.planning.plan import Plan

NOT_DRAWN = "none"
"""The renderer of a control, which looks at no image."""


@dataclass(frozen=True, kw_only=True)
class FileOverrides:
    """Paths of files given by the user."""

    benchmark: Path | None = None
    """The benchmark."""
    scene: Path | None = None
    """The scene."""
    plugins: tuple[Path, ...] = ()
    """Plugins, in any order."""
    data_path: tuple[Path, ...] = ()
    """Folders in which files are looked for."""
    no_code: bool = False
    """Whether code that the files name is refused."""


def plan_of(result: Result, directory: Path, overrides: FileOverrides) -> Plan:
    """Rebuild the plan of a result.

    Raises:
        ResultError: the result does not say, or a file is not the one that was run.
        AssetNotFound: a file is nowhere.
    """
    run = result.run
    for client, how in run.clients or ():
        if is_outside(how):
            raise ResultError(
                f"The result was made with the program {client!r} outside ({how}): run the "
                "benchmark with it again and compare."
            )
    typed = typed_words(directory)
    benchmark = find_input(
        "benchmark",
        named_input(result, "benchmark"),
        overrides.benchmark,
        directory,
        overrides,
        typed,
    )
    typed += [str(benchmark.parent / name) for name in scene_named_by(benchmark)]
    scene = find_input(
        "scene", named_input(result, "scene"), overrides.scene, directory, overrides, typed
    )
    is_blind = _needed(run, "renderer") == NOT_DRAWN
    settings = [f"{name}={value}" for name, value in run.settings or ()]
    request = PlanRequest(
        benchmark=str(benchmark),
        scene=str(scene),
        algorithm=f"{PREFIX}{directory}" if run.algorithm == PILOT else _needed(run, "algorithm"),
        seed=_needed(run, "seed"),
        repeat=_needed(run, "repeats"),
        mode=_needed(run, "mode"),
        levels=run.levels or (),
        settings=[s for s in settings if not (is_blind and s.startswith("algorithm."))],
        compat=run.compatibility or (),
        data_path=overrides.data_path,
        plugins=_plugins(result, overrides.plugins, [*typed, *_beside(result, benchmark)]),
        no_code=overrides.no_code,
        in_process=IN_PROCESS in dict(run.clients or ()).values(),
        algorithm_is_from=str(directory),
    )
    return replace(make_plan(request), is_blind=is_blind)


def check_inputs(recorded: Inputs, found: Inputs) -> None:
    """Refuse assets or an algorithm that differ from the recorded ones.

    Benchmark, scene and plugins are found by their hashes.

    Raises:
        ResultError: names each that differs.
    """
    before, now = (
        Inputs(assets=each.assets, algorithm=each.algorithm) for each in (recorded, found)
    )
    if wrong := input_differences(before, now):
        raise ResultError(
            f"The result was made with other files: {'; '.join(wrong)}. "
            "Give the folder with those files with --data-path, and that of an algorithm with "
            "PYTHONPATH."
        )


def find_input(
    kind: str,
    recorded: tuple[str, str],
    chosen: Path | None,
    directory: Path,
    overrides: FileOverrides,
    typed: Sequence[str] = (),
) -> Path:
    """Find a file by its name and its hash.

    Args:
        kind: benchmark or scene: the option that names it.
        recorded: name and hash.
        chosen: the file that the user gave, if any; no other is looked at.
        directory: the result's; its folder and those above it are searched.
        overrides: folders to search.
        typed: words among which may be the file, as it was named then.

    Raises:
        ResultError: there are files of that name, but with other hashes.
        AssetNotFound: there is none.
    """
    from ..assets.find import candidates, searched_folders

    name, wanted = recorded
    if chosen is not None:
        files = (
            [bundled_files(f"{kind}s").get(str(chosen), chosen)]
            if not chosen.is_file()
            else [chosen]
        )
    else:
        names = [*(word for word in typed if Path(word).name == name), name]
        above = (directory.absolute(), *directory.absolute().parents)
        files = list(candidates(names, data_path=(*above, *overrides.data_path)))
        files += [path for path in bundled_files(f"{kind}s").values() if path.name == name]
    others = []
    for file in dict.fromkeys(path.resolve() if path.exists() else path for path in files):
        found = _sha256(file)
        if found == wanted:
            return file
        others.append(f"{file} ({_shortened(found)})")
    if others:
        raise ResultError(
            f"The {kind} is not the one that was run, {name} ({_shortened(wanted)}): "
            f"{', '.join(others)}. Give the right one with --{kind}."
        )
    searched = searched_folders(named_by=directory.absolute(), data_path=overrides.data_path)
    folders = ", ".join(str(folder) for folder in searched if folder.is_dir())
    raise AssetNotFound(
        f"The {kind} {name!r} ({_shortened(wanted)}) was not found; give it with --{kind}. "
        f"Folders searched: {folders}."
    )


def typed_words(directory: Path) -> list[str]:
    """Return the words of the command that a result was made with; of a control, of its result."""
    from ..results.directory import CONTROL
    from ..results.provenance import load_provenance

    place = directory.absolute()
    typed = load_provenance(place.parent if place.name == CONTROL else place).get("command")
    words = [str(word) for word in typed] if isinstance(typed, list) else []
    return [word.partition("=")[2] if word.startswith("--") else word for word in words]


def scene_named_by(benchmark: Path) -> list[str]:
    """Return the scene that a benchmark file names (u:scene), if it does."""
    from ..schema import NAMESPACE, parse

    named = parse(benchmark).root.get(f"{{{NAMESPACE}}}scene")
    return [] if named is None else [str(named).strip()]


def _beside(result: Result, benchmark: Path) -> list[str]:
    """Return where the plugins are that the benchmark names, or that are in its folder."""
    names = [*plugin_names(benchmark), *(name for name, _ in result.inputs.plugins or ())]
    return [str(benchmark.parent / name) for name in names]


def _plugins(result: Result, overrides: Sequence[Path], typed: Sequence[str]) -> list[Path]:
    """Return the plugins that were used, in the order in which they were.

    Those that are not given are those of the same hash that were given then, or that are in the
    benchmark's folder. The file of an algorithm ``FILE.py:Class`` is where its name says, unless it
    has changed.
    """
    names = [name for name, _ in result.inputs.plugins or ()]
    known = [Path(word) for word in typed if Path(word).name in names and Path(word).is_file()]
    hashes = {path: _sha256(path) for path in (*overrides, *known)}
    program = Path((result.run.algorithm or "").partition(":")[0])
    found = []
    for name, wanted in result.inputs.plugins or ():
        if program.name == name and program.is_file() and _sha256(program) == wanted:
            continue
        right = [path for path, digest in hashes.items() if digest == wanted]
        if not right:
            alike = [str(path) for path in overrides if path.name == name]
            what = f"{alike[0]} is another file" if alike else "it is not in the benchmark's folder"
            raise ResultError(
                f"The result was made with the plugin {name} ({_shortened(wanted)}); {what}. Give "
                "its path with --plugin."
            )
        found.append(right[0])
    if extra := [str(path) for path in overrides if path not in found]:
        raise ResultError(f"The result was made without the plugin {', '.join(extra)}.")
    return found


def _sha256(path: Path) -> str:
    return "sha256:" + hashlib.sha256(path.read_bytes()).hexdigest()


def named_input(result: Result, kind: str) -> tuple[str, str]:
    """Return name and hash of the benchmark or the scene of a result; ResultError if not there."""
    file: tuple[str, str] | None = getattr(result.inputs, kind)
    if file is None:
        raise ResultError(f'The result does not name its {kind}: "inputs" lacks it.')
    return file


def _shortened(digest: str) -> str:
    return digest[: len("sha256:") + 12]


def _needed(run: RunInfo, name: str) -> Any:
    """Return what ``run`` says; ResultError where it does not."""
    value = getattr(run, name)
    if value is None:
        raise ResultError(f'The result cannot be replayed: "run" does not say its {name}.')
    return value
