"""The parameters of a vehicle in water, as in its hydrodynamics file; `checks` checks them.

Every 6x6 matrix is in the literature's order (surge, sway, heave, roll, pitch, yaw) in the axes of
its body (link), about its reference point. Forces oppose motion with positive coefficients;
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
"""The number of lengths of each shape."""
MAX_COEFFICIENTS = 9
"""The greatest number of coefficients of a curve."""
MIN_RADIUS = 0.001
"""The least radius of a propeller [m]."""
MAX_TIME_CONSTANT = 60.0
"""The longest lag of a thruster or a fin [s]."""
MAX_FIN_AREA = 1000.0
"""The largest planform of a fin [m2]."""
MAX_LIFT_SLOPE = 6.29
"""The lift slope of a thin foil of infinite span, 2 pi [1/rad]."""
DENSITY_LIMITS = (100.0, 20000.0)
"""The limits of a liquid's density: liquid hydrogen has 71, mercury 13 534 [kg/m3]."""
MAX_EFFICIENCY = 1.41
"""The greatest efficiency of a thruster, sqrt(2): an ideal propeller in an ideal duct [1]."""


class BadHydrodynamics(UwsimError):
    """Coefficients that are impossible for a body in water; has every error."""

    def __init__(self, errors: Sequence[str]) -> None:
        self.errors = tuple(errors)
        super().__init__("\n".join(errors))


@dataclass(frozen=True, kw_only=True)
class BodyHydrodynamics(Spec):
    """The hydrodynamic parameters of one link or object."""

    link: str = element(attribute=True)
    """The link of the URDF that it belongs to."""
    reference: Triple = ZERO
    """The reference point of added mass and damping, in the link's frame [m]."""
    added_mass: Numbers = (0.0,) * 6
    """6 numbers (the diagonal) or 36, row by row: surge, sway, heave, roll, pitch, yaw; symmetric,
    positive semi-definite [kg, kg m, kg m2]."""
    linear_damping: Numbers = (0.0,) * 6
    """6 or 36: force per relative velocity [N s/m, N s, N m s]."""
    quadratic_damping: Numbers = (0.0,) * 6
    """6 or 36: force = coefficient |v_j| v_j of the column's velocity [N s2/m2, ...]."""
    body_lift: Numbers = (0.0,) * 6
    """6 or 36: force = coefficient |u| v_j with the surge u and the column's velocity; the lift of
    a slender hull (-Y_uv, -N_uv, ...) without the part of the added mass [kg/m, kg, kg m]."""
    volume: float = element(default=0.0, minimum=0.0)
    """The volume of displaced water when fully submerged [m3]."""
    centre_of_buoyancy: Triple = ZERO
    """The centre of buoyancy in the link's frame [m]."""
    shape: Shape = "sphere"
    """The shape at the surface: volume as a function of depth and attitude. Its centre is the
    centre of buoyancy, with the link's axes; a cylinder's axis is z."""
    size: Numbers = element(default=(), exclusive_minimum=0.0)
    """The size of the shape [m]: radius; half-axes; edges; radius and length. Without: the sphere
    of that volume. Only the submerged *fraction* is computed from the shape."""
    mass: float | None = element(default=None, exclusive_minimum=0.0)
    """A mass that replaces the URDF's [kg]."""
    centre_of_mass: Triple | None = None
    """A centre of mass that replaces the URDF's, in the link's frame [m]."""
    inertia: Numbers | None = None
    """An inertia that replaces the URDF's, about the centre of mass, link's axes: xx, yy, zz, xy,
    xz, yz [kg m2]."""
    drag_law: DragLaw = "axes"
    """The speed in the quadratic drag of 6 numbers. ``axes``: each component's own speed, |v_j|
    v_j, which for a ball would depend on its orientation. ``speed``: that of all three, |v| v, for
    isotropic bodies. ``x``, ``y`` or ``z``: that of both components across the axis, for a body of
    revolution. 36 numbers use ``axes``. A file without it: ``speed`` if the first three numbers are
    equal."""
    implicitness: float = element(default=0.5, minimum=0.0, maximum=1.0)
    """The share of the drag at the end of a step: 0 explicit, 0.5 the trapezoidal rule, 1 implicit
    (for light bodies with much drag). Not used by RK4."""


@dataclass(frozen=True, kw_only=True)
class ThrusterSpec(Spec):
    """A propeller: it converts a command to thrust along its direction at its position."""

    name: str = element(attribute=True)
    """The name, also of the actuator."""
    link: str = element(attribute=True)
    """The link to which it is fixed."""
    position: Triple = ZERO
    """The position in the link's frame [m]."""
    direction: Triple = (1.0, 0.0, 0.0)
    """The direction of the force on the vehicle at a positive command, in the link's frame [1]."""
    forward: Numbers
    """The thrust = c1 x + c2 x^2 + ... at a command x > 0, up to nine coefficients [N]."""
    backward: Numbers | None = None
    """The same for x < 0 (thrust = -(c1 |x| + c2 x^2 + ...)); without: as forward [N]."""
    dead_zone: float = element(default=0.0, minimum=0.0)
    """The command up to which there is no thrust; the curve starts there [1]."""
    limits: TwoNumbers = (-1.0, 1.0)
    """The least and greatest command [1]."""
    saturation: TwoNumbers | None = None
    """The least and greatest thrust [N]."""
    time_constant: float = element(default=0.0, minimum=0.0, maximum=MAX_TIME_CONSTANT)
    """The first-order lag between command and rotor [s]; 0 for none."""
    torque: float = 0.0
    """The torque about the direction per thrust, positive right-handed [m]."""
    radius: float = element(default=0.05, minimum=MIN_RADIUS)
    """The radius of the propeller, for the loss of thrust at the surface and for its power [m]."""
    efficiency: float | None = element(default=None, exclusive_minimum=0.0, maximum=MAX_EFFICIENCY)
    """The efficiency from the battery to the ideal propeller of that radius
    (`uwsim.physics.actuation.power`); without it and without ``power``: 0.4 [1]."""
    advance: Numbers = ()
    """Pairs of the advance ratio J = V / (n D) and the thrust coefficient KT, from J = 0 on, up to
    12: thrust falls by KT(J) / KT(0), linear between the pairs and beyond, so that two are a line.
    Without: thrust is that at rest [1, 1]."""
    wake: float = element(default=0.0, minimum=0.0, maximum=0.99)
    """The wake fraction: relative reduction of the water speed at the propeller [1]."""
    power: Numbers | None = None
    """The power instead: c1 |T| + c2 |T|^2 + ... of its thrust T, up to nine [W]."""
    power_backward: Numbers | None = None
    """The same for T < 0; without: as forward [W]."""


@dataclass(frozen=True, kw_only=True)
class FinSpec(Spec):
    """A control surface: a foil that turns about its span; see `fins`."""

    name: str = element(attribute=True)
    """The name, also of the actuator."""
    link: str = element(attribute=True)
    """The link to which it is fixed."""
    position: Triple = ZERO
    """The position of the centre of pressure, in the link's frame [m]."""
    axis: Triple = (0.0, 0.0, 1.0)
    """The axis of rotation along the span, right-handed, in the link's frame [1]."""
    chord: Triple = (1.0, 0.0, 0.0)
    """The direction of the leading edge at the angle 0, in the link's frame [1]."""
    area: float = element(exclusive_minimum=0.0, maximum=MAX_FIN_AREA)
    """The area of the planform [m2]."""
    aspect_ratio: float | None = element(default=None, exclusive_minimum=0.0)
    """The effective aspect ratio, span squared / area, for a missing slope or induced drag [1]."""
    lift_slope: float | None = element(default=None, exclusive_minimum=0.0, maximum=MAX_LIFT_SLOPE)
    """The slope of the lift coefficient over the angle of attack, below the stall; without: 1 / (1
    / (1.8 pi) + 1 / (pi AR)) with the aspect ratio AR [1/rad]."""
    stall: float = element(default=0.3, exclusive_minimum=0.0, maximum=1.57)
    """The angle of attack from which the flow separates [rad]."""
    drag: float = element(default=0.01, minimum=0.0)
    """The drag coefficient without lift [1]."""
    induced_drag: float | None = element(default=None, minimum=0.0)
    """The drag coefficient per lift coefficient squared, below the stall; without: 1 / (0.9 pi AR),
    or 0 [1]."""
    plate_drag: float = element(default=1.2, minimum=0.0)
    """The force coefficient of the separated flow, across the foil [1]."""
    coefficients: Numbers = ()
    """The coefficients instead of the formula: rows of angle of attack [rad], lift and drag
    coefficient, up to 12, rising. A foil with angles from 0 on only is symmetric [rad, 1, 1]."""
    limits: TwoNumbers = (-0.35, 0.35)
    """The least and greatest angle; 0 0 for a fixed fin [rad]."""
    rate: float | None = element(default=None, exclusive_minimum=0.0)
    """The greatest speed of the servo; without: any [rad/s]."""
    time_constant: float = element(default=0.0, minimum=0.0, maximum=MAX_TIME_CONSTANT)
    """The first-order lag of the servo [s]."""

    @property
    def slope(self) -> float:
        """The lift slope, given or from the aspect ratio [1/rad]; 0 without either."""
        if self.lift_slope is not None:
            return self.lift_slope
        ratio = self.aspect_ratio
        return 0.0 if ratio is None else 1.0 / (1.0 / (1.8 * math.pi) + 1.0 / (math.pi * ratio))

    @property
    def induced_drag_slope(self) -> float:
        """The drag coefficient per lift coefficient squared, given or from the aspect ratio [1]."""
        if self.induced_drag is not None:
            return self.induced_drag
        return 0.0 if self.aspect_ratio is None else 1.0 / (0.9 * math.pi * self.aspect_ratio)


@dataclass(frozen=True, kw_only=True)
class JointDrive(Spec):
    """The electric power of a joint's motor (`uwsim.physics.actuation.power`)."""

    name: str = element(attribute=True)
    """The joint of the URDF."""
    efficiency: float = element(default=0.6, exclusive_minimum=0.0, maximum=1.0)
    """The mechanical power per electrical power, without copper loss [1]."""
    copper_loss: float = element(default=0.0, minimum=0.0)
    """The power per effort squared, at rest too [W/(N m)2, W/N2]."""


@dataclass(frozen=True, kw_only=True)
class VehicleHydrodynamics(Spec):
    """A named set: every link and thruster of a vehicle."""

    name: str = element(attribute=True)
    """The name in ``<u:dynamics>`` of scenes."""
    source: str = ""
    """The source of the numbers, and which are estimates."""
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
    """The files from which it was read, the set's own file first."""

    def body(self, link: str) -> BodyHydrodynamics | None:
        """Return the entry of a link."""
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
        """Return the drive of a joint."""
        drives = (drive for drive in self.joints if drive.name == joint)
        return next(drives, JointDrive(name=joint))


def _scale(factor: float, numbers: Numbers) -> Numbers:
    return tuple(factor * number for number in numbers)


def matrix(numbers: Numbers) -> npt.NDArray[np.float64]:
    """Return a (6, 6) matrix from its diagonal or its rows."""
    values = np.array(numbers, dtype=np.float64)
    return np.diag(values) if len(values) == 6 else values.reshape(6, 6)
