"""A robot file (URDF) becomes a `RobotSpec`, or every error it has.

UWSim's rules: the tree is walked depth first, children in the alphabetical order of their joints'
names, and the movable joints in that order are the joint vector; limits hold for continuous joints
too, and a ``<limit>`` without bounds means 0 to 0; without one a joint goes from -pi to pi,
prismatic ones included. Its ``effort`` and ``velocity``, which UWSim passes over, limit the joints
of simulated vehicles. Of a link all ``<visual>`` and ``<collision>`` elements count, where UWSim
took the first. A material is meant by its name wherever it is defined, as in URDF.

What a plug-in or another program wrote into the file (``<gazebo>``, ``<transmission>``, ...) is
passed over, as the original does. Not read: joint dynamics, safety controllers, textures.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from pathlib import Path
from typing import cast

from lxml import etree

from ..errors import SceneError
from ..schema import MAX_DISTANCE, Diagnostics, number, parse
from .angle_checks import MORE_THAN_A_TURN, degrees_for_radians
from .urdf import (
    ZERO,
    Colour,
    JointKind,
    JointSpec,
    LinkSpec,
    MimicSpec,
    RobotSpec,
    ShapeKind,
    Triple,
    VisualSpec,
)

MAX_CHAIN = 256
"""Most joints between the root and a link."""

MOVABLE = ("revolute", "continuous", "prismatic")
STIFF = ("floating", "planar")


def read_urdf(path: Path | str) -> RobotSpec:
    """Read a robot file.

    Raises:
        SceneError: with every error of the file.
    """
    path = Path(path)
    diagnostics = Diagnostics(path)
    robot = read_robot(path, diagnostics)
    diagnostics.check(SceneError)
    assert robot is not None
    return robot


def read_robot(path: Path, diagnostics: Diagnostics) -> RobotSpec | None:
    """Read a robot file into ``diagnostics``; None when there is no tree to build."""
    root = parse(path, error=SceneError).root
    if root.tag != "robot":
        diagnostics.error(root, f"the root element is <{str(root.tag)[:60]}>; expected <robot>")
        return None
    materials = _materials(root, diagnostics)
    links: dict[str, LinkSpec] = {}
    for node in root.findall("link"):
        if _unique(node, links, "link", diagnostics):
            links[_name(node)] = _link(node, materials, diagnostics)
    joints: dict[str, JointSpec] = {}
    for node in root.findall("joint"):
        if _unique(node, joints, "joint", diagnostics):
            joint = _joint(node, links, diagnostics)
            if joint is not None:
                joints[joint.name] = joint
                diagnostics.remember(joint, node)
    joints = {name: _with_leader(joint, joints, diagnostics) for name, joint in joints.items()}
    _check_mimics(joints, diagnostics)
    if not links:
        diagnostics.error(root, "the robot has no <link>")
    if diagnostics.any:
        return None
    return _tree(root, path, links, joints, diagnostics)


def _tree(
    root: etree._Element,
    path: Path,
    links: dict[str, LinkSpec],
    joints: dict[str, JointSpec],
    diagnostics: Diagnostics,
) -> RobotSpec | None:
    """Put links and joints into UWSim's order."""
    children: dict[str, list[JointSpec]] = {}
    hung: dict[str, JointSpec] = {}
    for joint in sorted(joints.values(), key=lambda joint: joint.name):
        if joint.child in hung:
            diagnostics.error(
                diagnostics.node_of(joint),
                f"link {joint.child!r} hangs on two joints, {hung[joint.child].name!r} and "
                f"{joint.name!r}",
            )
        hung[joint.child] = joint
        children.setdefault(joint.parent, []).append(joint)
    roots = [name for name in links if name not in hung]
    if len(roots) != 1:
        what = f"{len(roots)} links hang on none: {', '.join(roots[:5])}" if roots else "a loop"
        diagnostics.error(root, f"the joints are no tree with one root; found {what}")
        return None
    ordered: list[JointSpec] = []
    depths = {roots[0]: 0}
    waiting = list(reversed(children.get(roots[0], [])))
    while waiting:
        joint = waiting.pop()
        ordered.append(joint)
        depths[joint.child] = depths[joint.parent] + 1
        if depths[joint.child] > MAX_CHAIN:
            diagnostics.error(
                diagnostics.node_of(joint),
                f"joint {joint.name!r} ends a chain of more than {MAX_CHAIN} joints",
            )
            return None
        waiting += reversed(children.get(joint.child, []))
    if len(ordered) < len(joints):
        lost = sorted(set(joints) - {joint.name for joint in ordered})
        diagnostics.error(
            diagnostics.node_of(joints[lost[0]]), f"joint {lost[0]!r} is part of a loop"
        )
        return None
    return RobotSpec(
        name=_name(root),
        root=roots[0],
        links=(links[roots[0]], *(links[joint.child] for joint in ordered)),
        joints=tuple(ordered),
        path=str(path),
    )


def _link(node: etree._Element, materials: dict[str, Colour], diagnostics: Diagnostics) -> LinkSpec:
    inertial = node.find("inertial")
    mass, centre, turn = 0.0, ZERO, ZERO
    inertia = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if inertial is not None:
        centre, turn = _origin(inertial, diagnostics)
        if (weight := inertial.find("mass")) is not None:
            mass = _size(weight, "value", diagnostics, 0.0)
        if (tensor := inertial.find("inertia")) is not None:
            xx, yy, zz, xy, xz, yz = (
                _number(tensor, f"i{axes}", diagnostics, 0.0)
                for axes in ("xx", "yy", "zz", "xy", "xz", "yz")
            )
            inertia = (xx, yy, zz, xy, xz, yz)
    return LinkSpec(
        name=_name(node),
        visuals=_shapes(node.findall("visual"), materials, diagnostics),
        collisions=_shapes(node.findall("collision"), materials, diagnostics),
        mass=mass,
        centre_of_mass=centre,
        inertia_rpy=turn,
        inertia=inertia,
    )


def _materials(root: etree._Element, diagnostics: Diagnostics) -> dict[str, Colour]:
    """The colours that have names: those of the robot, then those that visuals define."""
    found: dict[str, Colour] = {}
    quiet = Diagnostics(diagnostics.file)  # what is wrong with a visual's is said with the visual
    for path, sink in (("material", diagnostics), ("link/visual/material", quiet)):
        for node in root.findall(path):
            colour = _colour(node, sink)
            if colour is not None and _name(node):
                found.setdefault(_name(node), colour)
    return found


def _shapes(
    nodes: list[etree._Element], materials: dict[str, Colour], diagnostics: Diagnostics
) -> tuple[VisualSpec, ...]:
    shapes = (_shape(node, materials, diagnostics) for node in nodes)
    return tuple(shape for shape in shapes if shape is not None)


def _shape(
    node: etree._Element, materials: dict[str, Colour], diagnostics: Diagnostics
) -> VisualSpec | None:
    position, rpy = _origin(node, diagnostics)
    geometry = node.find("geometry")
    shape = None if geometry is None else next(_elements(geometry), None)
    if shape is None:
        diagnostics.error(
            node, f"<{node.tag}> lacks a <geometry> with a mesh, box, cylinder or sphere"
        )
        return None
    colour = None
    if (material := node.find("material")) is not None:
        colour = _colour(material, diagnostics) or materials.get(_name(material))
    kind = shape.tag
    file, size, scale = "", (1.0, 1.0, 1.0), (1.0, 1.0, 1.0)
    if kind == "mesh":
        file = (shape.get("filename") or "").strip()
        if not file:
            diagnostics.error(shape, "<mesh> lacks the attribute filename")
        scale = _triple(shape, "scale", diagnostics, scale)
    elif kind == "box":
        size = _triple(shape, "size", diagnostics, None)
        if min(size) < 0:
            given = shape.get("size", "")
            diagnostics.error(shape, f"size of <box> is {given[:60]!r}; expected numbers >= 0")
    elif kind in ("cylinder", "sphere"):
        wide = 2 * _size(shape, "radius", diagnostics, None)
        tall = _size(shape, "length", diagnostics, None) if kind == "cylinder" else wide
        size = (wide, wide, tall)
    else:
        kinds = ("mesh", "box", "cylinder", "sphere")
        given = str(kind)
        diagnostics.unknown(shape, f"<{given[:60]}> is not a geometry", given, kinds)
        return None
    return VisualSpec(
        kind=cast(ShapeKind, kind),
        file=file,
        size=size,
        scale=scale,
        position=position,
        rpy=rpy,
        colour=colour,
    )


def _joint(
    node: etree._Element, links: dict[str, LinkSpec], diagnostics: Diagnostics
) -> JointSpec | None:
    name, given = _name(node), (node.get("type") or "").strip()
    if given not in (*MOVABLE, *STIFF, "fixed"):
        diagnostics.unknown(
            node,
            f"joint {name!r} has the type {given[:60]!r}; expected one of "
            f"{', '.join((*MOVABLE, 'fixed', *STIFF))}",
            given,
            (*MOVABLE, "fixed", *STIFF),
        )
        return None
    if given in STIFF:
        diagnostics.warning(node, f"joint {name!r} is {given}; held fixed, as in the original")
    parent, child = (_end(node, end, links, diagnostics) for end in ("parent", "child"))
    if parent is None or child is None:
        return None
    position, rpy = _origin(node, diagnostics)
    kind: JointKind = "fixed"
    axis, lower, upper = (1.0, 0.0, 0.0), 0.0, 0.0
    if given in MOVABLE:
        kind = given  # type: ignore[assignment]  # one of MOVABLE
        lower, upper = _limits(node, given, diagnostics)
        if (axis_node := node.find("axis")) is not None:
            axis = _triple(axis_node, "xyz", diagnostics, axis)
        if not any(axis):
            diagnostics.warning(node, f"joint {name!r} has the axis 0 0 0; held fixed")
            kind = "fixed"
    return JointSpec(
        name=name,
        kind=kind,
        parent=parent,
        child=child,
        position=position,
        rpy=rpy,
        axis=axis,
        lower=lower,
        upper=upper,
        effort=_most(node, "effort", diagnostics),
        velocity=_most(node, "velocity", diagnostics),
        mimic=_mimic(node, diagnostics) if given in MOVABLE else None,
    )


def _limits(node: etree._Element, kind: str, diagnostics: Diagnostics) -> tuple[float, float]:
    limit = node.find("limit")
    if limit is None:
        if kind != "continuous" and node.find("mimic") is None:
            diagnostics.warning(node, f"joint {_name(node)!r} is {kind} without <limit>; -pi to pi")
        return -math.pi, math.pi
    lower, upper = (_number(limit, end, diagnostics, 0.0) for end in ("lower", "upper"))
    if kind == "revolute" and _are_degrees(lower, upper):
        diagnostics.warning(
            limit,
            f"joint {_name(node)!r} turns from {lower:g} to {upper:g} rad; as degrees that would "
            f"be {math.radians(lower):.5g} to {math.radians(upper):.5g}",
        )
    if lower > upper:
        diagnostics.warning(
            limit, f"joint {_name(node)!r}: lower {lower:g} is above upper {upper:g}"
        )
    elif "lower" not in limit.attrib and "upper" not in limit.attrib:
        diagnostics.warning(
            limit, f"joint {_name(node)!r} has a <limit> without lower and upper: it is held at 0"
        )
    return lower, upper


def _are_degrees(lower: float, upper: float) -> bool:
    """Whether limits look like degrees: whole numbers beyond a turn, up to 360."""
    return MORE_THAN_A_TURN < max(abs(lower), abs(upper)) <= 360.0 and not (lower % 1 or upper % 1)


def _most(node: etree._Element, what: str, diagnostics: Diagnostics) -> float:
    """An effort or speed of a ``<limit>``; none, or 0 as many files have it, is no limit."""
    limit = node.find("limit")
    most = 0.0 if limit is None else _number(limit, what, diagnostics, 0.0)
    return most if most > 0.0 else math.inf


def _mimic(node: etree._Element, diagnostics: Diagnostics) -> MimicSpec | None:
    mimic = node.find("mimic")
    if mimic is None:
        return None
    return MimicSpec(
        joint=(mimic.get("joint") or "").strip(),
        multiplier=_number(mimic, "multiplier", diagnostics, 1.0),
        offset=_number(mimic, "offset", diagnostics, 0.0),
    )


def _with_leader(
    joint: JointSpec, joints: dict[str, JointSpec], diagnostics: Diagnostics
) -> JointSpec:
    """Return the joint; one that mimics nobody is free."""
    if joint.mimic is None or joint.mimic.joint in joints:
        return joint
    node, source = diagnostics.node_of(joint), joint.mimic.joint
    diagnostics.warning(
        node,
        f"joint {joint.name!r} mimics {source[:60]!r}, which is no joint"
        f".{diagnostics.near(source, joints, 'warning')} It moves by itself",
    )
    free = dataclasses.replace(joint, mimic=None)
    if node is not None:
        diagnostics.remember(free, node)
    return free


def _check_mimics(joints: dict[str, JointSpec], diagnostics: Diagnostics) -> None:
    """Say which joints mimic each other in a loop; every joint is visited once."""
    seen: set[str] = set()
    for name in joints:
        path: dict[str, int] = {}  # joint -> how many before it
        while name in joints and name not in seen:
            seen.add(name)
            path[name] = len(path)
            mimic = joints[name].mimic
            name = "" if mimic is None else mimic.joint
        loop = list(path)[path[name] :] if name in path else []
        for i, member in enumerate(loop):
            turned = (*loop[i:], *loop[:i], member)[:100]
            message = " mimics ".join(repr(each) for each in turned)
            diagnostics.error(diagnostics.node_of(joints[member]), f"joint {message[:200]}: a loop")


def _end(
    node: etree._Element, end: str, links: dict[str, LinkSpec], diagnostics: Diagnostics
) -> str | None:
    child = node.find(end)
    link = "" if child is None else (child.get("link") or "").strip()
    if link in links:
        return link
    if not link:
        diagnostics.error(node, f'joint {_name(node)!r} lacks <{end} link="...">')
    else:
        diagnostics.error(
            node,
            f"joint {_name(node)!r}: its {end} {link[:60]!r} is no link."
            f"{diagnostics.near(link, links)}",
        )
    return None


def _origin(node: etree._Element, diagnostics: Diagnostics) -> tuple[Triple, Triple]:
    origin = node.find("origin")
    if origin is None:
        return ZERO, ZERO
    rpy = _triple(origin, "rpy", diagnostics, ZERO)
    if message := degrees_for_radians(rpy):
        diagnostics.warning(origin, f"rpy of <origin> is {message}")
    return _triple(origin, "xyz", diagnostics, ZERO), rpy


def _colour(node: etree._Element, diagnostics: Diagnostics) -> Colour | None:
    colour = node.find("color")
    if colour is None:
        return None
    values = _numbers(colour, "rgba", 4, diagnostics)
    if values is None:
        return None
    red, green, blue, opacity = (min(max(value, 0.0), 1.0) for value in values)
    if [red, green, blue, opacity] != values:
        given = colour.get("rgba", "")
        diagnostics.warning(colour, f"rgba of <color> is {given[:60]!r}; held within 0 to 1")
    return red, green, blue, opacity


def _triple(
    node: etree._Element, attribute: str, diagnostics: Diagnostics, default: Triple | None
) -> Triple:
    if attribute not in node.attrib and default is not None:
        return default
    values = _numbers(node, attribute, 3, diagnostics)
    if values is not None and not max(map(abs, values)) <= MAX_DISTANCE:
        given = node.get(attribute, "")
        diagnostics.error(
            node,
            f"{attribute} of <{node.tag}> is {given[:60]!r}; "
            f"expected numbers up to {MAX_DISTANCE:g}",
        )
        return ZERO
    return ZERO if values is None else (values[0], values[1], values[2])


def _size(
    node: etree._Element, attribute: str, diagnostics: Diagnostics, default: float | None
) -> float:
    """A length or mass: not below 0."""
    value = _number(node, attribute, diagnostics, default)
    if not 0 <= value <= MAX_DISTANCE:
        given = node.get(attribute, "")
        diagnostics.error(
            node, f"{attribute} of <{node.tag}> is {given[:60]!r}; expected 0 to {MAX_DISTANCE:g}"
        )
        return 0.0
    return value


def _number(
    node: etree._Element, attribute: str, diagnostics: Diagnostics, default: float | None
) -> float:
    if attribute not in node.attrib and default is not None:
        return default
    values = _numbers(node, attribute, 1, diagnostics)
    return 0.0 if values is None else values[0]


def _numbers(
    node: etree._Element, attribute: str, count: int, diagnostics: Diagnostics
) -> list[float] | None:
    text = node.get(attribute)
    if text is None:
        diagnostics.error(node, f"<{node.tag}> lacks the attribute {attribute}")
        return None
    words = text.split() if len(text) < 1000 else [text]
    values = [number(word) for word in words if not word.lstrip("-").startswith("M_")]
    if len(words) == count and len(values) == count and None not in values:
        return [value for value in values if value is not None]
    hint = "; expand the file with xacro first" if "${" in text else ""
    what = "a number" if count == 1 else f"{count} numbers"
    shown = text if len(text) <= 60 else text[:57] + "..."
    diagnostics.error(node, f"{attribute} of <{node.tag}> is {shown!r}; expected {what}{hint}")
    return None


def _unique(
    node: etree._Element, known: dict[str, LinkSpec] | dict[str, JointSpec], what: str,
    diagnostics: Diagnostics,
) -> bool:  # fmt: skip
    name = _name(node)
    if not name:
        diagnostics.error(node, f"a <{what}> lacks the attribute name")
    elif name in known:
        diagnostics.error(node, f"two {what}s are called {name!r}")
    return bool(name) and name not in known


def _name(node: etree._Element) -> str:
    return (node.get("name") or "").strip()


def _elements(node: etree._Element) -> Iterator[etree._Element]:
    return (child for child in node if isinstance(child.tag, str))
