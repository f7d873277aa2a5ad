"""The tree of links and joints that an imported model becomes: the contents of its robot file.

A robot file (URDF) is a tree whose joints are at the origin of their child link. In SDF a joint may
be anywhere, links may be connected in loops, and a link may have no joint at all. So

- a link whose joint is not at its origin gets its frame moved to the joint, without a rotation;
- a joint to a link that already has a parent is left out, as is a link that no joint connects;
- the joint of a propeller is fixed: its thruster has the force, and the blades do not turn.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

import numpy as np

from ..base.geometry import Array, Pose
from .report import ImportReport, Status
from .sdf.flat_model import WORLD, FlatJoint, FlatLink, FlatModel

JOINT_KINDS = ("revolute", "continuous", "prismatic", "fixed")
"""The types of joints that have a counterpart."""
ENDLESS_LIMIT = 1e6
"""The limit from which a joint turns without end [rad]."""
MIN_OFFSET = 1e-9
"""The distance of a joint from its link below which the frame of the link is not moved [m]."""


@dataclass(frozen=True, kw_only=True)
class RobotLink:
    """A link of the robot file."""

    name: str
    """The name in the robot file."""
    link: FlatLink
    """The link in the SDF file."""
    frame_from_link: Pose
    """The frame of the SDF link in that of the robot file: a translation."""

    @property
    def model_from_frame(self) -> Pose:
        """The frame of the robot file in the model."""
        return self.link.model_from_link @ self.frame_from_link.inverse()


@dataclass(frozen=True, kw_only=True)
class RobotJoint:
    """A joint of the robot file."""

    name: str
    """The name in the robot file."""
    kind: str
    """The type, one of `JOINT_KINDS`."""
    parent: str
    """The path of the parent link."""
    child: str
    """The path of the child link."""
    joint: FlatJoint | None
    """The joint in the SDF file; None for a connection without one."""


@dataclass(frozen=True, kw_only=True)
class Robot:
    """A robot: links by their path, the root first, and joints."""

    name: str
    """The name."""
    links: Mapping[str, RobotLink]
    """The links by their path in the SDF model."""
    joints: tuple[RobotJoint, ...]
    """The joints, parents before children."""
    root: str
    """The path of the root."""
    is_fixed: bool
    """True if a joint fixes the root to the world."""

    def frame_from_part(self, path: str, link_from_part: Pose) -> Pose:
        """Return the pose of a part of a link in the link's frame of the robot file."""
        return self.links[path].frame_from_link @ link_from_part


@dataclass(frozen=True, kw_only=True)
class Connections:
    """The joints that plug-ins use or make."""

    propellers: Collection[str] = ()
    """The paths of the joints of propellers."""
    attachments: tuple[tuple[str, str], ...] = ()
    """The parent and child link of connections that a plug-in makes."""


class NameTable:
    """The unique names of a robot file, from paths in SDF.

    ``::`` becomes ``_``; a name that is taken gets a number.
    """

    def __init__(self) -> None:
        self._names: set[str] = set()

    def add(self, path: str) -> str:
        """Return the name for a path, which no later path gets."""
        base = re.sub(r"[^A-Za-z0-9_.-]+", "_", path).strip("_") or "part"
        name, n = base, 1
        while name.lower() in self._names:
            n += 1
            name = f"{base}_{n}"
        self._names.add(name.lower())
        return name


@dataclass(eq=False)
class _Builder:
    """The construction of a robot."""

    model: FlatModel
    report: ImportReport
    connections: Connections
    joints: list[RobotJoint] = field(default_factory=list)
    parents: dict[str, str] = field(default_factory=dict)
    names: NameTable = field(default_factory=NameTable)

    def choose_root(self) -> tuple[str, bool] | None:
        """Return the root of the tree with the canonical link, and whether it is fixed."""
        root = self.model.canonical_link
        if root is None:
            return None
        uppers = {joint.child: joint.parent for joint in reversed(self.model.joints.values())}
        path = {root}
        while uppers.get(root, WORLD) != WORLD and uppers[root] not in path:
            root = uppers[root]
            path.add(root)
        return root, uppers.get(root) == WORLD

    def connect(self, root: str) -> list[str]:
        """Find the joints of the tree, breadth first, and return its links."""
        order, known_links = [root], {root}
        by_parent: dict[str, list[FlatJoint]] = {}
        for joint in self.model.joints.values():
            by_parent.setdefault(joint.parent, []).append(joint)
        children: dict[str, list[str]] = {}
        for parent, child in self.connections.attachments:
            children.setdefault(parent, []).append(child)
        for link in order:
            for joint in by_parent.get(link, ()):
                if joint.child in known_links:
                    self._report_loop(joint)
                    continue
                known_links.add(joint.child)
                order.append(joint.child)
                self._add(joint)
            for child in children.get(link, ()):
                if child not in known_links:
                    known_links.add(child)
                    order.append(child)
                    name = self.names.add(f"{child}_attachment")
                    self.joints.append(
                        RobotJoint(name=name, kind="fixed", parent=link, child=child, joint=None)
                    )
        return order

    def _report_loop(self, joint: FlatJoint) -> None:
        self.report.add(
            "left out", f"joint {joint.path}", joint.joint.place,
            "it closes a loop; a robot is a tree of links",
        )  # fmt: skip

    def _add(self, joint: FlatJoint) -> None:
        kind, place = joint.joint.kind, joint.joint.place
        axis = joint.joint.axis
        name = self.names.add(joint.path)
        label = f"joint {joint.path}"
        if joint.path in self.connections.propellers:
            self.report.add("changed", label, place, "fixed: its thruster has the force, and the "
                            "propeller does not turn")  # fmt: skip
            kind = "fixed"
        elif kind == "revolute" and min(-axis.lower, axis.upper) >= ENDLESS_LIMIT:
            kind = "continuous"
            self.report.add("imported", label, place, "continuous: it has no limits")
        elif kind in JOINT_KINDS:
            note = "" if name == joint.path else f"its name is {name}"
            self.report.add("imported", label, place, note)
        else:
            self.report.add("changed", label, place, f"fixed: joints of type {kind!r} have no "
                            f"counterpart ({', '.join(JOINT_KINDS)})")  # fmt: skip
            kind = "fixed"
        self.joints.append(
            RobotJoint(name=name, kind=kind, parent=joint.parent, child=joint.child, joint=joint)
        )


def make_robot(
    model: FlatModel, name: str, connections: Connections, report: ImportReport
) -> Robot | None:
    """Return the robot of a model; None if the model has no links."""
    builder = _Builder(model, report, connections)
    root = builder.choose_root()
    if root is None:
        return None
    order = builder.connect(root[0])
    offsets = {joint.child: _offset(joint) for joint in builder.joints}
    link_names = NameTable()
    links: dict[str, RobotLink] = {}
    for path in order:
        sdf_link, offset = model.links[path], offsets.get(path, np.zeros(3))
        link_name = link_names.add(path)
        links[path] = RobotLink(
            name=link_name, link=sdf_link, frame_from_link=Pose(-offset, np.eye(3))
        )
        notes = [] if link_name == path else [f"its name is {link_name}"]
        if offset.any():
            notes.append("its frame is moved to its joint")
        status: Status = "changed" if offset.any() else "imported"
        report.add(status, f"link {path}", sdf_link.place, "; ".join(notes))
    for path, sdf_link in model.links.items():
        if path not in links:
            report.add("left out", f"link {path}", sdf_link.place,
                       f"no joint connects it with {root[0]}")  # fmt: skip
    for joint in model.joints.values():
        if joint.parent not in links and joint.parent != WORLD:
            report.add("left out", f"joint {joint.path}", joint.joint.place,
                       "its links are not connected with the robot")  # fmt: skip
    return Robot(
        name=name, links=links, joints=tuple(builder.joints), root=root[0], is_fixed=root[1]
    )


def _offset(joint: RobotJoint) -> Array:
    """Return the position of a moving joint in the frame of its child link, (3,) [m]."""
    if joint.joint is None or joint.kind == "fixed":
        return np.zeros(3)
    offset = joint.joint.child_from_joint.position
    if joint.kind == "prismatic" or not np.abs(offset).max() > MIN_OFFSET:
        return np.zeros(3)
    return offset
