"""Reader of ``<link>`` elements in robot files: inertia, visual and collision shapes."""

from __future__ import annotations

from typing import cast

from lxml import etree

from ...base.geometry import ZERO, Triple
from ...schema import MAX_DISTANCE, MAX_NUMBER, Diagnostics, source_line
from .robot import Colour, LinkSpec, ShapeKind, VisualSpec
from .values import (
    clamp_size,
    colour_of,
    elements_of,
    name_of,
    number_of,
    numbers_of,
    origin_of,
    size_of,
    triple_of,
)


def read_link(
    node: etree._Element, materials: dict[str, Colour], diagnostics: Diagnostics
) -> LinkSpec:
    """Read a link."""
    inertial = node.find("inertial")
    mass, centre, rpy = 0.0, ZERO, ZERO
    inertia = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if inertial is not None:
        centre, rpy = origin_of(inertial, diagnostics)
        if (mass_node := inertial.find("mass")) is not None:
            mass = size_of(mass_node, "value", diagnostics, 0.0)
        if (inertia_node := inertial.find("inertia")) is not None:
            xx, yy, zz, xy, xz, yz = (
                number_of(inertia_node, f"i{axes}", diagnostics, 0.0)
                for axes in ("xx", "yy", "zz", "xy", "xz", "yz")
            )
            inertia = (xx, yy, zz, xy, xz, yz)
    return LinkSpec(
        source_line=source_line(node, diagnostics.file),
        name=name_of(node),
        visuals=_shapes(node.findall("visual"), materials, diagnostics),
        collisions=_shapes(node.findall("collision"), materials, diagnostics),
        mass=mass,
        centre_of_mass=centre,
        inertia_rpy=rpy,
        inertia=inertia,
    )


def read_materials(root: etree._Element, diagnostics: Diagnostics) -> dict[str, Colour]:
    """Return the colours of named materials, which the robot or its visuals define."""
    colours: dict[str, Colour] = {}
    first_uses: dict[
        str, etree._Element
    ] = {}  # the first element that uses each name without a definition
    ignored_diagnostics = Diagnostics(
        diagnostics.file
    )  # errors in visuals are reported by `read_link`
    for path, sink in (("material", diagnostics), ("link/visual/material", ignored_diagnostics)):
        for node in root.findall(path):
            colour = colour_of(node, sink)
            if colour is not None and name_of(node):
                colours.setdefault(name_of(node), colour)
            if path != "material" and next(elements_of(node), None) is None:
                first_uses.setdefault(name_of(node), node)
    textures = (node for node in root.iter("material") if node.find("texture") is not None)
    known_names = {"", *colours, *map(name_of, textures)}
    for name in [name for name in first_uses if name not in known_names]:
        suggestion = diagnostics.suggest(name, colours, "warning")
        diagnostics.warning(
            first_uses[name], f"no material is called {name!r}: it gives no colour.{suggestion}"
        )
    return colours


def _file_of(shape: etree._Element) -> str:
    from ...assets.packages import strip_file_scheme

    return strip_file_scheme(shape.get("filename") or "")


def _edges_of(box: etree._Element, diagnostics: Diagnostics) -> Triple:
    edges = numbers_of(box, "size", 3, diagnostics) or [0.0, 0.0, 0.0]
    text = box.get("size", "")
    if min(edges) < 0:
        diagnostics.error(box, f"size of <box> is {text[:60]!r}; expected numbers >= 0")
    elif max(edges) > MAX_NUMBER:
        limit = f"expected numbers up to {MAX_DISTANCE:g}"
        diagnostics.error(box, f"size of <box> is {text[:60]!r}; {limit}")
    x, y, z = (clamp_size(box, "size", edge, diagnostics) if edge > 0 else edge for edge in edges)
    return x, y, z


def _shapes(
    nodes: list[etree._Element], materials: dict[str, Colour], diagnostics: Diagnostics
) -> tuple[VisualSpec, ...]:
    shapes = (_shape(node, materials, diagnostics) for node in nodes)
    return tuple(shape for shape in shapes if shape is not None)


def _shape(
    node: etree._Element, materials: dict[str, Colour], diagnostics: Diagnostics
) -> VisualSpec | None:
    position, rpy = origin_of(node, diagnostics)
    geometry = node.find("geometry")
    shape = None if geometry is None else next(elements_of(geometry), None)
    if shape is None:
        diagnostics.error(
            node, f"<{node.tag}> lacks a <geometry> with a mesh, box, cylinder or sphere"
        )
        return None
    colour = None
    if (material := node.find("material")) is not None:
        colour = colour_of(material, diagnostics) or materials.get(name_of(material))
    kind = shape.tag
    file, size, scale = "", (1.0, 1.0, 1.0), (1.0, 1.0, 1.0)
    if kind == "mesh":
        file = _file_of(shape)
        if not file:
            diagnostics.error(shape, "<mesh> lacks the attribute filename")
        scale = triple_of(shape, "scale", diagnostics, scale)
    elif kind == "box":
        size = _edges_of(shape, diagnostics)
    elif kind in ("cylinder", "sphere"):
        diameter = 2 * size_of(shape, "radius", diagnostics, None)
        length = size_of(shape, "length", diagnostics, None) if kind == "cylinder" else diameter
        size = (diameter, diameter, length)
    else:
        kinds = ("mesh", "box", "cylinder", "sphere")
        tag = str(kind)
        diagnostics.report_unknown(shape, f"<{tag[:60]}> is not a geometry", tag, kinds)
        return None
    return VisualSpec(
        source_line=source_line(node, diagnostics.file),
        kind=cast(ShapeKind, kind),
        file=file,
        size=size,
        scale=scale,
        position=position,
        rpy=rpy,
        colour=colour,
    )
