"""Options that several commands share: each alone, and in groups that a command takes whole."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...errors import BadSetting, ErrorCollector
from ...runs.executors.choose import CALLBACK_LIMIT, executor_of, n_at_once
from ...runs.planning.plan_request import PlanRequest
from ...scene.settings import XACRO_PREFIX
from .completion import benchmark_names, one_of, scene_names
from .help_texts import FILES, INPUT, OUTPUT, RUN, in_group

if TYPE_CHECKING:
    from ...runs.executors.executor import Executor

BenchmarkArgument = Annotated[
    str,
    typer.Argument(
        metavar="BENCHMARK",
        help="A benchmark file, or a bundled name (uwsim list benchmarks).",
        autocompletion=benchmark_names,
    ),
]

SceneArgument = Annotated[
    str,
    typer.Argument(
        metavar="SCENE",
        help="A scene file, or a bundled name (uwsim list scenes).",
        autocompletion=scene_names,
    ),
]

ResultArgument = Annotated[
    Path, typer.Argument(metavar="RESULT", help="A result directory or its result.json.")
]

SceneOption = Annotated[
    str | None,
    in_group(
        INPUT,
        "--scene",
        metavar="SCENE",
        help="The scene; without it the one that the benchmark names (u:scene).",
        autocompletion=scene_names,
    ),
]

SetOption = Annotated[
    list[str] | None,
    in_group(
        INPUT,
        "--set",
        metavar="PATH=VALUE",
        help="Change the scene, an updater or the algorithm, as oceanState.fog.density=0.4, "
        "vehicle[girona500].virtualCamera[bowtech1].std=0.016 or algorithm.kp=0.4; "
        "may be repeated.",
    ),
]

XacroOption = Annotated[
    list[str] | None,
    in_group(
        INPUT,
        "--xacro",
        metavar="NAME:=VALUE",
        help="Value of an <xacro:arg> of the scene and its robots; may be repeated.",
    ),
]

CompatOption = Annotated[
    list[str] | None,
    in_group(
        INPUT,
        "--compat",
        metavar="NAME,...",
        help="Quirks of the original UWSim to reproduce, by name; uwsim is all of them but "
        "visual-frames, which is for scenes written before July 2014.",
    ),
]


def existing_folders(folders: list[Path] | None) -> list[Path] | None:
    """Refuse what is no folder; raises BadSetting."""
    wrong = ErrorCollector()
    for folder in folders or ():
        if not folder.is_dir():
            with wrong.collect():
                what = "is no folder" if folder.exists() else "there is no such folder"
                raise BadSetting(f"--data-path {folder}: {what}.")
    wrong.raise_errors()
    return folders


DataPathOption = Annotated[
    list[Path] | None,
    in_group(
        FILES,
        "--data-path",
        metavar="DIR",
        help="Search files here, too; may be repeated.",
        callback=existing_folders,
    ),
]

JsonOption = Annotated[
    bool,
    in_group(OUTPUT, "--json", help="Print JSON on stdout, for programs, and nothing else there."),
]

ModeOption = Annotated[
    str | None,
    in_group(
        INPUT,
        "--mode",
        metavar="MODE",
        help="sequential (a seed's levels in one go) or independent (each level alone); without it "
        "that of the benchmark (u:mode).",
        autocompletion=one_of(("sequential", "independent")),
    ),
]

PluginOption = Annotated[
    list[Path] | None,
    in_group(
        FILES,
        "--plugin",
        metavar="FILE.py",
        help="Measures, triggers, updaters or algorithms of your own; may be repeated.",
    ),
]

NoCodeOption = Annotated[
    bool,
    in_group(
        FILES,
        "--no-code",
        help="Refuse files that name Python code (u:pythonFunction of a scene, module:Class of a "
        "benchmark or a result) instead of running it.",
    ),
]

InProcessOption = Annotated[
    bool,
    in_group(
        RUN,
        "--in-process",
        help="Run an algorithm of your own in the process of the simulation, for debugging, not "
        "in one of its own; the result says so. The rows are the same.",
    ),
]

WorkersOption = Annotated[
    str,
    in_group(
        RUN,
        "--workers",
        metavar="N|ray",
        help="Processes to use on this machine; ray: the cluster that RAY_ADDRESS names, else all "
        "cores here; 0: this process, for debugging with --in-process.",
    ),
]

CallbackLimitOption = Annotated[
    float,
    in_group(
        RUN,
        "--callback-limit",
        metavar="SECONDS",
        help="How long the algorithm may take to return from one callback, in wall time; a row in "
        "which it takes longer ends in 'algorithm error'. 0: for ever. Not for ray.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class TaskOptions:
    """What is run."""

    benchmark: BenchmarkArgument
    scene: SceneOption = None


@dataclass(frozen=True, kw_only=True)
class SettingOptions:
    """What is changed in the files."""

    settings: SetOption = None
    xacro: XacroOption = None
    compat: CompatOption = None

    @property
    def all_settings(self) -> list[str]:
        """Those of ``--set``, and the xacro arguments as settings; raises BadSetting."""
        return [*(self.settings or ()), *xacro_settings(self.xacro)]


@dataclass(frozen=True, kw_only=True)
class WorkerOptions:
    """Who executes the trials."""

    workers: WorkersOption = "1"
    callback_limit: CallbackLimitOption = CALLBACK_LIMIT

    def executor(self) -> Executor:
        """Return who executes the trials; raises BadSetting, MissingExtra."""
        return executor_of(self.workers, self.callback_limit)

    @property
    def at_once(self) -> int:
        """How many levels are run at one time."""
        return n_at_once(self.workers)


@dataclass(frozen=True, kw_only=True)
class CodeOptions:
    """Code and data of the user's own."""

    plugin: PluginOption = None
    no_code: NoCodeOption = False
    data_path: DataPathOption = None
    in_process: InProcessOption = False

    @property
    def folders(self) -> tuple[Path, ...]:
        """Folders in which files are looked for."""
        return tuple(self.data_path or ())


def xacro_settings(words: Sequence[str] | None) -> list[str]:
    """Return ``NAME:=VALUE`` of ``--xacro`` as settings ``xacro.NAME=VALUE``; raises BadSetting."""
    settings = []
    for word in words or ():
        name, sign, value = word.partition(":=")
        if not sign or not name.strip():
            raise BadSetting(f"--xacro {word!r}: expected NAME:=VALUE.")
        settings.append(f"{XACRO_PREFIX}{name.strip()}={value.strip()}")
    return settings


def request_of(task: TaskOptions, changes: SettingOptions, files: CodeOptions) -> PlanRequest:
    """Return what these options ask for; the rest as it is without options."""
    return PlanRequest(
        benchmark=task.benchmark,
        scene=task.scene,
        settings=changes.all_settings,
        compat=changes.compat or (),
        data_path=files.folders,
        plugins=files.plugin or (),
        no_code=files.no_code,
        in_process=files.in_process,
    )
