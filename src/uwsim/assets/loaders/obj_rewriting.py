"""Conversion of OBJ files to the subset of OBJ that trimesh reads.

Comments behind numbers are removed, tabs and leading blanks become what trimesh expects, numbers
relative to the last vertex become absolute, and polygons that are not convex become triangles.
"""

from __future__ import annotations

import re
from array import array
from bisect import bisect_left

import numpy as np

from .polygons import concave_polygons, cut_ears

COMMENT = re.compile(rb"^([ \t]*(?:v[nt]?|[flp])[ \t][^#\n]*)#[^\n]*", re.M)
"""The pattern of a line of numbers with a comment behind it."""
INDENTATION = re.compile(rb"^ +(?=(?:v[nt]?|[flp]) )", re.M)
CONTINUATION = re.compile(rb"\\[ ]*\r?\n")
POLYGON = re.compile(rb"^f +((?:\S+ +){3,}\S+) *\r?$", re.M)
"""The pattern of a face of more than three corners."""
RELATIVE_FACE = re.compile(rb"^f [^\n]*-[^\n]*$", re.M)
"""The pattern of a face with numbers that count from the last vertex before it."""
NUMBERED_LINES = tuple(re.compile(rb"^%b " % kind, re.M) for kind in (b"v", b"vt", b"vn"))
VERTEX = re.compile(rb"^v +(\S+) +(\S+) +(\S+)", re.M)


def rewrite(data: bytes) -> bytes:
    """Convert the text of an OBJ file for trimesh; invalid parts remain unchanged."""
    if b"\n" not in data:
        data = data.replace(b"\r", b"\n")
    if b"#" in data:
        data = COMMENT.sub(rb"\g<1>", data)
    if b"\\" in data:
        data = CONTINUATION.sub(b" ", data)
    if b"\t" in data:
        data = data.replace(b"\t", b" ")
    data = INDENTATION.sub(b"", data)
    try:
        if RELATIVE_FACE.search(data):
            data = _with_absolute_numbers(data)
        return _with_triangles(data)
    except (ValueError, IndexError, OverflowError):  # an invalid number or corner
        return data


def _with_absolute_numbers(data: bytes) -> bytes:
    """Replace relative vertex numbers, which trimesh would count from the end of the file."""
    line_starts = [[match.start() for match in kind.finditer(data)] for kind in NUMBERED_LINES]

    def rewrite_face(face: re.Match[bytes]) -> bytes:
        counts_before = [bisect_left(starts, face.start()) for starts in line_starts]
        words = face[0].split()[1:]
        return b" ".join([b"f", *(_absolute_corner(word, counts_before) for word in words)])

    return RELATIVE_FACE.sub(rewrite_face, data)


def _absolute_corner(word: bytes, counts_before: list[int]) -> bytes:
    """Return a corner such as ``-3/-3/-1`` with absolute numbers."""
    parts = word.split(b"/")
    for i, (part, n) in enumerate(zip(parts, counts_before, strict=False)):
        if part.startswith(b"-"):
            if not -n <= int(part) < 0:
                raise IndexError("a corner that does not exist")
            parts[i] = b"%d" % (n + int(part) + 1)
    return b"/".join(parts)


def _with_triangles(data: bytes) -> bytes:
    """Write the polygons that are not convex as triangles."""
    spans, counts, numbers = array("q"), array("q"), array("q")
    for face in POLYGON.finditer(data):
        words = face[1].split()
        spans.extend(face.span())
        counts.append(len(words))
        numbers.extend(int(word.partition(b"/")[0]) for word in words)
    if not counts:
        return data
    vertices = np.array(VERTEX.findall(data)).astype(np.float64).reshape(-1, 3)
    points, n = vertices[np.array(numbers) - 1], np.array(counts)
    starts = np.cumsum(n) - n
    pieces, end = [], 0
    for i in sorted(concave_polygons(points, starts, n)):
        words = data[spans[2 * i] : spans[2 * i + 1]].split()[1:]
        triangles = cut_ears(points[starts[i] : starts[i] + n[i]])
        pieces.append(data[end : spans[2 * i]])
        pieces += [b"f " + b" ".join(words[k] for k in triangle) + b"\n" for triangle in triangles]
        end = spans[2 * i + 1]
    return b"".join([*pieces, data[end:]])
