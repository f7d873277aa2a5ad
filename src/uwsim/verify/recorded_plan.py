"""Rebuilding the plan of a stored result from the files that it names, which have known hashes."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..assets.bundled import bundled_files
from ..errors import AssetNotFound, ResultError
from ..results.directory import INPUTS_FOLDER
from ..results.inputs import Inputs, input_differences
from ..runs.named_plugins import plugin_names
from ..runs.own_process.program import SHARED_PROCESS, is_outside
from ..runs.planning.make_plan import make_plan
from ..runs.planning.plan_request import PlanRequest
from ..runs.planning.stored_pilot import PILOT, PREFIX
from ..runs.tracks.track import Track

if TYPE_CHECKING:
    from ..results.result import Result
    from ..results.run_info import RunInfo
    from ..runs.planning.plan import Plan

NOT_RENDERED = "none"
"""The recorded renderer of a control run (a sham baseline), in which nothing is rendered."""


@dataclass(frozen=True, kw_only=True)
class FileOverrides:
    """The files and folders that the user names for a verification."""

    benchmark: Path | None = None
    """The benchmark file; None: it is searched."""
    scene: Path | None = None
    """The scene file; None: it is searched."""
    plugins: tuple[Path, ...] = ()
    """The plugin files, in any order."""
    data_path: tuple[Path, ...] = ()
    """The folders in which files are searched."""
    no_code: bool = False
    """True if code that the files name is refused."""


def plan_of(result: Result, directory: Path, overrides: FileOverrides) -> Plan:
    """Rebuild the plan of a stored result.

    Args:
        result: the stored result.
        directory: the directory of the result.
        overrides: the files and folders that the user names.

    Raises:
        ResultError: the result lacks a value, or a file is not the one that was run.
        AssetNotFound: a file is not found.
    """
    run = result.run
    for client, participation in run.clients or ():
        if is_outside(participation):
            raise ResultError(
                f"The result was made with the external program {client!r} ({participation}). Run "
                "the benchmark with it again and compare."
            )
    words = command_words(directory)
    benchmark = find_input(
        "benchmark",
        recorded_input(result, "benchmark"),
        overrides.benchmark,
        directory,
        overrides,
        words,
    )
    words += [str(benchmark.parent / name) for name in find_scene_name(benchmark)]
    scene = find_input(
        "scene", recorded_input(result, "scene"), overrides.scene, directory, overrides, words
    )
    is_blind = _value_of(run, "renderer") == NOT_RENDERED
    settings = [f"{name}={value}" for name, value in run.settings or ()]
    request = PlanRequest(
        benchmark=str(benchmark),
        scene=str(scene),
        algorithm=f"{PREFIX}{directory}" if run.algorithm == PILOT else _value_of(run, "algorithm"),
        seed=_value_of(run, "seed"),
        repeat=_value_of(run, "repeats"),
        mode=_value_of(run, "mode"),
        levels=run.levels or (),
        track=None if run.track is None else Track(name=run.track[0], sources=run.track[1]),
        settings=[s for s in settings if not (is_blind and s.startswith("algorithm."))],
        compat=run.compatibility or (),
        data_path=overrides.data_path,
        plugins=_plugins(result, overrides.plugins, [*words, *_plugin_paths(result, benchmark)]),
        no_code=overrides.no_code,
        in_process=SHARED_PROCESS in dict(run.clients or ()).values(),
        is_isolated=run.track is not None,
        algorithm_is_from=str(directory),
    )
    return replace(make_plan(request), is_blind=is_blind)


def check_inputs(recorded_inputs: Inputs, current_inputs: Inputs) -> None:
    """Raise an error if assets or the algorithm differ from the recorded ones.

    Benchmark, scene and plugins are not compared, as they are found by their hashes.

    Raises:
        ResultError: files differ; the error message names each of them.
    """
    old_inputs, new_inputs = (
        Inputs(assets=inputs.assets, algorithm=inputs.algorithm)
        for inputs in (recorded_inputs, current_inputs)
    )
    if messages := input_differences(old_inputs, new_inputs):
        raise ResultError(
            f"The result was made with other files: {'; '.join(messages)}. "
            "Name the folder of those files with --data-path, and that of an algorithm with "
            "PYTHONPATH."
        )


def find_input(
    kind: str,
    recorded_file: tuple[str, str],
    choice: Path | None,
    directory: Path,
    overrides: FileOverrides,
    words: Sequence[str] = (),
) -> Path:
    """Find a file by its name and its hash.

    Args:
        kind: ``benchmark`` or ``scene``, which is also the option that names the file.
        recorded_file: the recorded name and hash.
        choice: the file that the user names; None to search.
        directory: the directory of the result; it and the folders above it are searched.
        overrides: the folders that are searched, too.
        words: the words of the recorded command, of which one may be the path of the file.

    Raises:
        ResultError: there are files with this name, but with other hashes.
        AssetNotFound: there is no file with this name.
    """
    from ..assets.find import candidates, searched_folders

    name, digest = recorded_file
    if choice is not None:
        files = (
            [bundled_files(f"{kind}s").get(str(choice), choice)]
            if not choice.is_file()
            else [choice]
        )
    else:
        names = [*(word for word in words if Path(word).name == name), name]
        parents = (directory.absolute(), *directory.absolute().parents)
        inputs = [folder / INPUTS_FOLDER for folder in parents[:2]]  # of the result, of its control
        files = list(candidates(names, data_path=(*inputs, *parents, *overrides.data_path)))
        files += [path for path in bundled_files(f"{kind}s").values() if path.name == name]
    candidates_text = []
    for file in dict.fromkeys(path.resolve() if path.exists() else path for path in files):
        file_digest = _sha256(file)
        if file_digest == digest:
            return file
        candidates_text.append(f"{file} ({_short_hash(file_digest)})")
    if candidates_text:
        raise ResultError(
            f"The {kind} is not the one that was run, {name} ({_short_hash(digest)}): "
            f"{', '.join(candidates_text)}. Name the right one with --{kind}."
        )
    search_folders = searched_folders(named_by=directory.absolute(), data_path=overrides.data_path)
    folders = ", ".join(str(folder) for folder in search_folders if folder.is_dir())
    raise AssetNotFound(
        f"The {kind} {name!r} ({_short_hash(digest)}) is not found; name it with --{kind}. "
        f"Folders searched: {folders}."
    )


def command_words(directory: Path) -> list[str]:
    """Return the words of the command that made a result.

    A control run (a sham baseline) has no command of its own, but that of the result it belongs to.
    """
    from ..results.directory import CONTROL_FOLDER
    from ..results.provenance import load_provenance

    place = directory.absolute()
    command = load_provenance(place.parent if place.name == CONTROL_FOLDER else place).get(
        "command"
    )
    words = [str(word) for word in command] if isinstance(command, list) else []
    return [word.partition("=")[2] if word.startswith("--") else word for word in words]


def find_scene_name(benchmark: Path) -> list[str]:
    """Return the scene that a benchmark file names (u:scene), if there is one."""
    from ..schema import NAMESPACE, parse

    scene = parse(benchmark).root.get(f"{{{NAMESPACE}}}scene")
    return [] if scene is None else [str(scene).strip()]


def find_level_settings(benchmark: Path) -> dict[str, str]:
    """Return the paths of the scene's numbers that the levels of a benchmark file set, by column.

    The levels of ``<u:settingUpdater>`` set them. No plugin of the file is loaded.
    """
    from ..benchmark.updaters.setting_updater import column_of
    from ..schema import NAMESPACE, parse

    paths = {}
    for updater in parse(benchmark).root.iter(f"{{{NAMESPACE}}}settingUpdater"):
        path = str(updater.findtext("path", "")).strip()
        paths[str(updater.get(f"{{{NAMESPACE}}}column") or column_of(path))] = path
    return paths


def _plugin_paths(result: Result, benchmark: Path) -> list[str]:
    names = [*plugin_names(benchmark), *(name for name, _ in result.inputs.plugins or ())]
    return [str(benchmark.parent / name) for name in names]


def _plugins(result: Result, overrides: Sequence[Path], words: Sequence[str]) -> list[Path]:
    """Return the plugins of the recorded run, in their order.

    They are searched by their recorded hashes among the files that the user names, the words of the
    recorded command, and the files in the benchmark's folder. The file of an algorithm
    ``FILE.py:Class`` is left out if it has the recorded hash.
    """
    names = [name for name, _ in result.inputs.plugins or ()]
    candidates = [Path(word) for word in words if Path(word).name in names and Path(word).is_file()]
    hashes = {path: _sha256(path) for path in (*overrides, *candidates)}
    program = Path((result.run.algorithm or "").partition(":")[0])
    plugins = []
    for name, sha256 in result.inputs.plugins or ():
        if program.name == name and program.is_file() and _sha256(program) == sha256:
            continue
        matching_paths = [path for path, digest in hashes.items() if digest == sha256]
        if not matching_paths:
            paths = [str(path) for path in overrides if path.name == name]
            reason = (
                f"{paths[0]} is another file" if paths else "it is not in the benchmark's folder"
            )
            raise ResultError(
                f"The result was made with the plugin {name} ({_short_hash(sha256)}); {reason}. "
                "Name its path with --plugin."
            )
        plugins.append(matching_paths[0])
    if unused_paths := [str(path) for path in overrides if path not in plugins]:
        raise ResultError(f"The result was made without the plugin {', '.join(unused_paths)}.")
    return plugins


def _sha256(path: Path) -> str:
    return "sha256:" + hashlib.sha256(path.read_bytes()).hexdigest()


def recorded_input(result: Result, kind: str) -> tuple[str, str]:
    """Return the recorded name and hash of a benchmark or scene; raise ResultError without it."""
    file: tuple[str, str] | None = getattr(result.inputs, kind)
    if file is None:
        raise ResultError(f'The result does not name its {kind}: "inputs" lacks it.')
    return file


def _short_hash(digest: str) -> str:
    return digest[: len("sha256:") + 12]


def _value_of(run: RunInfo, name: str) -> Any:
    """Return a value of ``run`` in the result; raise ResultError if it is absent."""
    value = getattr(run, name)
    if value is None:
        raise ResultError(f'The result cannot be replayed: "run" lacks its {name}.')
    return value
