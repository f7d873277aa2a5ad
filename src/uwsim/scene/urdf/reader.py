"""Reader of robot files (URDF): it returns a `RobotSpec`, or raises an error with all mistakes.

The rules of the original UWSim apply. The tree is traversed depth first, children in the
alphabetical order of their joints' names, and the movable joints in that order are the joint
vector. A ``<limit>`` without bounds means 0 to 0; without a ``<limit>`` a joint, also a prismatic
one, moves from -pi to pi. A continuous joint has no end stops, unless its limits span less than a
turn.

Two rules differ. ``effort`` and ``velocity`` of a ``<limit>``, which UWSim ignores, limit the
joints of vehicles with dynamics. All ``<visual>`` and ``<collision>`` elements of a link are used,
where UWSim uses only the first. A material is found by its name wherever it is defined, as in URDF.

Elements of plug-ins or other programs (``<gazebo>``, ``<transmission>``, ...) are ignored. Safety
controllers and textures are not read.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path

from lxml import etree

from ...errors import SceneError
from ...schema import Diagnostics, source_line
from ..xacro import parse_expanded
from .joints import check_leader, check_mimics, follow_chains, read_joint
from .links import read_link, read_materials
from .robot import JointSpec, LinkSpec, RobotSpec
from .values import name_of

MAX_CHAIN = 256
"""The greatest number of joints between the root and a link."""


def read_urdf(
    path: Path | str,
    *,
    data_path: tuple[Path, ...] = (),
    arguments: Mapping[str, str] | None = None,
) -> RobotSpec:
    """Read a robot file.

    Args:
        path: the file.
        data_path: the further folders that are searched for included files.
        arguments: the values of the file's xacro arguments, by name.

    Raises:
        SceneError: the file is invalid; the error has every mistake in it.
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
    """Read a robot file; if it is invalid, add errors to ``diagnostics`` and return None."""
    document = parse_expanded(path, error=SceneError, data_path=data_path, arguments=arguments)
    root = document.root
    if root.tag != "robot":
        diagnostics.error(root, f"the root element is <{str(root.tag)[:60]}>; expected <robot>")
        return None
    materials = read_materials(root, diagnostics)
    links: dict[str, LinkSpec] = {}
    for node in root.findall("link"):
        if _check_unique(node, links, "link", diagnostics):
            links[name_of(node)] = read_link(node, materials, diagnostics)
    joints: dict[str, JointSpec] = {}
    for node in root.findall("joint"):
        if _check_unique(node, joints, "joint", diagnostics):
            joint = read_joint(node, links, diagnostics)
            if joint is not None:
                joints[joint.name] = joint
    joints = {name: check_leader(joint, joints, diagnostics) for name, joint in joints.items()}
    check_mimics(joints, diagnostics)
    if not links:
        diagnostics.error(root, "the robot has no <link>")
    if diagnostics.has_errors:
        return None
    joints = follow_chains(joints, diagnostics)
    if diagnostics.has_errors:
        return None
    robot = _sort_into_tree(root, path, links, joints, diagnostics)
    return None if robot is None else dataclasses.replace(robot, expansion=document.expansion)


def _sort_into_tree(
    root: etree._Element,
    path: Path,
    links: dict[str, LinkSpec],
    joints: dict[str, JointSpec],
    diagnostics: Diagnostics,
) -> RobotSpec | None:
    children: dict[str, list[JointSpec]] = {}
    parent_joints: dict[str, JointSpec] = {}
    for joint in sorted(joints.values(), key=lambda joint: joint.name):
        if joint.child in parent_joints:
            diagnostics.error(
                joint,
                f"link {joint.child!r} has two parent joints, "
                f"{parent_joints[joint.child].name!r} and {joint.name!r}",
            )
        parent_joints[joint.child] = joint
        children.setdefault(joint.parent, []).append(joint)
    roots = [name for name in links if name not in parent_joints]
    if len(roots) != 1:
        fault = f"{len(roots)} links have no parent: {', '.join(roots[:5])}" if roots else "a loop"
        diagnostics.error(root, f"the joints are no tree with one root; found {fault}")
        return None
    sorted_joints: list[JointSpec] = []
    depths = {roots[0]: 0}
    stack = list(reversed(children.get(roots[0], [])))
    while stack:
        joint = stack.pop()
        sorted_joints.append(joint)
        depths[joint.child] = depths[joint.parent] + 1
        if depths[joint.child] > MAX_CHAIN:
            diagnostics.error(
                joint,
                f"joint {joint.name!r} ends a chain of more than {MAX_CHAIN} joints",
            )
            return None
        stack += reversed(children.get(joint.child, []))
    if len(sorted_joints) < len(joints):
        loop_names = sorted(set(joints) - {joint.name for joint in sorted_joints})
        diagnostics.error(joints[loop_names[0]], f"joint {loop_names[0]!r} is part of a loop")
        return None
    return RobotSpec(
        source_line=source_line(root, diagnostics.file),
        name=name_of(root),
        root=roots[0],
        links=(links[roots[0]], *(links[joint.child] for joint in sorted_joints)),
        joints=tuple(sorted_joints),
        path=str(path),
    )


def _check_unique(
    node: etree._Element, specs: dict[str, LinkSpec] | dict[str, JointSpec], kind: str,
    diagnostics: Diagnostics,
) -> bool:  # fmt: skip
    name = name_of(node)
    if not name:
        diagnostics.error(node, f"a <{kind}> lacks the attribute name")
    elif name in specs:
        diagnostics.error(node, f"two {kind}s are called {name!r}")
    return bool(name) and name not in specs
