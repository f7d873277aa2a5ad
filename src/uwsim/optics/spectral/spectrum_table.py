"""A table of spectra in a file, as an absorption and attenuation meter records them.

.. code-block:: text

    # station 4, 2 m
    wavelength,absorption,beam_attenuation
    412,0.182,1.02
    440,0.131,0.94

Wavelengths are in nm, coefficients in 1/m. Two of ``absorption``, ``beam_attenuation`` and
``scattering`` follow from any order of the columns. Lines that begin with ``#`` are comments. All
errors are reported at once, each with its line.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from pathlib import Path

from ...base.files.input_files import read_document
from ...errors import Diagnostic, FileError, choices
from .spectral_water import N_WAVELENGTHS

MAX_BYTES = 1 << 20
"""The greatest size of a table [bytes]."""
WAVELENGTH = "wavelength"
COEFFICIENTS = ("absorption", "beam_attenuation", "scattering")
COLUMNS = (WAVELENGTH, *COEFFICIENTS)
"""The names of the columns."""
SEPARATORS = {";": "semicolons", "\t": "tabs"}
"""The separators that other programs write."""

Spectra = dict[str, tuple[float, ...]]
"""The columns of a table by name."""


def read_spectrum_table(path: Path) -> Spectra:
    """Read the columns of a table by name; there are wavelengths and two coefficients.

    Raises:
        FileError: the table is invalid; the error has every mistake, with its line.
    """
    text = read_document(path, at_most=MAX_BYTES).decode("utf-8", errors="replace")
    rows = [
        (number, [cell.strip() for cell in next(csv.reader([line]), [])])
        for number, line in enumerate(text.lstrip("\ufeff").splitlines(), start=1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not rows:
        message = f"is empty; expected the columns {', '.join(COLUMNS[:3])}"
        raise FileError([Diagnostic(file=str(path), line=1, message=message)])
    (header_line, header), *body = rows
    messages = [(header_line, message) for message in _find_header_errors(header)]
    if not messages:
        if len(body) > N_WAVELENGTHS[1]:
            message = f"has {len(body)} wavelengths; expected at most {N_WAVELENGTHS[1]}"
            messages = [(header_line, message)]
        else:
            messages = [(line, text) for line, row in body for text in _find_errors(header, row)]
    if messages:
        raise FileError(
            [Diagnostic(file=str(path), line=line, message=message) for line, message in messages]
        )
    return {name: tuple(float(row[index]) for _, row in body) for index, name in enumerate(header)}


def find_separator_error(header: Sequence[str]) -> str:
    """Describe a separator that is no comma; empty if the header has another error, or none.

    Args:
        header: the cells of the header between commas.
    """
    if len(header) == 1:
        for character, name in SEPARATORS.items():
            if character in header[0].strip():
                return f"the columns are separated by {name}; expected commas (1.5,0.2)"
    return ""


def _find_header_errors(header: list[str]) -> list[str]:
    if error := find_separator_error(header):
        return [error]
    messages = [
        f"no column is called {name!r:.40}.{choices(name, COLUMNS)}"
        for name in header
        if name not in COLUMNS
    ]
    if len(set(header)) < len(header):
        messages.append("a column occurs twice; expected each once")
    n_coefficients = sum(name in COEFFICIENTS for name in header)
    if not messages and (WAVELENGTH not in header or n_coefficients != len(COEFFICIENTS) - 1):
        messages.append(
            f"the columns are {', '.join(header)}; expected wavelength, and two of "
            f"{', '.join(COEFFICIENTS)}"
        )
    return messages


def _find_errors(header: list[str], row: list[str]) -> list[str]:
    if len(row) != len(header):
        return [f"has {len(row)} cells; expected {len(header)}"]
    return [
        f"{name} is {cell!r:.40}; expected a number"
        for name, cell in zip(header, row, strict=True)
        if not _is_number(cell)
    ]


def _is_number(cell: str) -> bool:
    try:
        return math.isfinite(float(cell))
    except ValueError:
        return False
