r"""The original's result file: ``benchmarkOutput.dat``, here ``result.dat``.

.. code-block:: text

    Fog\tcorners\tcentroid\tTOTAL\tSimTime\t
    0\t1.83\t0.41\t2.24\t2\t
    0.05\tnan\tnan\tnan\t4\t

Every field is followed by a tab, numbers have C++'s default format (``%g``, six digits). A value
that is missing is ``nan`` and no row is dropped; the compatibility ``rows`` has the original back:
a row with a measure in error is left out, and a function that fails leaves its field out.
"""

from __future__ import annotations

from pathlib import Path

from .result import Cell, Column, Result, write_whole

LEVEL_NAMES = {
    "none": "None",
    "armPosition": "ArmPosition",
    "current": "Current",
    "fog": "Fog",
    "iteration": "Iteration",
    "light": "Light",
    "noise": "Noise",
}
"""Reference of an updater -> the original's name of it."""


def dat_text(result: Result, *, compatibility: frozenset[str] = frozenset()) -> str:
    """Return the text of ``result.dat``; ``repeat`` and ``seed`` lead when there are several."""
    columns = [c for c in result.columns if c.kind in ("run", "level", "measure", "score", "time")]
    columns.sort(key=lambda c: ("run", "level", "measure", "score", "time").index(c.kind))
    lines = ["".join(f"{_name(column)}\t" for column in columns)]
    for row in result.rows:
        cells = [(column, row[result.index(column.name)]) for column in columns]
        if "rows" in compatibility:
            if any(cell is None for column, cell in cells if column.kind == "measure"):
                continue
            cells = [(column, cell) for column, cell in cells if cell is not None]
        lines.append("".join(f"{_number(cell)}\t" for _, cell in cells))
    return "\n".join(lines) + "\n"


def save_dat(
    result: Result, directory: Path, *, compatibility: frozenset[str] = frozenset()
) -> Path:
    """Write ``result.dat`` into the result directory, whole or not at all."""
    path = directory / "result.dat"
    write_whole(path, dat_text(result, compatibility=compatibility))
    return path


def _name(column: Column) -> str:
    fixed = {"score": "TOTAL", "time": "SimTime"}
    return fixed.get(column.kind) or LEVEL_NAMES.get(column.name, column.name)


def _number(cell: Cell) -> str:
    return "nan" if cell is None else format(cell, "g")
