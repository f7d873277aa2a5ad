"""``uwsim copy``: a bundled scene or benchmark with its files, to edit."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ..assets.bundled import bundled_files
from .options.completion import copied_names
from .options.help_texts import OUTPUT, option
from .output.console import Console


def copy(
    name: Annotated[
        str,
        typer.Argument(
            metavar="NAME",
            help="A bundled scene or benchmark (uwsim list scenes, uwsim list benchmarks).",
            autocompletion=copied_names,
        ),
    ],
    folder: Annotated[
        Path | None,
        typer.Argument(
            metavar="FOLDER", help="The folder of the copies; without it a new folder NAME."
        ),
    ] = None,
    overwrite: Annotated[
        bool, option(OUTPUT, "--overwrite", help="Replace files that exist already.")
    ] = False,
) -> None:
    """Copy a bundled scene or benchmark, with the files that it reads, into a folder to edit.

    Scene, robot, hydrodynamics and texture files are copied; a benchmark is copied with its scene.
    The copies are used instead of the bundled files. Models that uwsim builds have no file.
    """
    from ..runs.bundled_copy import copy_bundled

    target = folder or Path(name.removesuffix(".xml"))
    copies = copy_bundled(name, target, overwrite=overwrite)
    console = Console()
    for path in copies:
        console.print(f"written: {path}", soft_wrap=True, highlight=False, markup=False)
    file = copies[0]
    command = (
        f"bench {file}" if file.stem in bundled_files("benchmarks") else f"run {file} --for 5s --hz"
    )
    console.print(
        f"Edit {file}, then run: uwsim check {file}; uwsim {command}",
        soft_wrap=True,
        highlight=False,
        markup=False,
    )
