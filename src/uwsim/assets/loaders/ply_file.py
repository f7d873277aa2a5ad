"""The reader of PLY files, text or binary, with polygons of any number of corners.

Format: Greg Turk, "The PLY Polygon File Format", 1994; texture coordinates as MeshLab and Blender
write them: a list ``texcoord`` of each face, or two properties of each vertex.
"""

from __future__ import annotations

import abc
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
import trimesh

from .polygons import triangulate
from .references import References

Array = npt.NDArray[Any]

TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4",
    "float": "f4", "double": "f8",
    "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
    "int64": "i8", "uint64": "u8", "float32": "f4", "float64": "f8",
}  # fmt: skip
"""The NumPy type of each name of a number type, in old and new files."""
MAX_RECORDS = 24_000_000
"""The greatest number of records of an element, and of numbers in all of its lists."""
FORMATS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
CORNERS = ("vertex_indices", "vertex_index")
COORDINATES = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))
COLOURS = ("red", "green", "blue")


@dataclass
class Property:
    """A property of an element: in each record a number, or a list of numbers."""

    name: str
    kind: str
    """The NumPy type of the numbers."""
    count: str | None = None
    """The NumPy type of the length of the list; None for a number."""


@dataclass
class Element:
    """An element of the file: a number of records with equal properties."""

    name: str
    length: int
    properties: list[Property] = field(default_factory=list)


@dataclass
class Lists:
    """The values of a list property: the length of each record's list, and all numbers."""

    counts: Array
    values: Array


Columns = dict[str, Array | Lists]
"""The numbers of all records, by the names of their properties."""


def read_parts(
    data: bytes, references: References
) -> list[tuple[npt.NDArray[np.float64], trimesh.Trimesh]]:
    """Return the triangles of a file as a mesh for each image, each with the identity as pose.

    Args:
        data: the file.
        references: the reader of the images of the file.

    Raises:
        ValueError: the file is not PLY, ends too early, or names a vertex that does not exist.
    """
    elements, body, images = _header(data)
    columns: dict[str, Columns] = {"vertex": {}, "face": {}} | body.read(elements)
    vertices, faces = columns["vertex"], columns["face"]
    polygons = _polygons(faces)
    if polygons is None or not set("xyz") <= vertices.keys():
        return []
    points = np.stack([_numbers(vertices[axis]) for axis in "xyz"], axis=-1).astype(np.float64)
    corners, counts = polygons.values.astype(np.int64), polygons.counts
    if len(corners) and not 0 <= corners.min() <= corners.max() < len(points):
        raise ValueError("a face has the index of a vertex that does not exist")
    triangles = triangulate(points[corners], counts)
    face = np.repeat(np.arange(len(counts)), np.maximum(counts - 2, 0))
    uvs = _uvs(vertices, faces, corners, counts)
    image = np.zeros(len(face), dtype=np.int64)
    if uvs is not None and len(images) > 1 and "texnumber" in faces:
        image = _numbers(faces["texnumber"])[face].astype(np.int64)
    visuals: Any = trimesh.visual
    parts = []
    for number in np.unique(image):
        image_corners = triangles[image == number].ravel()
        mesh = trimesh.Trimesh(
            vertices=points[corners[image_corners]],
            faces=np.arange(len(image_corners)).reshape(-1, 3),
            process=False,
        )
        name = images[number] if 0 <= number < len(images) else None
        picture = None if name is None or uvs is None else references.image(name)
        if picture is not None and uvs is not None:
            material = visuals.material.PBRMaterial(baseColorTexture=picture)
            mesh.visual = visuals.TextureVisuals(uv=uvs[image_corners], material=material)
        elif (colours := _colours(vertices, corners[image_corners])) is not None:
            mesh.visual = visuals.ColorVisuals(mesh, vertex_colors=colours)
        elif (colours := _colours(faces, face[image == number])) is not None:
            mesh.visual = visuals.ColorVisuals(mesh, face_colors=colours)
        parts.append((np.eye(4), mesh))
    return parts


def _polygons(faces: Columns) -> Lists | None:
    """Return the vertices of each face: the list with a known name, or the only list."""
    lists = {name: column for name, column in faces.items() if isinstance(column, Lists)}
    corner_list = next((lists[name] for name in CORNERS if name in lists), None)
    return next(iter(lists.values())) if corner_list is None and len(lists) == 1 else corner_list


def _numbers(column: Array | Lists) -> Array:
    if isinstance(column, Lists):
        raise ValueError("it has lists where numbers are expected")
    return column


def _uvs(vertices: Columns, faces: Columns, corners: Array, counts: Array) -> Array | None:
    """Return the texture coordinates of the corners, (n, 2), 0 where missing; None without any."""
    face_lists = faces.get("texcoord")
    if isinstance(face_lists, Lists):
        has_uvs = face_lists.counts == 2 * counts
        uvs = np.zeros((len(corners), 2))
        face_uvs = face_lists.values[np.repeat(has_uvs, face_lists.counts)]
        uvs[np.repeat(has_uvs, counts)] = face_uvs.reshape(-1, 2)
        return uvs
    for names in COORDINATES:
        if set(names) <= vertices.keys():
            return np.stack([_numbers(vertices[name])[corners] for name in names], axis=-1)
    return None


def _colours(columns: Columns, rows: Array) -> npt.NDArray[np.uint8] | None:
    """Return the colours of records, (n, 3); None where they have none."""
    if not set(COLOURS) <= columns.keys():
        return None
    values = np.stack([_numbers(columns[name])[rows] for name in COLOURS], axis=-1)
    if values.dtype.kind == "f":
        values = values * 255.0
    elif values.dtype == np.uint16:
        values = values / 257.0
    colours: npt.NDArray[np.uint8] = np.clip(np.nan_to_num(values), 0, 255).astype(np.uint8)
    return colours


def _header(data: bytes) -> tuple[list[Element], _Body, list[str]]:
    """Return the kinds of records, the part behind the header, and the names of images."""
    elements: list[Element] = []
    images: list[str] = []
    order = None
    for line, end in _lines(data):
        match line.split():
            case ["format", word, *_] if word in FORMATS:
                order = FORMATS[word]
            case ["element", name, length] if length.isdecimal():
                elements.append(Element(name, int(length)))
            case ["property", "list", count, kind, name] if (
                elements and kind in TYPES and TYPES.get(count, "f")[0] in "iu"
            ):
                elements[-1].properties.append(Property(name, TYPES[kind], TYPES[count]))
            case ["property", kind, name] if elements and kind in TYPES:
                elements[-1].properties.append(Property(name, TYPES[kind]))
            case ["comment", word, *_] if word.lower() == "texturefile":
                images.append(line.split(word, 1)[1].strip())
            case ["end_header"] if order is not None:
                return elements, _Binary(data, end, order) if order else _Text(data[end:]), images
            case ["format" | "element" | "property" | "end_header", *_]:
                raise ValueError(f"its header has the line {line[:80]!r}")
    raise ValueError("its header has no end")


def _lines(data: bytes) -> Iterator[tuple[str, int]]:
    """Yield the lines of the header behind the first, each with its end."""
    if data[:3] != b"ply" or not data[3:4].isspace():
        raise ValueError("it does not begin with the word ply")
    newline = b"\r" if data[3:4] == b"\r" and data[4:5] != b"\n" else b"\n"
    start = data.find(newline) + 1
    while start and (end := data.find(newline, start)) >= 0:
        yield data[start:end].decode("utf-8").strip(), end + 1
        start = end + 1


class _Body(abc.ABC):
    """The part behind the header; positions in it count bytes, or the numbers of a text."""

    start: int
    end: int

    @abc.abstractmethod
    def size(self, kind: str) -> int:
        """Return the number of positions that a number takes."""

    @abc.abstractmethod
    def read_numbers(self, positions: Array, kind: str) -> Array:
        """Return the numbers at positions."""

    def read_length(self, position: int, kind: str) -> int:
        """Return the length of the list at a position; ValueError if there is none."""
        return int(self.read_lengths(np.array([position]), kind)[0])

    def read_lengths(self, positions: Array, kind: str) -> Array:
        """Return the lengths of the lists at positions; ValueError if one is invalid."""
        lengths = self.read_numbers(positions, kind).astype(np.int64)
        if len(lengths) and lengths.min() < 0:
            raise ValueError(f"a list of {lengths.min()} numbers")
        return lengths

    def read(self, elements: list[Element]) -> dict[str, Columns]:
        """Return the records of each kind.

        Raises:
            ValueError: there are fewer than the header states, or too many.
        """
        columns: dict[str, Columns] = {}
        position = self.start
        for element in elements:
            min_size = sum(self.size(prop.count or prop.kind) for prop in element.properties)
            if position + min_size * element.length > self.end:
                raise ValueError(f"it ends before its {element.length} records {element.name!r}")
            if element.length > MAX_RECORDS:
                raise ValueError(f"{element.length} records; at most {MAX_RECORDS} are read")
            if element.length and min_size:
                columns[element.name], position = self._columns(element, position)
        return columns

    def _columns(self, element: Element, position: int) -> tuple[Columns, int]:
        """Return records and the position behind them, one by one if lists have other lengths."""
        n, length = element.length, self._record_end(element, position) - position
        if position + n * length <= self.end:
            columns = self._read_records(element, position + length * np.arange(n), is_equal=True)
            if columns is not None:
                return columns, position + n * length
        positions = np.empty(n, dtype=np.int64)
        for i in range(n):
            positions[i] = position
            position = self._record_end(element, position)
        return self._read_records(element, positions) or {}, position

    def _record_end(self, element: Element, position: int) -> int:
        """Return the position behind the record that begins at a position."""
        for prop in element.properties:
            if prop.count is not None and position + self.size(prop.count) <= self.end:
                length = self.read_length(position, prop.count)
                position += self.size(prop.count) + length * self.size(prop.kind)
            else:
                position += self.size(prop.count or prop.kind)
        if position > self.end:
            raise ValueError(f"it ends before the last of its records {element.name!r}")
        return position

    def _read_records(
        self, element: Element, positions: Array, *, is_equal: bool = False
    ) -> Columns | None:
        """Return the records that begin at positions; None if lists differ but must be equal."""
        columns: Columns = {}
        for prop in element.properties:
            if prop.count is None:
                columns[prop.name] = self.read_numbers(positions, prop.kind)
                positions = positions + self.size(prop.kind)
                continue
            counts = self.read_lengths(positions, prop.count)
            if is_equal and (counts != counts[0]).any():
                return None
            if (total := int(counts.sum())) > MAX_RECORDS:
                raise ValueError(f"lists of {total} numbers; at most {MAX_RECORDS} are read")
            positions = positions + self.size(prop.count)
            offsets = np.arange(total) - np.repeat(np.cumsum(counts) - counts, counts)
            value_positions = np.repeat(positions, counts) + offsets * self.size(prop.kind)
            columns[prop.name] = Lists(counts, self.read_numbers(value_positions, prop.kind))
            positions = positions + counts * self.size(prop.kind)
        return columns


class _Text(_Body):
    """The numbers of a text; a line for each record may have more than the header states."""

    def __init__(self, text: bytes) -> None:
        self._values: Array = np.fromstring(text, sep=" ")
        self.start, self.end = 0, len(self._values)
        per_line = [n for line in text.splitlines() if (n := len(line.split()))]
        self._lines: Array = np.concatenate([[0], np.cumsum(per_line)]).astype(np.int64)

    def read(self, elements: list[Element]) -> dict[str, Columns]:
        first_line = 0
        lengths = [element.length for element in elements]
        if sum(lengths) != len(self._lines) - 1 or self._lines[-1] != self.end:
            return super().read(elements)
        columns: dict[str, Columns] = {}
        for element in elements:
            positions = self._lines[first_line : first_line + element.length]
            columns[element.name] = self._read_records(element, positions) or {}
            first_line += element.length
        return columns

    def size(self, kind: str) -> int:
        return 1

    def read_numbers(self, positions: Array, kind: str) -> Array:
        if len(positions) and positions.max() >= self.end:
            raise ValueError("it ends before the last of its records")
        return self._values[positions].astype(kind)

    def read_lengths(self, positions: Array, kind: str) -> Array:
        lengths = self.read_numbers(positions, "f8")
        if not ((lengths >= 0) & (lengths <= self.end) & (lengths == np.floor(lengths))).all():
            raise ValueError("the length of a list is invalid")
        return lengths.astype(np.int64)


class _Binary(_Body):
    def __init__(self, data: bytes, start: int, order: str) -> None:
        self._data, self._bytes = data, np.frombuffer(data, dtype=np.uint8)
        self._order = order
        self._endian: Literal["little", "big"] = "little" if order == "<" else "big"
        self.start, self.end = start, len(data)

    def size(self, kind: str) -> int:
        return int(kind[1:])

    def read_numbers(self, positions: Array, kind: str) -> Array:
        buffer = np.empty((len(positions), self.size(kind)), dtype=np.uint8)
        for i in range(buffer.shape[1]):
            buffer[:, i] = self._bytes[positions + i]
        return buffer.view(self._order + kind)[:, 0].astype(kind)

    def read_length(self, position: int, kind: str) -> int:
        buffer = self._data[position : position + self.size(kind)]
        length = int.from_bytes(buffer, self._endian, signed=kind[0] == "i")
        if length < 0:
            raise ValueError(f"a list of {length} numbers")
        return length
