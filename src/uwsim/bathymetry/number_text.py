"""The parsing of many numbers in a text file, with the line of the first wrong word."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np

from ..base.geometry import Array
from ..errors import AssetError


def parse_numbers(path: Path, data: bytes, line: int, n: int | None = None) -> Array:
    """Parse the numbers of a text, separated by blanks or line ends.

    Args:
        path: the file, for errors.
        data: the text; each number has two bytes at least.
        line: the number of its first line, for errors.
        n: the expected number of numbers; None: any.

    Raises:
        AssetError: a word is no number, or there are more or fewer numbers.
    """
    if n is not None and len(data) + 1 < 2 * n:
        raise AssetError(f"{path}: ends too early; expected {n} heights after its header.")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            values: Array = np.fromstring(data.decode("ascii"), dtype=np.float64, sep=" ")
    except (DeprecationWarning, ValueError, UnicodeDecodeError) as error:
        raise AssetError(_find_error(path, data, line)) from error
    if n is not None and len(values) != n:
        raise AssetError(f"{path}: has {len(values)} heights; expected {n} by its header.")
    is_invalid = np.isinf(values)
    if is_invalid.any():
        raise AssetError(f"{path}: has an infinite number; expected finite heights.")
    return values


def _find_error(path: Path, data: bytes, line: int) -> str:
    """Return an error that names the first word that is no number."""
    for number, row in enumerate(data.split(b"\n"), start=line):
        for word in row.split():
            try:
                float(word)
            except ValueError:
                text = word[:30].decode("ascii", errors="replace")
                return f"{path}:{number}: {text!r}; expected a number."
    return f"{path}: has text that is no number; expected numbers separated by blanks."
