"""Reader of ``<joint>`` and ``<frame>`` elements."""

from __future__ import annotations

from lxml import etree

from .spec import MODEL_FRAME, Axis, Frame, Joint
from .values import (
    Source,
    attribute_of,
    child_of,
    flag_of,
    number_of,
    pose_of,
    text_of,
    triple_of,
)

LAST_MODEL_AXES = (1, 4)
"""The last version of SDF in which axes were in the frame of the model."""


def read_joint(node: etree._Element, source: Source) -> Joint | None:
    """Read a joint; report an error and return None if it lacks a link."""
    name = attribute_of(node, "name")
    ends = [text_of(node, end) for end in ("parent", "child")]
    if not all(ends):
        missing_end = "parent" if not ends[0] else "child"
        source.diagnostics.error(node, f"joint {name!r} lacks its <{missing_end}>")
        return None
    return Joint(
        name=name,
        kind=attribute_of(node, "type"),
        parent=ends[0],
        child=ends[1],
        pose=pose_of(node, source),
        axis=_read_axis(child_of(node, "axis"), source),
        place=source.place(node),
    )


def _read_axis(node: etree._Element | None, source: Source) -> Axis:
    if node is None:
        return Axis()
    xyz = triple_of(node, (0.0, 0.0, 1.0), source, "xyz")
    direction = child_of(node, "xyz")
    if not any(xyz):
        source.diagnostics.error(direction, "the <xyz> of an axis is 0 0 0; expected a direction")
        xyz = (0.0, 0.0, 1.0)
    frame = "" if direction is None else attribute_of(direction, "expressed_in")
    is_model_axis = source.version <= LAST_MODEL_AXES
    if not frame and flag_of(node, is_model_axis, "use_parent_model_frame"):
        frame = MODEL_FRAME
    limit, dynamics = child_of(node, "limit"), child_of(node, "dynamics")
    return Axis(
        xyz=xyz,
        expressed_in=frame,
        lower=number_of(limit, -1e16, source, "lower"),
        upper=number_of(limit, 1e16, source, "upper"),
        effort=number_of(limit, -1.0, source, "effort"),
        velocity=number_of(limit, -1.0, source, "velocity"),
        damping=max(number_of(dynamics, 0.0, source, "damping"), 0.0),
        friction=max(number_of(dynamics, 0.0, source, "friction"), 0.0),
    )


def read_frame(node: etree._Element, source: Source) -> Frame:
    """Read a frame."""
    return Frame(
        name=attribute_of(node, "name"),
        attached_to=attribute_of(node, "attached_to"),
        pose=pose_of(node, source),
    )
