r"""The files of the original UWSim: a result, ``result.dat``, and logs, ``benchmark-<name>.data``.

.. code-block:: text

    Fog\tcorners\tcentroid\tTOTAL\tSimTime\t
    0\t1.83\t0.41\t2.24\t2\t
    0.05\tnan\tnan\tnan\t4\t

Every field is followed by a tab, numbers have C++'s default format (``%g``, six digits). A missing
value is ``nan`` and no row is dropped. The compatibility ``rows`` restores the original: a row with
a measure in error is omitted, and so is the field of a function that fails. Only a `euclideanNorm`
without an estimate and a `pathFollowing` without a path are in error; other measures without a
value have their start value. The original sums the errors of a row, and a missing path counts -1:
with one missing estimate beside it the row remains, and the two values are -1 and 0.

A measure with ``<log>`` has its own file, and a CSV file of the same samples. The first column has
the name of the outermost updater but holds the running time, as in the original; the details of the
measure follow. The file ends with a blank line. Levels are not distinguished.

.. code-block:: text

    Fog\tcorners_total\tcorners[]\tcorners[]\t
    0.1\t1.83\t0.2\t-0.1\t
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from ..base.expression import parse
from ..base.files.file_names import file_name
from ..benchmark.measures import (
    CollisionSpec,
    DistanceSpec,
    EuclideanNormSpec,
    MeasureSpec,
    ObjectCenteredOnCamSpec,
    PathFollowingSpec,
    PositionErrorSpec,
    Reconstruction3DSpec,
    TimeSpec,
)
from ..benchmark.plugin_checks import log_sample
from ..results.atomic_file import write_text
from ..results.log import TIME, Log
from ..results.result import Cell, Column, Result
from .trial.triggered_measure import TriggeredMeasure, finite_value

LEVEL_NAMES = {
    "none": "None",
    "armPosition": "ArmPosition",
    "current": "Current",
    "fog": "Fog",
    "iteration": "Iteration",
    "light": "Light",
    "noise": "Noise",
    "waveHeight": "WaveHeight",
}
"""The name of each swept parameter in the files of the original UWSim."""


def dat_text(
    result: Result,
    *,
    compatibility: frozenset[str] = frozenset(),
    measures: Sequence[MeasureSpec] = (),
) -> str:
    """Return the text of ``result.dat``; ``repeat`` and ``seed`` come first when there are several.

    Args:
        result: the result.
        compatibility: the compatibility quirks, of which ``rows`` applies here.
        measures: the measures of the benchmark; a measure that is not among them has one field.
    """
    specs = {spec.name: spec for spec in measures}
    fields = list(_fields(result, specs))
    lines = ["".join(f"{name}\t" for name, _ in fields)]
    for row in result.rows:
        cells = [(column, row[result.index(column.name)]) for _, column in fields]
        if "rows" in compatibility:
            names = [column.name for column in result.columns_of_kind("measure")]
            missing_names = [name for name in names if row[result.index(name)] is None]
            if sum(specs[name].error_flag if name in specs else 1 for name in missing_names):
                continue
            cells = list(_original_fields(result, row, cells, specs))
        lines.append("".join(f"{_number(cell)}\t" for _, cell in cells))
    return "\n".join(lines) + "\n"


def _original_fields(
    result: Result,
    row: Sequence[Cell],
    cells: Sequence[tuple[Column, Cell]],
    specs: Mapping[str, MeasureSpec],
) -> Iterator[tuple[Column, Cell]]:
    """Yield the fields of a row, with start values for missing values and the resulting score."""
    values: dict[str, float | None] = {}
    for column in result.columns_of_kind("measure"):
        cell = row[result.index(column.name)]
        spec = specs.get(column.name)
        start = None if spec is None else spec.start_value
        values[column.name] = float(cell) if isinstance(cell, int | float) else start
    for column, cell in cells:
        measure = column.name.partition(".")[0]
        if cell is None and measure in values and row[result.index(measure)] is None:
            yield column, values[measure]
        elif column.kind != "score" or cell is not None:
            yield column, cell
        elif column.expression and (total := _score(column.expression, values)) is not None:
            yield column, total


def _score(expression: str, values: Mapping[str, float | None]) -> float | None:
    return finite_value(parse(expression, list(values)).evaluate(values))[0]


def save_dat(
    result: Result,
    directory: Path,
    *,
    compatibility: frozenset[str] = frozenset(),
    measures: Sequence[MeasureSpec] = (),
) -> Path:
    """Write ``result.dat`` into the result directory atomically."""
    path = directory / "result.dat"
    write_text(path, dat_text(result, compatibility=compatibility, measures=measures))
    return path


def _fields(result: Result, specs: Mapping[str, MeasureSpec]) -> Iterator[tuple[str, Column]]:
    for kind in ("run", "level", "measure", "score", "time"):
        for column in result.columns:
            if column.kind != kind:
                continue
            if kind != "measure" or column.name not in specs:
                yield _name(column), column
                continue
            for name, column_name in specs[column.name].original_fields.items():
                yield name, result.columns[result.index(column_name)]


def detail_names(spec: MeasureSpec, n_logged: int) -> tuple[str, ...]:
    """Return the names that the original UWSim gives to the values in the log of a measure.

    Args:
        spec: the measure; a measure that the original lacks has all values of its log.
        n_logged: the number of values in a sample of the measure's log.
    """
    name = spec.name
    match spec:
        case TimeSpec() | DistanceSpec() | CollisionSpec():
            names: tuple[str, ...] = (name,)
        case EuclideanNormSpec():
            names = (f"{name}_total", *[f"{name}[]"] * (n_logged - 1))
        case ObjectCenteredOnCamSpec():
            names = (f"{name}_total", f"{name}_x", f"{name}_y")
        case PositionErrorSpec():
            names = ("total", "x", "y", "z", "rx", "ry", "rz", "rw")
        case Reconstruction3DSpec():
            names = ("mean error", "error variance", "coverage %", "outliers %")
        case PathFollowingSpec():
            names = ("ISE", "distanceToPath", "waypoint")
        case _:
            names = (name, *(f"{name}[]" for _ in range(n_logged - 1)))
    return names[:n_logged]


def details(measure: TriggeredMeasure) -> tuple[float | None, ...]:
    """Return the current values of a measure's details, in the order of `detail_names`."""
    values = [finite_value(value)[0] for value in log_sample(measure.measure)]
    if measure.has_start_value:
        values = [measure.spec.start_value, *(0.0 for _ in values[1:])]
    return tuple(values[: len(detail_names(measure.spec, len(values)))])


def data_text(log: Log, spec: MeasureSpec) -> str:
    """Return the text of ``benchmark-<name>.data``, with ``repeat`` and ``seed`` as in the CSV."""
    time = log.header.index(TIME)
    prefix = [name for name in log.header[:time] if name in ("repeat", "seed")]
    parameter = log.header[len(prefix)].partition(" ")[0]
    level_name = LEVEL_NAMES.get(parameter, parameter)
    names = detail_names(spec, len(log.header) - time - 1)
    lines = ["".join(f"{field}\t" for field in (*prefix, level_name, *names))]
    for sample in log.samples:
        cells = (*sample[: len(prefix)], *sample[time : time + 1 + len(names)])
        lines.append("".join(f"{_number(cell)}\t" for cell in cells))
    return "\n".join(lines) + "\n\n"


def save_data(log: Log, spec: MeasureSpec, directory: Path, file: str = "") -> Path:
    """Write ``benchmark-<file>.data`` atomically; the default name is the measure's."""
    path = directory / f"benchmark-{file or file_name(spec.name)}.data"
    write_text(path, data_text(log, spec))
    return path


def _name(column: Column) -> str:
    fixed = {"score": "TOTAL", "time": "SimTime"}
    return fixed.get(column.kind) or LEVEL_NAMES.get(column.name, column.name)


def _number(cell: Cell) -> str:
    return "nan" if cell is None else format(cell, "g")
