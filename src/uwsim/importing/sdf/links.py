"""Reader of ``<link>`` elements: mass, inertia, shapes and sensors."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from lxml import etree

from ...schema import MAX_NUMBER
from .shapes import read_shapes
from .spec import Inertial, Link, Sensor
from .values import (
    Source,
    attribute_of,
    child_of,
    children_of,
    number_of,
    pose_of,
    tag_of,
    text_of,
)

READ_TAGS = {"pose", "inertial", "visual", "collision", "sensor"}
IGNORED_TAGS = {"gravity", "enable_wind", "kinematic", "must_be_base_link", "self_collide"}
"""The settings of a link that a scene of this simulator does not need."""
ADDED_MASS_AXES = "xyzpqr"
"""The letters of the rows of ``<fluid_added_mass>``: ``<xx>``, ``<xp>``, ``<qr>``."""


def read_link(node: etree._Element, path: Path, source: Source) -> Link:
    """Read a link."""
    name = attribute_of(node, "name")
    for child in node:
        if (tag := tag_of(child)) and tag not in READ_TAGS | IGNORED_TAGS:
            label = f"{tag} {attribute_of(child, 'name')}".strip()
            source.leave_out(child, label, f"<{tag}> of a link has no counterpart")
    return Link(
        name=name,
        pose=pose_of(node, source),
        inertial=_read_inertial(child_of(node, "inertial"), source),
        visuals=read_shapes(node, "visual", path, source),
        collisions=read_shapes(node, "collision", path, source),
        sensors=tuple(read_sensor(child, source) for child in children_of(node, "sensor")),
        place=source.place(node),
    )


def read_sensor(node: etree._Element, source: Source) -> Sensor:
    """Read the name, type and pose of a sensor."""
    kind = attribute_of(node, "type")
    if kind == "custom":
        attributes = (str(key) for key in node.attrib if str(key) not in ("type", "name"))
        keys = [key for key in attributes if key.rpartition("}")[2].rpartition(":")[2] == "type"]
        kind = str(node.get(keys[0])) if keys else kind
    return Sensor(
        name=attribute_of(node, "name"),
        kind=kind.strip().lower(),
        pose=pose_of(node, source),
        node=node,
        place=source.place(node),
    )


def _read_inertial(node: etree._Element | None, source: Source) -> Inertial:
    if node is None:
        return Inertial()
    mass = number_of(node, 1.0, source, "mass")
    if not 0.0 < mass <= MAX_NUMBER:
        source.diagnostics.error(node, f"<mass> is {mass:g}; expected a number above 0")
        mass = 1.0
    inertia = child_of(node, "inertia")
    names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    defaults = (1.0, 1.0, 1.0, 0.0, 0.0, 0.0)
    values = [
        number_of(inertia, default, source, name)
        for name, default in zip(names, defaults, strict=True)
    ]
    if text_of(node, "inertia") and child_of(inertia, "ixx") is None:
        source.report.add(
            "changed", "inertia", source.place(node),
            "it has no <ixx> ... <izz>: SDF's default, 1 1 1 kg m2, as in Gazebo",
        )  # fmt: skip
    return Inertial(
        mass=mass,
        pose=pose_of(node, source),
        inertia=(values[0], values[1], values[2], values[3], values[4], values[5]),
        added_mass=_read_added_mass(child_of(node, "fluid_added_mass"), source),
    )


def _read_added_mass(node: etree._Element | None, source: Source) -> np.ndarray | None:
    if node is None:
        return None
    matrix = np.zeros((6, 6))
    for i, row in enumerate(ADDED_MASS_AXES):
        for j, column in enumerate(ADDED_MASS_AXES[i:], start=i):
            matrix[i, j] = matrix[j, i] = number_of(node, 0.0, source, row + column)
    return matrix
