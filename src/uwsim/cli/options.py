"""Options that several commands share, said once."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from .completion import benchmark_names, one_of, scene_names
from .taught import FILES, INPUT, OUTPUT, in_group

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

DataPathOption = Annotated[
    list[Path] | None,
    in_group(
        FILES, "--data-path", metavar="DIR", help="Look for files here, too; may be repeated."
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
        help="sequential (a seed's levels in one go) or independent (each level alone); without "
        "it what the benchmark says (u:mode).",
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
