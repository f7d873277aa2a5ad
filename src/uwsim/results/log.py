"""Logs: the samples of a measure over time, in a CSV file for each measure.

.. code-block:: text

    fog [1/m],time [s],total [px],nw_x [px],nw_y [px]
    0.0,0.1,1.83,0.2,-0.1
    0.0,0.2,,,

Numbers are written with as many digits as they need to be read back exactly; an empty field means
that nothing was measured. Like a result, a log is a pure function of inputs, seed and versions.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from ..base.files.file_names import file_name
from ..errors import ResultError
from .atomic_file import write_text
from .result import MAX_VALUE

Sample = tuple[float | int | None, ...]

TIME = "time [s]"
"""The header of the column between the levels and the values."""


@dataclass(frozen=True, kw_only=True)
class Log:
    """The samples of one measure at all levels."""

    measure: str
    """The name of the measure."""
    header: tuple[str, ...]
    """The columns of a sample, with units: levels, ``time [s]``, value, components."""
    samples: tuple[Sample, ...] = ()
    """The samples in the order of measurement; the time counts from the start of the benchmark."""


def save_log(log: Log, directory: Path, file: str = "") -> Path:
    """Write ``measure-<file>.csv`` atomically; the default name of the file is the measure's."""
    path = directory / f"measure-{file or file_name(log.measure)}.csv"
    write_text(path, log_text(log))
    return path


def log_text(log: Log) -> str:
    """Return the text of a log; raise ResultError when a sample does not fit the header."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(log.header)
    for i, sample in enumerate(log.samples):
        if len(sample) != len(log.header):
            raise ResultError(
                f"log of {log.measure}: sample {i} has {len(sample)} values, "
                f"the header {len(log.header)}."
            )
        writer.writerow(["" if v is None else repr(v) for v in _python_numbers(sample)])
    return stream.getvalue()


def load_log(path: Path | str) -> Log:
    """Read a log back; raise ResultError when the file is no log."""
    path = Path(path)
    try:
        with path.open(encoding="utf-8", newline="") as stream:
            rows = csv.reader(stream, strict=True)
            if (header := next(rows, None)) is None:
                raise ValueError("it is empty")
            samples = tuple(tuple(map(_value, row)) for row in rows)
    except (OSError, ValueError, csv.Error) as error:
        raise ResultError(f"{path}: cannot be read as a log: {error}.") from None
    if any(len(sample) != len(header) for sample in samples):
        raise ResultError(f"{path}: a line has not as many fields as the header.")
    for line, sample in enumerate(samples, start=2):
        if any(value is not None and not abs(value) <= MAX_VALUE for value in sample):
            raise ResultError(f"{path}:{line}: expected numbers up to {MAX_VALUE:g}.")
    name = re.sub(r"^measure-", "", path.stem)
    return Log(measure=name, header=tuple(header), samples=samples)


def logs_of(directory: Path) -> tuple[Path, ...]:
    """Return the logs in a result directory, by name."""
    return tuple(sorted(directory.glob("measure-*.csv")))


def _python_numbers(sample: Sample) -> Iterable[float | int | None]:
    """Yield numpy scalars as Python numbers, whose ``repr`` is the number alone."""
    for value in sample:
        yield value if value is None or isinstance(value, int) else float(value)


def _value(cell: str) -> float | int | None:
    if cell == "":
        return None
    return int(cell) if re.fullmatch(r"-?\d+", cell) else float(cell)
