"""The spec of a robot (URDF): links, joints, visuals and collisions.

.. code-block:: xml

    <robot name="girona500">
      <link name="part1"> <visual> <geometry> <mesh filename="..."/> </geometry> </visual> </link>
      <joint name="Slew" type="continuous">
        <parent link="kinematic_base"/> <child link="part1"/> <axis xyz="0 0 1"/>
        <limit lower="-1.5708" upper="0.5488" effort="1000" velocity="1"/>
      </joint>
    </robot>

`uwsim.scene.urdf.reader` reads the spec from a file.
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
"""The angle above which the position of a joint without end stops is reduced by turns [rad]."""


@dataclass(frozen=True, kw_only=True)
class VisualSpec(Spec):
    """A visual or collision shape on a link."""

    kind: ShapeKind
    """The kind of shape."""
    file: str = ""
    """The name of the mesh file, as in the robot file; empty for other kinds of shape."""
    size: Triple = (1.0, 1.0, 1.0)
    """The extent along x, y, z of a box, a cylinder (about z) or a sphere [m]."""
    scale: Triple = (1.0, 1.0, 1.0)
    """The scale of a mesh along x, y, z [1]."""
    position: Triple = ZERO
    """The position of the shape in the link's frame [m]."""
    rpy: Triple = ZERO
    """The orientation in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    colour: Colour | None = None
    """The red, green, blue and opacity of the material [0..1]; None without a material."""


@dataclass(frozen=True, kw_only=True)
class LinkSpec(Spec):
    """A rigid part of a robot."""

    name: str
    """The name."""
    visuals: tuple[VisualSpec, ...] = ()
    """The visible shapes; the original UWSim uses only the first."""
    collisions: tuple[VisualSpec, ...] = ()
    """The collision shapes; the original UWSim uses only the first, at the link's origin."""
    mass: float = 0.0
    """The mass [kg]."""
    centre_of_mass: Triple = ZERO
    """The centre of mass in the link's frame [m]."""
    inertia_rpy: Triple = ZERO
    """The axes of the inertia in the link's frame: roll, pitch, yaw, Rz Ry Rx [rad]."""
    inertia: tuple[float, float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    """The inertia about the centre of mass: xx, yy, zz, xy, xz, yz [kg m2]."""

    @property
    def visual(self) -> VisualSpec | None:
        """The first visual, whose origin is the link's visual frame."""
        return self.visuals[0] if self.visuals else None

    @property
    def solids(self) -> tuple[VisualSpec, ...]:
        """The shapes for contacts: the collision shapes or, without any, the visible shapes."""
        return self.collisions or self.visuals


@dataclass(frozen=True, kw_only=True)
class MimicSpec(Spec):
    """A ``<mimic>``: the joint's position is ``multiplier * q + offset``."""

    joint: str
    """The joint with the position q."""
    multiplier: float = 1.0
    """The factor on the position of that joint [1]."""
    offset: float = 0.0
    """The offset [rad or m]."""


@dataclass(frozen=True, kw_only=True)
class JointSpec(Spec):
    """A joint between two links."""

    name: str
    """The name."""
    kind: JointKind
    """The type of motion; ``floating`` and ``planar`` of URDF are fixed, as in UWSim."""
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
    """The minimum position; -inf for a joint without end stops [rad or m]."""
    upper: float = 0.0
    """The greatest position; inf for a joint without end stops [rad or m]."""
    effort: float = math.inf
    """The greatest effort of the joint's drive, of a vehicle with dynamics [N m or N]."""
    velocity: float = math.inf
    """The greatest speed of the joint's drive, of a vehicle with dynamics [rad/s or m/s]."""
    damping: float = 0.0
    """The damping effort per speed, of a vehicle with dynamics [N m s/rad or N s/m]."""
    friction: float = 0.0
    """The effort of dry friction, of a vehicle with dynamics [N m or N]."""
    mimic: MimicSpec | None = None
    """The joint that this joint mimics; None: this joint moves by itself."""

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
        """True if the joint mimics as a slider-crank does: its name contains ``slidercrank``."""
        return "slidercrank" in self.name

    def clamp(self, value: float) -> float:
        """Clamp a position to the limits [rad or m].

        The angle of a joint without end stops is not clamped. An angle of more than `MAX_ANGLE` is
        reduced by whole turns, so that its sine and cosine are exact.
        """
        if self.has_stops:
            return min(max(value, self.lower), self.upper)
        angle = min(max(value, -sys.float_info.max), sys.float_info.max)
        return math.remainder(angle, math.tau) if abs(angle) > MAX_ANGLE else angle


@dataclass(frozen=True, kw_only=True)
class RobotSpec(Spec):
    """A robot: its links and joints, in the order of the original UWSim."""

    name: str
    """The name."""
    root: str
    """The root link, which has no parent."""
    links: tuple[LinkSpec, ...]
    """The links: the root first, then in the order of the joints."""
    joints: tuple[JointSpec, ...]
    """The joints, depth first, children in the alphabetical order of their joints' names."""
    path: str = ""
    """The path of the file from which the robot was read."""
    expansion: Expansion = field(default=Expansion(), compare=False)
    """The result of the xacro expansion."""

    @cached_property
    def movable_joints(self) -> tuple[JointSpec, ...]:
        """The joints of the joint vector: those that move and mimic no other joint."""
        return tuple(joint for joint in self.joints if joint.moves and joint.mimic is None)

    def link(self, name: str) -> LinkSpec | None:
        """Return a link by its name; None if there is none."""
        return next((link for link in self.links if link.name == name), None)
