"""Reads a robot file (URDF) into a `RobotSpec`, or reports every error.

UWSim's rules: the tree is walked depth first, children in the alphabetical order of their joints'
names, and the movable joints in that order are the joint vector. A ``<limit>`` without bounds means
0 to 0; without one a joint goes from -pi to pi, prismatic ones included. A continuous joint has no
end stops; bounds of less than a turn hold for it as in the original. ``effort`` and ``velocity`` of
a ``<limit>``, which UWSim passes over, limit the joints of simulated vehicles. Of a link all
``<visual>`` and ``<collision>`` elements count, where UWSim took the first. A material is meant by
its name wherever it is defined, as in URDF.

What a plug-in or another program wrote into the file (``<gazebo>``, ``<transmission>``, ...) is
passed over, as the original does. Not read: safety controllers, textures.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path

from lxml import etree

from ...errors import SceneError
from ...schema import Diagnostics, source_line
from ..xacro import parse_expanded
from .joints import check_mimics, follow_chains, read_joint, with_leader
from .links import read_link, read_materials
from .robot import JointSpec, LinkSpec, RobotSpec
from .values import name_of

MAX_CHAIN = 256
"""Most joints between the root and a link."""


def read_urdf(
    path: Path | str,
    *,
    data_path: tuple[Path, ...] = (),
    arguments: Mapping[str, str] | None = None,
) -> RobotSpec:
    """Read a robot file.

    Args:
        path: the file.
        data_path: further folders in which included files are looked for.
        arguments: values of its xacro arguments, by name.

    Raises:
        SceneError: with every error of the file.
    """
    path = Path(path)
    diagnostics = Diagnostics(path)
    robot = read_robot(path, diagnostics, data_path, arguments)
    diagnostics.check(SceneError)
    assert robot is not None
    return robot


def read_robot(
    path: Path,
    diagnostics: Diagnostics,
    data_path: tuple[Path, ...] = (),
    arguments: Mapping[str, str] | None = None,
) -> RobotSpec | None:
    """Read a robot file into ``diagnostics``; None when there is no tree to build."""
    document = parse_expanded(path, error=SceneError, data_path=data_path, arguments=arguments)
    root = document.root
    if root.tag != "robot":
        diagnostics.error(root, f"the root element is <{str(root.tag)[:60]}>; expected <robot>")
        return None
    materials = read_materials(root, diagnostics)
    links: dict[str, LinkSpec] = {}
    for node in root.findall("link"):
        if _unique(node, links, "link", diagnostics):
            links[name_of(node)] = read_link(node, materials, diagnostics)
    joints: dict[str, JointSpec] = {}
    for node in root.findall("joint"):
        if _unique(node, joints, "joint", diagnostics):
            joint = read_joint(node, links, diagnostics)
            if joint is not None:
                joints[joint.name] = joint
    joints = {name: with_leader(joint, joints, diagnostics) for name, joint in joints.items()}
    check_mimics(joints, diagnostics)
    if not links:
        diagnostics.error(root, "the robot has no <link>")
    if diagnostics.has_errors:
        return None
    joints = follow_chains(joints, diagnostics)
    if diagnostics.has_errors:
        return None
    robot = _tree(root, path, links, joints, diagnostics)
    return None if robot is None else dataclasses.replace(robot, expansion=document.expansion)


def _tree(
    root: etree._Element,
    path: Path,
    links: dict[str, LinkSpec],
    joints: dict[str, JointSpec],
    diagnostics: Diagnostics,
) -> RobotSpec | None:
    """Sort links and joints into UWSim's order."""
    children: dict[str, list[JointSpec]] = {}
    hung: dict[str, JointSpec] = {}
    for joint in sorted(joints.values(), key=lambda joint: joint.name):
        if joint.child in hung:
            diagnostics.error(
                joint,
                f"link {joint.child!r} has two parent joints, {hung[joint.child].name!r} and "
                f"{joint.name!r}",
            )
        hung[joint.child] = joint
        children.setdefault(joint.parent, []).append(joint)
    roots = [name for name in links if name not in hung]
    if len(roots) != 1:
        what = f"{len(roots)} links have no parent: {', '.join(roots[:5])}" if roots else "a loop"
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
                joint,
                f"joint {joint.name!r} ends a chain of more than {MAX_CHAIN} joints",
            )
            return None
        waiting += reversed(children.get(joint.child, []))
    if len(ordered) < len(joints):
        lost = sorted(set(joints) - {joint.name for joint in ordered})
        diagnostics.error(joints[lost[0]], f"joint {lost[0]!r} is part of a loop")
        return None
    return RobotSpec(
        source_line=source_line(root, diagnostics.file),
        name=name_of(root),
        root=roots[0],
        links=(links[roots[0]], *(links[joint.child] for joint in ordered)),
        joints=tuple(ordered),
        path=str(path),
    )


def _unique(
    node: etree._Element, known: dict[str, LinkSpec] | dict[str, JointSpec], what: str,
    diagnostics: Diagnostics,
) -> bool:  # fmt: skip
    name = name_of(node)
    if not name:
        diagnostics.error(node, f"a <{what}> lacks the attribute name")
    elif name in known:
        diagnostics.error(node, f"two {what}s are called {name!r}")
    return bool(name) and name not in known
