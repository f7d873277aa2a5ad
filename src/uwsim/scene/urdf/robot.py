"""The spec of a robot (URDF): links, joints, visuals and collisions.

.. code-block:: xml

    <robot name="girona500">
      <link name="part1"> <visual> <geometry> <mesh filename="..."/> </geometry> </visual> </link>
      <joint name="Slew" type="continuous">
        <parent link="kinematic_base"/> <child link="part1"/> <axis xyz="0 0 1"/>
        <limit lower="-1.5708" upper="0.5488" effort="1000" velocity="1"/>
      </joint>
    </robot>

`reader` makes it from a file.
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

from ...base.geometry import ZERO, Triple
from ...schema import Expansion, Spec

Colour = tuple[float, float, float, float]

ShapeKind = Literal["mesh", "box", "cylinder", "sphere"]
JointKind = Literal["revolute", "continuous", "prismatic", "fixed"]

MAX_ANGLE = 1e6
"""The greatest angle to which a joint without end stops is set [rad]."""


@dataclass(frozen=True, kw_only=True)
class VisualSpec(Spec):
    """A visual or collision shape on a link."""

    kind: ShapeKind
    """The kind of shape."""
    file: str = ""
    """The mesh, as the file names it; empty for the other kinds."""
    size: Triple = (1.0, 1.0, 1.0)
    """The extent along x, y, z of a box, a cylinder (about z) or a sphere [m]."""
    scale: Triple = (1.0, 1.0, 1.0)
    """The scale of a mesh along x, y, z [1]."""
    position: Triple = ZERO
    """The position of the shape in the link's frame [m]."""
    rpy: Triple = ZERO
    """The orientation in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    colour: Colour | None = None
    """The red, green, blue, opacity of its material [0..1]; None without one."""


@dataclass(frozen=True, kw_only=True)
class LinkSpec(Spec):
    """A rigid part of a robot."""

    name: str
    """The name."""
    visuals: tuple[VisualSpec, ...] = ()
    """The visible shapes; the original uses the first only."""
    collisions: tuple[VisualSpec, ...] = ()
    """The collision shapes; the original uses the first only, at the link's origin."""
    mass: float = 0.0
    """The mass [kg]."""
    centre_of_mass: Triple = ZERO
    """The centre of mass in the link's frame [m]."""
    inertia_rpy: Triple = ZERO
    """The axes of the inertia in the link's frame, roll, pitch, yaw: Rz Ry Rx [rad]."""
    inertia: tuple[float, float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    """The inertia about the centre of mass: xx, yy, zz, xy, xz, yz [kg m2]."""

    @property
    def visual(self) -> VisualSpec | None:
        """The first visual, whose origin is the link's visual frame."""
        return self.visuals[0] if self.visuals else None

    @property
    def solids(self) -> tuple[VisualSpec, ...]:
        """The collision shapes; without any, the visuals."""
        return self.collisions or self.visuals


@dataclass(frozen=True, kw_only=True)
class MimicSpec(Spec):
    """A joint that follows another: ``multiplier * q + offset``."""

    joint: str
    """The joint that it follows."""
    multiplier: float = 1.0
    """The factor on the other's value [1]."""
    offset: float = 0.0
    """The offset that is added to it [rad or m]."""


@dataclass(frozen=True, kw_only=True)
class JointSpec(Spec):
    """A joint between two links."""

    name: str
    """The name."""
    kind: JointKind
    """The type of motion; URDF's floating and planar are fixed, as in the original."""
    parent: str
    """The parent link."""
    child: str
    """The child link."""
    position: Triple = ZERO
    """The position of the joint in the parent's frame [m]."""
    rpy: Triple = ZERO
    """The orientation in the parent's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    axis: Triple = (1.0, 0.0, 0.0)
    """The axis of rotation or translation, in the joint's frame [1]."""
    lower: float = 0.0
    """The least value; -inf for a joint without end stops [rad or m]."""
    upper: float = 0.0
    """The greatest value; inf for a joint without end stops [rad or m]."""
    effort: float = math.inf
    """The greatest effort of its drive; for a simulated vehicle only [N m or N]."""
    velocity: float = math.inf
    """The greatest speed of its drive; for a simulated vehicle only [rad/s or m/s]."""
    damping: float = 0.0
    """The damping effort per speed; for a simulated vehicle only [N m s/rad or N s/m]."""
    friction: float = 0.0
    """The effort of its dry friction; for a simulated vehicle only [N m or N]."""
    mimic: MimicSpec | None = None
    """The joint that it mimics, with multiplier and offset."""

    @property
    def moves(self) -> bool:
        """True if the joint is not fixed."""
        return self.kind != "fixed"

    @property
    def has_stops(self) -> bool:
        """True if the joint stops at `lower` and `upper`; a ``continuous`` joint may not."""
        return math.isfinite(self.upper - self.lower)

    @property
    def is_crank(self) -> bool:
        """True if it mimics as a slider-crank does; its name states this, as in the original."""
        return "slidercrank" in self.name

    def clamp(self, value: float) -> float:
        """Clamp a value to the limits [rad or m].

        The angle of a joint without end stops does not change; one of more than `MAX_ANGLE` is
        reduced by whole turns, so that its sine and cosine are exact.
        """
        if self.has_stops:
            return min(max(value, self.lower), self.upper)
        angle = min(max(value, -sys.float_info.max), sys.float_info.max)
        return math.remainder(angle, math.tau) if abs(angle) > MAX_ANGLE else angle


@dataclass(frozen=True, kw_only=True)
class RobotSpec(Spec):
    """A robot: links and joints in UWSim's order."""

    name: str
    """The name."""
    root: str
    """The root link, which has no parent."""
    links: tuple[LinkSpec, ...]
    """The links: the root first, then in the order of the joints."""
    joints: tuple[JointSpec, ...]
    """The joints, depth first, children in the alphabetical order of their joints' names."""
    path: str = ""
    """The file from which it was read."""
    expansion: Expansion = field(default=Expansion(), compare=False)
    """The xacro expansion."""

    @cached_property
    def movable_joints(self) -> tuple[JointSpec, ...]:
        """The joint vector: the joints that move and mimic no other."""
        return tuple(joint for joint in self.joints if joint.moves and joint.mimic is None)

    def link(self, name: str) -> LinkSpec | None:
        """Return a link by its name; None if there is none."""
        return next((link for link in self.links if link.name == name), None)
