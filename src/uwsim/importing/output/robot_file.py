"""Writing of a robot file (URDF)."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from lxml import etree

from ...base.geometry import Array, Pose, rpy_from_rotation
from ...schema.writing import number_text
from ..mesh_files import MeshFiles
from ..plugins.thrusters import triple
from ..robot import Robot, RobotJoint
from ..sdf.spec import Visual
from .primitives import write_shape

URDF_SHAPES = ("box", "cylinder", "sphere")
"""The shapes that a robot file has; the others are written as meshes."""


def write_robot(robot: Robot, path: Path, meshes: MeshFiles) -> None:
    """Write the robot file, and copy its meshes."""
    root = etree.Element("robot", name=robot.name)
    for link in robot.links.values():
        node = etree.SubElement(root, "link", name=link.name)
        _write_inertial(node, robot, link.link.path)
        for tag, shapes in (("visual", link.link.visuals), ("collision", link.link.collisions)):
            for visual, link_from_visual in shapes:
                pose = robot.frame_from_part(link.link.path, link_from_visual)
                _write_shape(node, tag, visual, pose, meshes)
    for joint in robot.joints:
        _write_joint(root, joint, robot)
    etree.indent(root)
    text = etree.tostring(root, encoding="unicode")
    path.write_text(f'<?xml version="1.0"?>\n{text}\n', encoding="utf-8")


def _write_inertial(node: etree._Element, robot: Robot, path: str) -> None:
    link = robot.links[path].link
    inertial = etree.SubElement(node, "inertial")
    _write_origin(inertial, robot.frame_from_part(path, link.link_from_inertial))
    etree.SubElement(inertial, "mass", value=number_text(link.inertial.mass))
    names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    values = dict(zip(names, map(number_text, link.inertial.inertia), strict=True))
    etree.SubElement(inertial, "inertia", values)


def _write_shape(
    node: etree._Element, tag: str, visual: Visual, pose: Pose, meshes: MeshFiles
) -> None:
    shape, label = visual.shape, f"{tag} {visual.name}"
    child = etree.Element(tag, name=visual.name or tag)
    _write_origin(child, pose)
    geometry = etree.SubElement(child, "geometry")
    width, _, height = shape.size
    if shape.kind == "mesh":
        mesh = meshes.copy(shape, label, visual.place)
        if mesh is None:
            return
        etree.SubElement(geometry, "mesh", filename=mesh.file, scale=numbers(shape.scale))
    elif shape.kind == "box":
        etree.SubElement(geometry, "box", size=numbers(shape.size))
    elif shape.kind == "cylinder":
        etree.SubElement(
            geometry, "cylinder", radius=number_text(0.5 * width), length=number_text(height)
        )
    elif shape.kind == "sphere":
        etree.SubElement(geometry, "sphere", radius=number_text(0.5 * width))
    elif shape.kind == "plane" and tag == "collision":
        meshes.report.add("left out", label, visual.place, "a robot has no endless plane")
        return
    else:
        name = write_shape(visual, meshes, f"{shape.kind}")
        etree.SubElement(geometry, "mesh", filename=name)
    if tag == "visual" and visual.colour is not None:
        material = etree.SubElement(child, "material", name=f"material_{len(node)}")
        etree.SubElement(material, "color", rgba=numbers(visual.colour))
    node.append(child)


def _write_joint(root: etree._Element, joint: RobotJoint, robot: Robot) -> None:
    parent, child = robot.links[joint.parent], robot.links[joint.child]
    node = etree.SubElement(root, "joint", name=joint.name, type=joint.kind)
    _write_origin(node, parent.model_from_frame.inverse() @ child.model_from_frame)
    etree.SubElement(node, "parent", link=parent.name)
    etree.SubElement(node, "child", link=child.name)
    if joint.joint is None or joint.kind == "fixed":
        return
    axis = joint.joint.joint.axis
    etree.SubElement(node, "axis", xyz=numbers(triple(joint.joint.axis)))
    limits: dict[str, str] = {}
    if joint.kind != "continuous":
        bound = math.pi if joint.kind == "revolute" else 1e3
        limits["lower"] = number_text(max(axis.lower, -bound * 2.0))
        limits["upper"] = number_text(min(axis.upper, bound * 2.0))
    for name, value in (("effort", axis.effort), ("velocity", axis.velocity)):
        if 0.0 < value < 1e9:
            limits[name] = number_text(value)
    if limits:
        etree.SubElement(node, "limit", limits)
    if axis.damping or axis.friction:
        values = {"damping": number_text(axis.damping), "friction": number_text(axis.friction)}
        etree.SubElement(node, "dynamics", values)


def _write_origin(node: etree._Element, pose: Pose) -> None:
    rpy = triple(np.array(rpy_from_rotation(pose.rotation)))
    position = triple(pose.position)
    if any(position) or any(rpy):
        etree.SubElement(node, "origin", xyz=numbers(position), rpy=numbers(rpy))


def numbers(values: tuple[float, ...] | Array) -> str:
    """Return numbers, separated by blanks."""
    return " ".join(number_text(value) for value in values)
