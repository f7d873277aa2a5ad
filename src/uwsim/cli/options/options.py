"""The options that several commands share, alone and in groups."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...errors import BadSetting, ErrorCollector
from ...runs.executors.choose import CALLBACK_LIMIT, executor_of, n_parallel_levels
from ...runs.planning.plan_request import PlanRequest
from ...scene.settings import XACRO_PREFIX
from .completion import benchmark_names, complete_names, scene_names
from .help_texts import FILES, INPUT, OUTPUT, RUN, option

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
    option(
        INPUT,
        "--scene",
        metavar="SCENE",
        help="The scene. The default is the benchmark's (u:scene).",
        autocompletion=scene_names,
    ),
]

SetOption = Annotated[
    list[str] | None,
    option(
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
    option(
        INPUT,
        "--xacro",
        metavar="NAME:=VALUE",
        help="Value of an <xacro:arg> of the scene and its robots; may be repeated.",
    ),
]

CompatOption = Annotated[
    list[str] | None,
    option(
        INPUT,
        "--compat",
        metavar="NAME,...",
        help="Quirks of the original UWSim to reproduce, by name; uwsim is all of them except "
        "visual-frames, which is for scenes written before July 2014.",
    ),
]


def check_folders(folders: list[Path] | None) -> list[Path] | None:
    """Return paths that are all folders; raise BadSetting for the others."""
    errors = ErrorCollector()
    for folder in folders or ():
        if not folder.is_dir():
            with errors.collect():
                message = "is no folder" if folder.exists() else "there is no such folder"
                raise BadSetting(f"--data-path {folder}: {message}.")
    errors.raise_errors()
    return folders


DataPathOption = Annotated[
    list[Path] | None,
    option(
        FILES,
        "--data-path",
        metavar="DIR",
        help="Search files here, too; may be repeated.",
        callback=check_folders,
    ),
]

OutputOption = Annotated[
    Path, option(OUTPUT, "--out", "-o", metavar="DIR", help="Output directory.")
]
OverwriteOption = Annotated[
    bool,
    option(OUTPUT, "--overwrite", help="Replace earlier files of this command in --out."),
]
JsonOption = Annotated[bool, option(OUTPUT, "--json", help="Only JSON on stdout, for programs.")]

ModeOption = Annotated[
    str | None,
    option(
        INPUT,
        "--mode",
        metavar="MODE",
        help="sequential (a seed's levels in one simulation) or independent (each level alone). "
        "The default is the benchmark's (u:mode).",
        autocompletion=complete_names(("sequential", "independent")),
    ),
]

PluginOption = Annotated[
    list[Path] | None,
    option(
        FILES,
        "--plugin",
        metavar="FILE.py",
        help="Your own measures, triggers, updaters or algorithms; may be repeated.",
    ),
]

NoCodeOption = Annotated[
    bool,
    option(
        FILES,
        "--no-code",
        help="Stop at files that name Python code (u:pythonFunction of a scene, module:Class of a "
        "benchmark or a result) instead of running it.",
    ),
]

InProcessOption = Annotated[
    bool,
    option(
        RUN,
        "--in-process",
        help="Run your own algorithm in the process of the simulation, for debugging, instead of a "
        "separate process; the result states this. The rows are the same.",
    ),
]

WorkersOption = Annotated[
    str,
    option(
        RUN,
        "--workers",
        metavar="N|ray",
        help="Number of processes on this machine; ray: the cluster of RAY_ADDRESS, else all cores "
        "here; 0: this process, for debugging with --in-process.",
    ),
]

CallbackLimitOption = Annotated[
    float,
    option(
        RUN,
        "--callback-limit",
        metavar="SECONDS",
        help="Time limit of one callback of the algorithm, in wall time; a row in which it takes "
        "longer ends in 'algorithm error'. 0: no limit. Not for ray, and not for an algorithm that "
        "runs in this process.",
    ),
]


@dataclass(frozen=True, kw_only=True)
class TaskOptions:
    """The options that choose the benchmark and its scene."""

    benchmark: BenchmarkArgument
    scene: SceneOption = None


@dataclass(frozen=True, kw_only=True)
class SettingOptions:
    """The options that change values of the files."""

    settings: SetOption = None
    xacro: XacroOption = None
    compat: CompatOption = None

    @property
    def all_settings(self) -> list[str]:
        """The settings of ``--set``, and the xacro arguments as settings."""
        return [*(self.settings or ()), *xacro_settings(self.xacro)]


@dataclass(frozen=True, kw_only=True)
class WorkerOptions:
    """The options of the execution of the trials."""

    workers: WorkersOption = "1"
    callback_limit: CallbackLimitOption = CALLBACK_LIMIT

    def executor(self) -> Executor:
        """Return the executor of the trials; raise BadSetting or MissingExtra."""
        return executor_of(self.workers, self.callback_limit)

    @property
    def n_parallel(self) -> int:
        """The number of levels that run in parallel."""
        return n_parallel_levels(self.workers)


@dataclass(frozen=True, kw_only=True)
class CodeOptions:
    """The options for the user's own code and files."""

    plugin: PluginOption = None
    no_code: NoCodeOption = False
    data_path: DataPathOption = None
    in_process: InProcessOption = False

    @property
    def folders(self) -> tuple[Path, ...]:
        """The folders in which files are searched."""
        return tuple(self.data_path or ())


def xacro_settings(words: Sequence[str] | None) -> list[str]:
    """Return ``NAME:=VALUE`` of ``--xacro`` as settings ``xacro.NAME=VALUE``; raise BadSetting."""
    settings = []
    for word in words or ():
        name, sign, value = word.partition(":=")
        if not sign or not name.strip():
            raise BadSetting(f"--xacro {word!r}: expected NAME:=VALUE.")
        settings.append(f"{XACRO_PREFIX}{name.strip()}={value.strip()}")
    return settings


def make_request(task: TaskOptions, changes: SettingOptions, files: CodeOptions) -> PlanRequest:
    """Return a request with the values of these options; other fields have their defaults."""
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
