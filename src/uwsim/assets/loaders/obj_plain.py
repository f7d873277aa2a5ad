"""OBJ files in plainer terms: what trimesh does not read, written as what it does.

Comments behind numbers go, tabs and leading blanks become what trimesh expects, numbers relative to
the last vertex become absolute, and polygons that are not convex become triangles.
"""

from __future__ import annotations

import re
from array import array
from bisect import bisect_left

import numpy as np

from .polygons import ears, not_convex

COMMENT = re.compile(rb"^([ \t]*(?:v[nt]?|[flp])[ \t][^#\n]*)#[^\n]*", re.M)
"""A line of numbers with a comment behind it."""
INDENTED = re.compile(rb"^ +(?=(?:v[nt]?|[flp]) )", re.M)
CONTINUED = re.compile(rb"\\[ ]*\r?\n")
POLYGON = re.compile(rb"^f +((?:\S+ +){3,}\S+) *\r?$", re.M)
"""A face of more than three corners."""
RELATIVE = re.compile(rb"^f [^\n]*-[^\n]*$", re.M)
"""A face with numbers that count from the last vertex before it."""
NUMBERED = tuple(re.compile(rb"^%b " % kind, re.M) for kind in (b"v", b"vt", b"vn"))
VERTEX = re.compile(rb"^v +(\S+) +(\S+) +(\S+)", re.M)


def plain(data: bytes) -> bytes:
    """Return the text of an OBJ file in plain terms; what is wrong with it stays as it is."""
    if b"\n" not in data:
        data = data.replace(b"\r", b"\n")
    if b"#" in data:
        data = COMMENT.sub(rb"\g<1>", data)
    if b"\\" in data:
        data = CONTINUED.sub(b" ", data)
    if b"\t" in data:
        data = data.replace(b"\t", b" ")
    data = INDENTED.sub(b"", data)
    try:
        if RELATIVE.search(data):
            data = _with_absolute_numbers(data)
        return _with_triangles(data)
    except (ValueError, IndexError, OverflowError):  # a number that is none, or of no corner
        return data


def _with_absolute_numbers(data: bytes) -> bytes:
    """Write the numbers of vertices from the first one on; trimesh counts from the file's last."""
    places = [[each.start() for each in kind.finditer(data)] for kind in NUMBERED]

    def absolute(face: re.Match[bytes]) -> bytes:
        so_far = [bisect_left(starts, face.start()) for starts in places]
        words = face[0].split()[1:]
        return b" ".join([b"f", *(_absolute(word, so_far) for word in words)])

    return RELATIVE.sub(absolute, data)


def _absolute(word: bytes, so_far: list[int]) -> bytes:
    """Return a corner, as ``-3/-3/-1``, with numbers from the first."""
    parts = word.split(b"/")
    for i, (part, n) in enumerate(zip(parts, so_far, strict=False)):
        if part.startswith(b"-"):
            if not -n <= int(part) < 0:
                raise IndexError("a corner that is not there")
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
    for i in sorted(not_convex(points, starts, n)):
        words = data[spans[2 * i] : spans[2 * i + 1]].split()[1:]
        triangles = ears(points[starts[i] : starts[i] + n[i]])
        pieces.append(data[end : spans[2 * i]])
        pieces += [b"f " + b" ".join(words[k] for k in each) + b"\n" for each in triangles]
        end = spans[2 * i + 1]
    return b"".join([*pieces, data[end:]])
