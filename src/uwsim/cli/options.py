"""Options that several commands share, said once."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

CompatOption = Annotated[
    list[str] | None,
    typer.Option(
        help="Slips of the original to bring back, by name; uwsim is all of them, "
        "visual-frames (for scenes written before July 2014) left aside."
    ),
]

DataPathOption = Annotated[
    list[Path] | None,
    typer.Option(metavar="DIR", help="Look for files here, too; may be repeated."),
]
