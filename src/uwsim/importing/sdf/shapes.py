"""Reader of ``<visual>`` and ``<collision>`` elements."""

from __future__ import annotations

from pathlib import Path

from lxml import etree

from ...base.geometry import UNIT_SCALE
from .spec import Colour, Shape, Visual
from .values import (
    Source,
    attribute_of,
    child_of,
    children_of,
    numbers_in,
    pose_of,
    positive_of,
    tag_of,
    text_of,
    triple_of,
)

UNREAD_SHAPES = {
    "heightmap": "height maps are not imported; see <u:bathymetry> in docs/bathymetry.md",
    "image": "extruded images are not imported",
    "polyline": "extruded polylines are not imported",
    "empty": "it has no geometry",
}
"""The reasons of the geometries that have no counterpart."""


def read_shapes(node: etree._Element, tag: str, path: Path, source: Source) -> tuple[Visual, ...]:
    """Read all visuals or collisions of a link.

    Args:
        node: the link.
        tag: ``visual`` or ``collision``.
        path: the file, in which names of meshes are looked up.
        source: the file that is read.
    """
    shapes = (_read_shape(child, tag, path, source) for child in children_of(node, tag))
    return tuple(shape for shape in shapes if shape is not None)


def _read_shape(node: etree._Element, tag: str, path: Path, source: Source) -> Visual | None:
    name = attribute_of(node, "name")
    geometry = child_of(node, "geometry")
    children = [] if geometry is None else [child for child in geometry if tag_of(child)]
    if not children:
        source.leave_out(node, f"{tag} {name}", UNREAD_SHAPES["empty"])
        return None
    if (kind := tag_of(children[0])) in UNREAD_SHAPES:
        source.leave_out(node, f"{tag} {name}", UNREAD_SHAPES[kind])
        return None
    shape = _read_geometry(children[0], path, source)
    if shape is None:
        return None
    return Visual(
        name=name,
        pose=pose_of(node, source),
        shape=shape,
        colour=_read_colour(node, source),
        place=source.place(node),
    )


def _read_geometry(node: etree._Element, path: Path, source: Source) -> Shape | None:
    kind = tag_of(node)
    if kind == "box":
        return Shape(
            kind="box", size=_extent(triple_of(node, UNIT_SCALE, source, "size"), node, source)
        )
    if kind == "sphere":
        width = 2.0 * positive_of(node, 1.0, source, "radius")
        return Shape(kind="sphere", size=(width, width, width))
    if kind in ("cylinder", "cone", "capsule"):
        width = 2.0 * positive_of(node, 0.5, source, "radius")
        length = positive_of(node, 1.0, source, "length")
        height = length + width if kind == "capsule" else length
        return Shape(kind=kind, size=(width, width, height))  # type: ignore[arg-type]
    if kind == "ellipsoid":
        x, y, z = _extent(triple_of(node, UNIT_SCALE, source, "radii"), node, source)
        return Shape(kind="ellipsoid", size=(2.0 * x, 2.0 * y, 2.0 * z))
    if kind == "plane":
        size = child_of(node, "size")
        values = (1.0, 1.0) if size is None else numbers_in(size, 2, source) or (1.0, 1.0)
        normal = triple_of(node, (0.0, 0.0, 1.0), source, "normal")
        return Shape(kind="plane", size=(abs(values[0]), abs(values[1]), 0.0), normal=normal)
    if kind == "mesh":
        uri = text_of(node, "uri") or text_of(node, "filename")
        if not uri:
            source.diagnostics.error(node, "<mesh> lacks its <uri>")
            return None
        return Shape(
            kind="mesh",
            uri=uri,
            folder=path,
            scale=triple_of(node, UNIT_SCALE, source, "scale"),
            submesh=text_of(node, "submesh", "name"),
        )
    kinds = ("box", "sphere", "cylinder", "cone", "capsule", "ellipsoid", "plane", "mesh")
    source.diagnostics.report_unknown(node, f"<{kind[:60]}> is no geometry", kind, kinds)
    return None


def _extent(
    size: tuple[float, float, float], node: etree._Element, source: Source
) -> tuple[float, float, float]:
    if not min(size) > 0.0:
        source.diagnostics.error(node, f"<{tag_of(node)}> has a size of 0 or below")
        return UNIT_SCALE
    return size


def _read_colour(node: etree._Element, source: Source) -> Colour | None:
    material = child_of(node, "material")
    for name in ("diffuse", "ambient"):
        child = child_of(material, name)
        if child is None or not (words := (child.text or "").split()):
            continue
        values = numbers_in(child, 3 if len(words) == 3 else 4, source) or (1.0, 1.0, 1.0)
        red, green, blue, opacity = (min(max(value, 0.0), 1.0) for value in (*values, 1.0)[:4])
        transparency = child_of(node, "transparency")
        if transparency is not None and (share := numbers_in(transparency, 1, source)):
            opacity *= 1.0 - min(max(share[0], 0.0), 1.0)
        return red, green, blue, opacity
    if material is not None and (script := text_of(material, "script", "name")):
        source.leave_out(material, f"material {script}", "material scripts are not read: no colour")
    return None
