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
"""Greatest angle that a joint without end stops is set to [rad]."""


@dataclass(frozen=True, kw_only=True)
class VisualSpec(Spec):
    """A visual or collision shape on a link."""

    kind: ShapeKind
    """What it is made of."""
    file: str = ""
    """The mesh, as the file names it; empty for the other kinds."""
    size: Triple = (1.0, 1.0, 1.0)
    """Extent along x, y, z of a box, a cylinder (about z) or a sphere [m]."""
    scale: Triple = (1.0, 1.0, 1.0)
    """Scale of a mesh along x, y, z [1]."""
    position: Triple = ZERO
    """Position of the shape in the link's frame [m]."""
    rpy: Triple = ZERO
    """Of the shape in the link's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    colour: Colour | None = None
    """Red, green, blue, opacity of its material [0..1]; None without one."""


@dataclass(frozen=True, kw_only=True)
class LinkSpec(Spec):
    """A rigid piece of a robot."""

    name: str
    """Its name."""
    visuals: tuple[VisualSpec, ...] = ()
    """What is seen of it; the original sees the first only."""
    collisions: tuple[VisualSpec, ...] = ()
    """What is touched of it; the original feels the first only, at the link's origin."""
    mass: float = 0.0
    """Its mass [kg]."""
    centre_of_mass: Triple = ZERO
    """In the link's frame [m]."""
    inertia_rpy: Triple = ZERO
    """Axes of the inertia in the link's frame, roll, pitch, yaw: Rz Ry Rx [rad]."""
    inertia: tuple[float, float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    """About the centre of mass: xx, yy, zz, xy, xz, yz [kg m2]."""

    @property
    def visual(self) -> VisualSpec | None:
        """The first visual, whose origin is the link's visual frame."""
        return self.visuals[0] if self.visuals else None

    @property
    def solids(self) -> tuple[VisualSpec, ...]:
        """Its collision shapes; without any, its visuals."""
        return self.collisions or self.visuals


@dataclass(frozen=True, kw_only=True)
class MimicSpec(Spec):
    """A joint that follows another: ``multiplier * q + offset``."""

    joint: str
    """The joint it follows."""
    multiplier: float = 1.0
    """Factor on the other's value [1]."""
    offset: float = 0.0
    """Added to it [rad or m]."""


@dataclass(frozen=True, kw_only=True)
class JointSpec(Spec):
    """A joint between two links."""

    name: str
    """Its name."""
    kind: JointKind
    """How it moves; what URDF calls floating or planar is fixed, as in the original."""
    parent: str
    """The parent link."""
    child: str
    """The child link."""
    position: Triple = ZERO
    """Position of the joint in the parent's frame [m]."""
    rpy: Triple = ZERO
    """Of the joint in the parent's frame, fixed-axis roll, pitch, yaw: Rz Ry Rx [rad]."""
    axis: Triple = (1.0, 0.0, 0.0)
    """What it turns about or slides along, in its own frame [1]."""
    lower: float = 0.0
    """Least value; -inf of a joint without end stops [rad or m]."""
    upper: float = 0.0
    """Greatest value; inf of a joint without end stops [rad or m]."""
    effort: float = math.inf
    """Greatest effort of what drives it; of a simulated vehicle only [N m or N]."""
    velocity: float = math.inf
    """Greatest speed at which it is driven; of a simulated vehicle only [rad/s or m/s]."""
    damping: float = 0.0
    """Effort against its speed; of a simulated vehicle only [N m s/rad or N s/m]."""
    friction: float = 0.0
    """Effort of its dry friction; of a simulated vehicle only [N m or N]."""
    mimic: MimicSpec | None = None
    """Whom it follows."""

    @property
    def moves(self) -> bool:
        """Whether it is not fixed."""
        return self.kind != "fixed"

    @property
    def has_stops(self) -> bool:
        """Whether it stops at `lower` and `upper`; a ``continuous`` joint may turn without end."""
        return math.isfinite(self.upper - self.lower)

    @property
    def is_crank(self) -> bool:
        """Whether it mimics as a slider-crank does; its name says so, as in the original."""
        return "slidercrank" in self.name

    def clamped(self, value: float) -> float:
        """Return a value within the limits [rad or m].

        A joint without end stops keeps its angle; one of more than `MAX_ANGLE` is reduced by whole
        turns, so that its sine and cosine stay exact.
        """
        if self.has_stops:
            return min(max(value, self.lower), self.upper)
        finite = min(max(value, -sys.float_info.max), sys.float_info.max)
        return math.remainder(finite, math.tau) if abs(finite) > MAX_ANGLE else finite


@dataclass(frozen=True, kw_only=True)
class RobotSpec(Spec):
    """A robot: links and joints in UWSim's order."""

    name: str
    """Its name."""
    root: str
    """The root link, which has no parent."""
    links: tuple[LinkSpec, ...]
    """The root first, then in the order of the joints."""
    joints: tuple[JointSpec, ...]
    """Depth first, children in the alphabetical order of their joints' names."""
    path: str = ""
    """The file it was read from."""
    expansion: Expansion = field(default=Expansion(), compare=False)
    """What is known of its xacro."""

    @cached_property
    def movable(self) -> tuple[JointSpec, ...]:
        """The joint vector: those that move and mimic none."""
        return tuple(joint for joint in self.joints if joint.moves and joint.mimic is None)

    def link(self, name: str) -> LinkSpec | None:
        """Find a link by its name."""
        return next((link for link in self.links if link.name == name), None)
