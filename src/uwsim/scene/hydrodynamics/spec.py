"""The hydrodynamic parameters of a vehicle, as its hydrodynamics file contains them.

The rows and columns of 6x6 matrices are surge, sway, heave, roll, pitch, yaw (SNAME 1950), in the
axes of the body (a link), about the reference point. Positive damping coefficients oppose motion;
published derivatives (``X_udot``, ``X_u``) mostly have the opposite sign.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Literal

import numpy as np
import numpy.typing as npt

from ...base.geometry import ZERO, Triple
from ...errors import UwsimError
from ...schema import Numbers, Spec, TwoNumbers, element

MAX_POINTS = 12
"""The greatest number of rows of a table over the advance ratio or the angle of attack."""

DragLaw = Literal["axes", "speed", "x", "y", "z"]
Shape = Literal["sphere", "ellipsoid", "box", "cylinder", "shrinking-sphere"]

N_LENGTHS: dict[str, int] = {
    "sphere": 1, "ellipsoid": 3, "box": 3, "cylinder": 2, "shrinking-sphere": 1
}  # fmt: skip
"""The number of lengths that describe each shape."""
MAX_COEFFICIENTS = 9
"""The greatest number of coefficients of a polynomial."""
MIN_RADIUS = 0.001
"""The minimum radius of a propeller [m]."""
MAX_TIME_CONSTANT = 60.0
"""The greatest time constant of a thruster or a fin [s]."""
MAX_FIN_AREA = 1000.0
"""The greatest planform area of a fin [m2]."""
MAX_LIFT_SLOPE = 6.29
"""The lift slope of a thin foil of infinite span, 2 pi [1/rad]."""
DENSITY_LIMITS = (100.0, 20000.0)
"""The limits of a liquid's density: liquid hydrogen has 71, mercury 13 534 [kg/m3]."""
MAX_EFFICIENCY = 1.41
"""The greatest efficiency of a thruster, sqrt(2): an ideal propeller in an ideal duct [1]."""


class BadHydrodynamics(UwsimError):
    """An error for coefficients that are impossible for a body in water; lists all of them."""

    def __init__(self, errors: Sequence[str]) -> None:
        self.errors = tuple(errors)
        super().__init__("\n".join(errors))


@dataclass(frozen=True, kw_only=True)
class BodyHydrodynamics(Spec):
    """The hydrodynamic parameters of one link or object."""

    link: str = element(attribute=True)
    """The link of the URDF to which the parameters belong."""
    reference: Triple = ZERO
    """The reference point of added mass and damping, in the link's frame [m]."""
    added_mass: Numbers = (0.0,) * 6
    """The added mass: 6 numbers (the diagonal) or 36, row by row: surge, sway, heave, roll, pitch,
    yaw; symmetric, positive semi-definite [kg, kg m, kg m2]."""
    linear_damping: Numbers = (0.0,) * 6
    """The linear damping, 6 or 36 numbers: force per velocity relative to the water
    [N s/m, N s, N m s]."""
    quadratic_damping: Numbers = (0.0,) * 6
    """The quadratic damping, 6 or 36 numbers: force = coefficient |v_j| v_j, with the velocity v_j
    of the column j relative to the water [N s2/m2, ...]."""
    body_lift: Numbers = (0.0,) * 6
    """The lift of a slender hull, 6 or 36 numbers: force = coefficient |u| v_j, with the surge
    velocity u and the velocity v_j of the column j; -Y_uv, -N_uv, ... without the contribution of
    the added mass [kg/m, kg, kg m]."""
    volume: float = element(default=0.0, minimum=0.0)
    """The volume of displaced water when fully submerged [m3]."""
    centre_of_buoyancy: Triple = ZERO
    """The centre of buoyancy in the link's frame [m]."""
    shape: Shape = "sphere"
    """The shape for partial submersion: submerged volume as a function of depth and attitude. The
    shape is at the centre of buoyancy, with the axes of the link; the axis of a cylinder is z."""
    size: Numbers = element(default=(), exclusive_minimum=0.0)
    """The size of the shape [m]: radius of a sphere; half-axes of an ellipsoid; edges of a box;
    radius and length of a cylinder. Without it the sphere of that volume. Only the submerged
    *fraction* is computed from the shape."""
    mass: float | None = element(default=None, exclusive_minimum=0.0)
    """A mass that replaces the URDF's [kg]."""
    centre_of_mass: Triple | None = None
    """A centre of mass that replaces the URDF's, in the link's frame [m]."""
    inertia: Numbers | None = None
    """An inertia that replaces the URDF's, about the centre of mass in the axes of the link: xx,
    yy, zz, xy, xz, yz [kg m2]."""
    drag_law: DragLaw = "axes"
    """The speed in a quadratic damping of 6 numbers. ``axes``: each component's own speed, |v_j|
    v_j; for a ball, this drag would depend on its orientation. ``speed``: the speed of all three
    components, |v| v_j, for isotropic bodies. ``x``, ``y`` or ``z``: for the two components across
    that axis, their common speed, for a body of revolution. 36 numbers always use ``axes``.
    Without this element: ``speed`` if the first three numbers are equal, else ``axes``."""
    implicitness: float = element(default=0.5, minimum=0.0, maximum=1.0)
    """The weight of the drag at the end of a step in the time integration: 0 explicit, 0.5 the
    trapezoidal rule, 1 implicit (for light bodies with much drag). RK4 does not use it."""


@dataclass(frozen=True, kw_only=True)
class ThrusterSpec(Spec):
    """A thruster: a propeller that converts a command to thrust."""

    name: str = element(attribute=True)
    """The name, also of the actuator."""
    link: str = element(attribute=True)
    """The link to which the thruster is fixed."""
    position: Triple = ZERO
    """The position in the link's frame [m]."""
    direction: Triple = (1.0, 0.0, 0.0)
    """The direction of the force on the vehicle at a positive command, in the link's frame [1]."""
    forward: Numbers
    """The coefficients of the thrust c1 x + c2 x^2 + ... at a command x > 0, up to nine [N]."""
    backward: Numbers | None = None
    """The coefficients of the thrust -(c1 |x| + c2 x^2 + ...) at a command x < 0; without them as
    forward [N]."""
    dead_zone: float = element(default=0.0, minimum=0.0)
    """The size of the command up to which there is no thrust; the curve starts there [1]."""
    limits: TwoNumbers = (-1.0, 1.0)
    """The minimum and maximum command [1]."""
    saturation: TwoNumbers | None = None
    """The minimum and maximum thrust [N]."""
    time_constant: float = element(default=0.0, minimum=0.0, maximum=MAX_TIME_CONSTANT)
    """The time constant of the first-order lag between command and rotor [s]; 0: no lag."""
    torque: float = 0.0
    """The torque about the direction of thrust, per thrust; positive right-handed [m]."""
    radius: float = element(default=0.05, minimum=MIN_RADIUS)
    """The radius of the propeller, for the loss of thrust at the surface and for its power [m]."""
    efficiency: float | None = element(default=None, exclusive_minimum=0.0, maximum=MAX_EFFICIENCY)
    """The efficiency from the battery to the ideal propeller of that radius
    (`uwsim.physics.actuation.power`); without it and without ``power``: 0.4 [1]."""
    advance: Numbers = ()
    """The pairs, up to 12, of advance ratio J = V / (n D) and thrust coefficient KT, from J = 0 on:
    the thrust is multiplied by KT(J) / KT(0), linear between the pairs and beyond them. Without
    this element the thrust does not depend on the inflow velocity [1, 1]."""
    wake: float = element(default=0.0, minimum=0.0, maximum=0.99)
    """The wake fraction: the relative reduction of the inflow velocity at the propeller [1]."""
    power: Numbers | None = None
    """The coefficients of the electric power c1 |T| + c2 |T|^2 + ... at the thrust T, up to nine,
    instead of an efficiency [W]."""
    power_backward: Numbers | None = None
    """The coefficients of the electric power for T < 0; without them as for T > 0 [W]."""


@dataclass(frozen=True, kw_only=True)
class FinSpec(Spec):
    """A fin: a control surface that turns about its span, as `kernel.fins` computes it."""

    name: str = element(attribute=True)
    """The name, also of the actuator."""
    link: str = element(attribute=True)
    """The link to which it is fixed."""
    position: Triple = ZERO
    """The position of the centre of pressure, in the link's frame [m]."""
    axis: Triple = (0.0, 0.0, 1.0)
    """The axis of rotation along the span, right-handed, in the link's frame [1]."""
    chord: Triple = (1.0, 0.0, 0.0)
    """The direction to the leading edge at the fin angle 0, in the link's frame [1]."""
    area: float = element(exclusive_minimum=0.0, maximum=MAX_FIN_AREA)
    """The area of the planform [m2]."""
    aspect_ratio: float | None = element(default=None, exclusive_minimum=0.0)
    """The effective aspect ratio, span squared / area, for a missing slope or induced drag [1]."""
    lift_slope: float | None = element(default=None, exclusive_minimum=0.0, maximum=MAX_LIFT_SLOPE)
    """The slope of the lift coefficient over the angle of attack, below the stall; without it
    1 / (1 / (1.8 pi) + 1 / (pi AR)) with the aspect ratio AR [1/rad]."""
    stall: float = element(default=0.3, exclusive_minimum=0.0, maximum=1.57)
    """The angle of attack from which the flow separates [rad]."""
    drag: float = element(default=0.01, minimum=0.0)
    """The drag coefficient at zero lift [1]."""
    induced_drag: float | None = element(default=None, minimum=0.0)
    """The drag coefficient per lift coefficient squared, below the stall; without it
    1 / (0.9 pi AR) with the aspect ratio AR, or 0 without an aspect ratio [1]."""
    plate_drag: float = element(default=1.2, minimum=0.0)
    """The coefficient of the force normal to the foil in separated flow [1]."""
    coefficients: Numbers = ()
    """A table instead of the formulas: rows of angle of attack [rad], lift and drag coefficient, up
    to 12, with rising angles. If all angles are 0 or more, the foil is symmetric [rad, 1, 1]."""
    limits: TwoNumbers = (-0.35, 0.35)
    """The minimum and maximum fin angle; 0 0 for a fixed fin [rad]."""
    rate: float | None = element(default=None, exclusive_minimum=0.0)
    """The greatest speed of the servo; without it unlimited [rad/s]."""
    time_constant: float = element(default=0.0, minimum=0.0, maximum=MAX_TIME_CONSTANT)
    """The time constant of the first-order lag of the servo [s]; 0: no lag."""

    @property
    def slope(self) -> float:
        """The lift slope, from the file or from the aspect ratio [1/rad]; 0 without either."""
        if self.lift_slope is not None:
            return self.lift_slope
        ratio = self.aspect_ratio
        return 0.0 if ratio is None else 1.0 / (1.0 / (1.8 * math.pi) + 1.0 / (math.pi * ratio))

    @property
    def induced_drag_slope(self) -> float:
        """The induced drag per lift coefficient squared, from the file or the aspect ratio [1]."""
        if self.induced_drag is not None:
            return self.induced_drag
        return 0.0 if self.aspect_ratio is None else 1.0 / (0.9 * math.pi * self.aspect_ratio)


@dataclass(frozen=True, kw_only=True)
class JointDrive(Spec):
    """The electric power of a joint's motor (`uwsim.physics.actuation.power`)."""

    name: str = element(attribute=True)
    """The joint of the URDF."""
    efficiency: float = element(default=0.6, exclusive_minimum=0.0, maximum=1.0)
    """The mechanical power divided by the electric power without copper loss [1]."""
    copper_loss: float = element(default=0.0, minimum=0.0)
    """The copper loss divided by the effort squared; it also occurs at rest [W/(N m)2, W/N2]."""


@dataclass(frozen=True, kw_only=True)
class VehicleHydrodynamics(Spec):
    """A hydrodynamics set: the named parameters of all links, thrusters and fins of a vehicle."""

    name: str = element(attribute=True)
    """The name of the set, to which ``<u:dynamics>`` of scenes refers."""
    source: str = ""
    """The source of the numbers, and a note which numbers are estimates."""
    density: float = element(default=1000.0, minimum=DENSITY_LIMITS[0], maximum=DENSITY_LIMITS[1])
    """The density of the water for which the numbers are valid and the volumes trimmed [kg/m3]."""
    include: tuple[str, ...] = ()
    """The other hydrodynamics files in its folder whose contents are added when it is read."""
    bodies: tuple[BodyHydrodynamics, ...] = element("body", default=())
    """The bodies; at most one for each link."""
    thrusters: tuple[ThrusterSpec, ...] = element("thruster", default=())
    """The thrusters, in the order of the command vector."""
    fins: tuple[FinSpec, ...] = element("fin", default=())
    """The control surfaces, in the order of the vector of their angles."""
    joints: tuple[JointDrive, ...] = element("joint", default=())
    """The drives of joints, at most one each; other joints have the defaults of `JointDrive`."""
    files: tuple[Path, ...] = field(default=(), compare=False, metadata={"path": True})
    """The paths of the files from which the set was read, its own file first."""

    def body(self, link: str) -> BodyHydrodynamics | None:
        """Return the parameters of a link; None if the set has none."""
        return next((body for body in self.bodies if body.link == link), None)

    def scale_to_density(self, density: float) -> VehicleHydrodynamics:
        """Return the same vehicle in water of another density [kg/m3].

        Masses, volumes and thrusts do not change. Added mass and drag are proportional to the
        density of the water.
        """
        share = density / self.density
        if share == 1.0:
            return self
        bodies = tuple(
            replace(
                body,
                added_mass=_scale(share, body.added_mass),
                linear_damping=_scale(share, body.linear_damping),
                quadratic_damping=_scale(share, body.quadratic_damping),
                body_lift=_scale(share, body.body_lift),
            )
            for body in self.bodies
        )
        return replace(self, bodies=bodies, density=density)

    def drive(self, joint: str) -> JointDrive:
        """Return the drive of a joint, the default drive if the set has none for it."""
        drives = (drive for drive in self.joints if drive.name == joint)
        return next(drives, JointDrive(name=joint))


def _scale(factor: float, numbers: Numbers) -> Numbers:
    return tuple(factor * number for number in numbers)


def matrix(numbers: Numbers) -> npt.NDArray[np.float64]:
    """Return a (6, 6) matrix from its diagonal or its rows."""
    values = np.array(numbers, dtype=np.float64)
    return np.diag(values) if len(values) == 6 else values.reshape(6, 6)
