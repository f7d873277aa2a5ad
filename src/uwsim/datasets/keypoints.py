"""Declared keypoints of classes, in a JSON file.

.. code-block:: json

    {"blackbox": {"handle": [0.0, 0.0, 0.15], "lamp": [0.2, 0.0, 0.1]}}

A point has x, y and z [m] in the frame of the vehicle's base, or in the axes of the object's mesh.
Classes that the file does not have keep the corners of their boxes.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..errors import AssetError, BadSetting, ErrorCollector, short_repr

KEYPOINTS_FILE = "keypoints.json"
"""The file of the keypoints in a data set."""
MAX_POINTS = 64
"""The greatest number of keypoints of a class."""
MAX_COORDINATE = 1000.0
"""The greatest coordinate of a keypoint [m]."""
MAX_BYTES = 1_000_000
"""The greatest size of a file of keypoints [bytes]."""
Keypoints = tuple[tuple[str, tuple[tuple[str, tuple[float, float, float]], ...]], ...]
"""The names and the points of each class."""


def read_keypoints(path: Path) -> Keypoints:
    """Read a file of keypoints.

    Raises:
        AssetError: the file cannot be read.
        BadSetting: the file is no JSON, or a point is invalid; with all errors.
    """
    try:
        size = path.stat().st_size
        text = "" if size > MAX_BYTES else path.read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        raise AssetError(f"{path}: {error.strerror}.") from None
    if size > MAX_BYTES:
        raise AssetError(f"{path}: has {size} bytes; a file of keypoints has at most {MAX_BYTES}.")
    try:
        document = json.loads(text)
    except (ValueError, RecursionError) as error:
        line = getattr(error, "lineno", 1)
        reason = getattr(error, "msg", type(error).__name__)
        raise BadSetting(f"{path}:{line}: is not JSON: {reason}.") from None
    errors = ErrorCollector()
    for message in _find_errors(document):
        with errors.collect():
            raise BadSetting(f"{path}: {message}")
    errors.raise_errors()
    return tuple(
        (label, tuple((name, (float(x), float(y), float(z))) for name, (x, y, z) in points.items()))
        for label, points in document.items()
    )


def to_document(keypoints: Keypoints) -> dict[str, dict[str, list[float]]]:
    """Return the document of a file of keypoints."""
    return {label: {name: list(point) for name, point in points} for label, points in keypoints}


def _find_errors(document: Any) -> Iterator[str]:
    if not isinstance(document, dict) or not document:
        yield 'expected an object of classes, as {"blackbox": {"handle": [0.0, 0.0, 0.15]}}.'
        return
    for label, points in document.items():
        if not isinstance(points, dict) or not 1 <= len(points) <= MAX_POINTS:
            yield f"{short_repr(label)}: expected an object of 1 to {MAX_POINTS} points."
            continue
        for name, point in points.items():
            if not _is_point(point):
                yield (
                    f"{short_repr(label)}: {short_repr(name)} is {short_repr(point)}; expected "
                    f"[x, y, z] in metres, each up to {MAX_COORDINATE:g}."
                )


def _is_point(point: Any) -> bool:
    return (
        isinstance(point, list)
        and len(point) == 3
        and all(isinstance(x, int | float) and not isinstance(x, bool) for x in point)
        and all(math.isfinite(x) and abs(x) <= MAX_COORDINATE for x in point)
    )
