"""``uwsim import``: worlds and models of other simulators as a scene."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ...base.terminal import clean_text
from ..exit_status import INVALID_INPUT
from ..options.help_texts import OUTPUT, option
from ..options.options import DataPathOption, JsonOption
from ..output.console import standard_output

if TYPE_CHECKING:
    from ...importing import ImportReport

FileArgument = Annotated[
    Path,
    typer.Argument(
        metavar="FILE",
        help="A world or model of Gazebo (.sdf, .world), the folder of a model, or a scene graph "
        "(.wrl, .x3d).",
    ),
]


def import_scene(
    file: FileArgument,
    out: Annotated[
        Path, option(OUTPUT, "--out", "-o", metavar="DIR", help="The new folder.")
    ] = Path("scene"),
    as_json: JsonOption = False,
    data_path: DataPathOption = None,
) -> None:
    """Import a world or model of Gazebo, or a world of VRML: scene, robots, meshes.

    Included models are searched next to FILE, in every --data-path, and in the folders of
    GZ_SIM_RESOURCE_PATH and GAZEBO_MODEL_PATH. Nothing is downloaded.

    The table states what became of each element, with its line and reason; --json prints the same.
    The scene is checked as by uwsim check.
    """
    from ...checks import check_file
    from ...importing import ImportRequest, import_file

    result = import_file(ImportRequest(file=file, out=out, folders=tuple(data_path or ())))
    diagnostics = check_file(result.scene)
    n_errors = sum(diagnostic.severity == "error" for diagnostic in diagnostics)
    if as_json:
        print(result.report.to_json(str(result.scene)))
    else:
        print_report(result.report)
        for diagnostic in diagnostics:
            if diagnostic.severity != "note":
                print(clean_text(str(diagnostic)))
        print(clean_text(f"Next: uwsim info {result.scene}; uwsim run {result.scene} --view"))
    if n_errors:
        raise typer.Exit(INVALID_INPUT)


def print_report(report: ImportReport) -> None:
    """Print the rows of a report as a table, those that are not imported last."""
    from rich.markup import escape
    from rich.table import Table

    from ...importing.report import STATUSES

    grid = Table(box=None, pad_edge=False)
    for title in ("", "element", "place", "reason"):
        grid.add_column(title, no_wrap=title != "reason")
    for status in STATUSES:
        for row in report.rows:
            if row.status == status:
                place = f"{Path(row.file).name}:{row.line}"
                grid.add_row(status, escape(row.element), escape(place), escape(row.reason))
    standard_output().print(grid)
    counts = ", ".join(f"{report.count(status)} {status}" for status in STATUSES)
    rest = f", {report.n_unlisted} more" if report.n_unlisted else ""
    print(f"{counts}{rest}")
