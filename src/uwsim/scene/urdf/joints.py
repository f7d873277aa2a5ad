"""Reader of ``<joint>`` elements in robot files, and of the joints that mimic others."""

from __future__ import annotations

import dataclasses
import math

from lxml import etree

from ...schema import Diagnostics, source_line
from ..angles import MAX_PLAUSIBLE_ANGLE
from .robot import JointKind, JointSpec, LinkSpec, MimicSpec
from .values import name_of, number_of, origin_of, triple_of

MOVABLE_TYPES = ("revolute", "continuous", "prismatic")
FIXED_TYPES = ("floating", "planar")
"""The types of URDF joints that are read as fixed joints."""
NO_STOPS = (-math.inf, math.inf)
"""The limits of a ``continuous`` joint, which turns without end.

If its ``<limit>`` spans less than a turn, it applies, as in the original UWSim, whose robots rely
on that.
"""
MAX_RATIO = 1e6
"""The greatest multiplier and offset of a joint at the end of a chain of mimicking joints."""
FULL_TURN = 0.99 * math.tau
"""The range of limits that excludes no angle, as files write 3.14 for pi [rad]."""


def read_joint(
    node: etree._Element, links: dict[str, LinkSpec], diagnostics: Diagnostics
) -> JointSpec | None:
    """Return a joint; None if it does not connect two links, or has no valid type."""
    name, joint_type = name_of(node), (node.get("type") or "").strip()
    if joint_type not in (*MOVABLE_TYPES, *FIXED_TYPES, "fixed"):
        diagnostics.report_unknown(
            node,
            f"joint {name!r} has the type {joint_type[:60]!r}; expected one of "
            f"{', '.join((*MOVABLE_TYPES, 'fixed', *FIXED_TYPES))}",
            joint_type,
            (*MOVABLE_TYPES, "fixed", *FIXED_TYPES),
        )
        return None
    if joint_type in FIXED_TYPES:
        diagnostics.warning(
            node, f"joint {name!r} is {joint_type}; it is fixed, as in the original"
        )
    parent, child = (_end(node, end, links, diagnostics) for end in ("parent", "child"))
    if parent is None or child is None:
        return None
    position, rpy = origin_of(node, diagnostics)
    kind: JointKind = "fixed"
    axis, lower, upper = (1.0, 0.0, 0.0), 0.0, 0.0
    if joint_type in MOVABLE_TYPES:
        kind = joint_type  # type: ignore[assignment]  # one of MOVABLE_TYPES
        lower, upper = _limits(node, joint_type, diagnostics)
        if (axis_node := node.find("axis")) is not None:
            axis = triple_of(axis_node, "xyz", diagnostics, axis)
        if not any(axis):
            diagnostics.warning(node, f"joint {name!r} has the axis 0 0 0; it is fixed")
            kind = "fixed"
    return JointSpec(
        source_line=source_line(node, diagnostics.file),
        name=name,
        kind=kind,
        parent=parent,
        child=child,
        position=position,
        rpy=rpy,
        axis=axis,
        lower=lower,
        upper=upper,
        effort=_limit_of(node, "effort", diagnostics),
        velocity=_limit_of(node, "velocity", diagnostics),
        damping=_loss(node, "damping", diagnostics),
        friction=_loss(node, "friction", diagnostics),
        mimic=_mimic(node, diagnostics) if joint_type in MOVABLE_TYPES else None,
    )


def _limits(node: etree._Element, kind: str, diagnostics: Diagnostics) -> tuple[float, float]:
    limit = node.find("limit")
    if limit is None:
        if kind != "continuous" and node.find("mimic") is None:
            message = f"joint {name_of(node)!r} is {kind} without <limit>; -pi to pi"
            diagnostics.warning(node, message)
        return NO_STOPS if kind == "continuous" else (-math.pi, math.pi)
    lower, upper = (number_of(limit, end, diagnostics, 0.0) for end in ("lower", "upper"))
    if kind == "revolute" and _are_degrees(lower, upper):
        diagnostics.warning(
            limit,
            f"joint {name_of(node)!r} turns from {lower:g} to {upper:g} rad; if these are degrees "
            f"write {math.radians(lower):.5g} to {math.radians(upper):.5g}",
        )
    if kind == "continuous" and not 0.0 < upper - lower < FULL_TURN:
        return NO_STOPS
    if lower > upper:
        diagnostics.warning(
            limit, f"joint {name_of(node)!r}: lower {lower:g} is above upper {upper:g}"
        )
    elif "lower" not in limit.attrib and "upper" not in limit.attrib:
        diagnostics.warning(
            limit,
            f"joint {name_of(node)!r} has a <limit> without lower and upper: it is fixed at 0",
        )
    return lower, upper


def _are_degrees(lower: float, upper: float) -> bool:
    return MAX_PLAUSIBLE_ANGLE < max(abs(lower), abs(upper)) <= 360.0 and not (
        lower % 1 or upper % 1
    )


def _limit_of(node: etree._Element, attribute: str, diagnostics: Diagnostics) -> float:
    """Return the effort or velocity of a ``<limit>``; infinity if it is absent or 0."""
    limit = node.find("limit")
    value = 0.0 if limit is None else number_of(limit, attribute, diagnostics, 0.0)
    return value if value > 0.0 else math.inf


def _loss(node: etree._Element, attribute: str, diagnostics: Diagnostics) -> float:
    """Return the damping or friction of ``<dynamics>``; 0 if it is absent or negative."""
    dynamics = node.find("dynamics")
    loss = 0.0 if dynamics is None else number_of(dynamics, attribute, diagnostics, 0.0)
    if loss < 0.0:
        diagnostics.warning(
            dynamics, f"joint {name_of(node)!r} has the {attribute} {loss:g}; expected 0 or more: 0"
        )
    return max(loss, 0.0)


def _mimic(node: etree._Element, diagnostics: Diagnostics) -> MimicSpec | None:
    mimic = node.find("mimic")
    if mimic is None:
        return None
    return MimicSpec(
        source_line=source_line(mimic, diagnostics.file),
        joint=(mimic.get("joint") or "").strip(),
        multiplier=number_of(mimic, "multiplier", diagnostics, 1.0),
        offset=number_of(mimic, "offset", diagnostics, 0.0),
    )


def check_leader(
    joint: JointSpec, joints: dict[str, JointSpec], diagnostics: Diagnostics
) -> JointSpec:
    """Return the joint, without its ``<mimic>`` if the mimicked joint does not exist."""
    if joint.mimic is None or joint.mimic.joint in joints:
        return joint
    source = joint.mimic.joint
    diagnostics.warning(
        joint,
        f"joint {joint.name!r} mimics {source[:60]!r}, which is no joint"
        f".{diagnostics.suggest(source, joints, 'warning')} It moves by itself",
    )
    return dataclasses.replace(joint, mimic=None)


def check_mimics(joints: dict[str, JointSpec], diagnostics: Diagnostics) -> None:
    """Report joints that mimic each other in a loop."""
    visited_names: set[str] = set()
    for name in joints:
        path: dict[str, int] = {}  # joint -> its index in the path
        while name in joints and name not in visited_names:
            visited_names.add(name)
            path[name] = len(path)
            mimic = joints[name].mimic
            name = "" if mimic is None else mimic.joint
        loop = list(path)[path[name] :] if name in path else []
        for i, member in enumerate(loop):
            members = (*loop[i:], *loop[:i], member)[:100]
            message = " mimics ".join(repr(joint_name) for joint_name in members)
            diagnostics.error(joints[member], f"joint {message[:200]}: a loop")


def follow_chains(joints: dict[str, JointSpec], diagnostics: Diagnostics) -> dict[str, JointSpec]:
    r"""Replace chains of mimicking joints: each joint then mimics the first joint of its chain.

    If joint 1 mimics joint 0 and joint 2 mimics joint 1, with multipliers m and offsets o, q_1 =
    m_1 q_0 + o_1 and q_2 = m_2 q_1 + o_2. Therefore

    .. math:: q_2 = m_1 m_2\,q_0 + m_2 o_1 + o_2

    A slider-crank moves by another law; a joint that mimics it remains at its offset, which is
    reported. The joints must have no loop (`check_mimics`).
    """
    resolved_joints: dict[str, JointSpec] = {}
    for name in joints:
        path: list[str] = []
        while name in joints and name not in resolved_joints:
            path.append(name)
            mimic = joints[name].mimic
            name = "" if mimic is None else mimic.joint
        for member in reversed(path):
            resolved_joints[member] = _follow_first(joints[member], resolved_joints, diagnostics)
    return {name: resolved_joints[name] for name in joints}


def _follow_first(
    joint: JointSpec, joints: dict[str, JointSpec], diagnostics: Diagnostics
) -> JointSpec:
    """Return the joint, which mimics the first joint of its chain.

    Args:
        joint: a joint.
        joints: the resolved joints, among which is the joint that it mimics.
        diagnostics: receives warnings and errors.
    """
    mimic = joint.mimic
    leader = None if mimic is None else joints[mimic.joint]
    if mimic is None or leader is None or leader.mimic is None:
        return joint
    if leader.is_crank or joint.is_crank:
        diagnostics.warning(
            joint,
            f"joint {joint.name!r} mimics {mimic.joint!r}, which mimics another. A slider-crank "
            "is not supported in such a chain: the joint remains at its offset",
        )
        return joint
    first_mimic = leader.mimic
    multiplier = first_mimic.multiplier * mimic.multiplier
    offset = mimic.multiplier * first_mimic.offset + mimic.offset
    if not max(abs(multiplier), abs(offset)) <= MAX_RATIO:
        diagnostics.error(
            joint,
            f"joint {joint.name!r} mimics {first_mimic.joint!r} with the multiplier "
            f"{multiplier:.3g} and the offset {offset:.3g}; expected at most {MAX_RATIO:g}",
        )
        return joint
    source = first_mimic.joint
    mimic = dataclasses.replace(mimic, joint=source, multiplier=multiplier, offset=offset)
    return dataclasses.replace(joint, mimic=mimic)


def _end(
    node: etree._Element, end: str, links: dict[str, LinkSpec], diagnostics: Diagnostics
) -> str | None:
    child = node.find(end)
    link = "" if child is None else (child.get("link") or "").strip()
    if link in links:
        return link
    if not link:
        diagnostics.error(node, f'joint {name_of(node)!r} lacks <{end} link="...">')
    else:
        diagnostics.error(
            node,
            f"joint {name_of(node)!r}: its {end} {link[:60]!r} is no link."
            f"{diagnostics.suggest(link, links)}",
        )
    return None
