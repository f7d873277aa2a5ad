"""The parameters of a vehicle in water, as in its hydrodynamics file; `checks` checks them.

Every 6x6 matrix is in the literature's order (surge, sway, heave, roll, pitch, yaw) in the axes of
the body (link) it belongs to, about its reference point. Forces oppose motion with positive
coefficients; published derivatives (``X_udot``, ``X_u``) mostly carry the other sign.
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
"""Of a table over the advance ratio or the angle of attack."""

DragLaw = Literal["axes", "speed", "x", "y", "z"]
Shape = Literal["sphere", "ellipsoid", "box", "cylinder", "shrinking-sphere"]

SIZES: dict[str, int] = {
    "sphere": 1, "ellipsoid": 3, "box": 3, "cylinder": 2, "shrinking-sphere": 1
}  # fmt: skip
"""Shape -> how many lengths it has."""
N_CURVE = 9
"""Most coefficients of a curve."""
MIN_RADIUS = 0.001
"""Of a propeller [m]."""
SLOWEST_ROTOR = 60.0
"""Longest lag of a thruster or a fin [s]."""
LARGEST_FIN = 1000.0
"""No fin has a larger planform [m2]."""
STEEPEST_LIFT = 6.29
"""Lift slope of a thin foil of endless span, 2 pi [1/rad]."""
LIQUIDS = (100.0, 20000.0)
"""Least and greatest density of what a vehicle may swim in: liquid hydrogen has 71, mercury 13 534
[kg/m3]."""
BEST_EFFICIENCY = 1.41
"""Of a thruster, sqrt(2): an ideal propeller in an ideal duct [1]."""


class BadHydrodynamics(UwsimError):
    """Coefficients that no body in water can have; carries every error."""

    def __init__(self, errors: Sequence[str]) -> None:
        self.errors = tuple(errors)
        super().__init__("\n".join(errors))


@dataclass(frozen=True, kw_only=True)
class BodyHydrodynamics(Spec):
    """The hydrodynamic parameters of one link or object."""

    link: str = element(attribute=True)
    """The link of the URDF that it belongs to."""
    reference: Triple = ZERO
    """The point that added mass and damping are about, in the link's frame [m]."""
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
    """Water displaced when fully submerged [m3]."""
    centre_of_buoyancy: Triple = ZERO
    """In the link's frame [m]."""
    shape: Shape = "sphere"
    """How it comes out of the water: volume as a function of depth and attitude. The shape
    stands at the centre of buoyancy with the link's axes; a cylinder's axis is z."""
    size: Numbers = element(default=(), above=0.0)
    """Of the shape [m]: radius; half-axes; edges; radius and length. Without: the sphere of that
    volume. Only the submerged *fraction* is taken from the shape."""
    mass: float | None = element(default=None, above=0.0)
    """Replaces the URDF's mass [kg]."""
    centre_of_mass: Triple | None = None
    """Replaces the URDF's; in the link's frame [m]."""
    inertia: Numbers | None = None
    """Replaces the URDF's; about the centre of mass, link's axes: xx, yy, zz, xy, xz, yz
    [kg m2]."""
    drag_law: DragLaw = "axes"
    """What the quadratic drag of 6 numbers goes with: by ``axes`` each component's own speed,
    |v_j| v_j, which for a ball would depend on how it is turned; by ``speed`` that of all three,
    |v| v, for what has no axes; about ``x``, ``y`` or ``z`` that of both components across the
    axis, for a body of revolution. 36 numbers go by ``axes``. A file without it: ``speed`` where
    the first three numbers are equal."""
    implicitness: float = element(default=0.5, minimum=0.0, maximum=1.0)
    """How much of the drag is taken at the end of a step: 0 explicit, 0.5 the trapezoidal rule, 1
    implicit (for light things with much drag). Not used by RK4."""


@dataclass(frozen=True, kw_only=True)
class ThrusterSpec(Spec):
    """A propeller: command in, thrust out, along its direction at its place."""

    name: str = element(attribute=True)
    """Its name; the actuator's too."""
    link: str = element(attribute=True)
    """The link it is fixed to."""
    position: Triple = ZERO
    """In the link's frame [m]."""
    direction: Triple = (1.0, 0.0, 0.0)
    """Direction of the force on the vehicle at a positive command, in the link's frame [1]."""
    forward: Numbers
    """Thrust = c1 x + c2 x^2 + ... of the command x > 0, up to nine coefficients [N]."""
    backward: Numbers | None = None
    """The same for x < 0 (thrust = -(c1 |x| + c2 x^2 + ...)); without: as forward [N]."""
    dead_zone: float = element(default=0.0, minimum=0.0)
    """Commands up to this give nothing, and the curve starts there [1]."""
    limits: TwoNumbers = (-1.0, 1.0)
    """Least and greatest command [1]."""
    saturation: TwoNumbers | None = None
    """Least and greatest thrust [N]."""
    time_constant: float = element(default=0.0, minimum=0.0, maximum=SLOWEST_ROTOR)
    """First-order lag between command and rotor [s]; 0 for none."""
    torque: float = 0.0
    """Torque about the direction per thrust, positive right-handed [m]."""
    radius: float = element(default=0.05, minimum=MIN_RADIUS)
    """Radius of the propeller, for the loss of thrust at the surface and the power it draws [m]."""
    efficiency: float | None = element(default=None, above=0.0, maximum=BEST_EFFICIENCY)
    """From the battery to the ideal propeller of that radius (`uwsim.physics.actuation.power`);
    without it and without ``power``: 0.4 [1]."""
    advance: Numbers = ()
    """Pairs of the advance ratio J = V / (n D) and the thrust coefficient KT, from J = 0 on, up to
    12: thrust falls by KT(J) / KT(0), linear between the pairs and beyond, so that two are a line.
    Without: thrust is that at rest [1, 1]."""
    wake: float = element(default=0.0, minimum=0.0, maximum=0.99)
    """Wake fraction: share by which the water at the propeller is slower than the vehicle [1]."""
    power: Numbers | None = None
    """What it draws instead: c1 |T| + c2 |T|^2 + ... of its thrust T, up to nine [W]."""
    power_backward: Numbers | None = None
    """The same for T < 0; without: as forward [W]."""


@dataclass(frozen=True, kw_only=True)
class FinSpec(Spec):
    """A control surface: a foil that turns about its span; see `fins`."""

    name: str = element(attribute=True)
    """Its name; the actuator's too."""
    link: str = element(attribute=True)
    """The link it is fixed to."""
    position: Triple = ZERO
    """Of its centre of pressure, in the link's frame [m]."""
    axis: Triple = (0.0, 0.0, 1.0)
    """Along the span, in the link's frame; it turns right-handed about it [1]."""
    chord: Triple = (1.0, 0.0, 0.0)
    """Where its leading edge points at the angle 0, in the link's frame [1]."""
    area: float = element(above=0.0, maximum=LARGEST_FIN)
    """Of its planform [m2]."""
    aspect_ratio: float | None = element(default=None, above=0.0)
    """Effective, span squared / area; gives what is missing of ``lift_slope`` and
    ``induced_drag`` [1]."""
    lift_slope: float | None = element(default=None, above=0.0, maximum=STEEPEST_LIFT)
    """Of the lift coefficient over the angle of attack, below the stall; without:
    1 / (1 / (1.8 pi) + 1 / (pi AR)) with the aspect ratio AR [1/rad]."""
    stall: float = element(default=0.3, above=0.0, maximum=1.57)
    """Angle of attack from which the flow separates [rad]."""
    drag: float = element(default=0.01, minimum=0.0)
    """Drag coefficient without lift [1]."""
    induced_drag: float | None = element(default=None, minimum=0.0)
    """Drag coefficient per lift coefficient squared, below the stall; without: 1 / (0.9 pi AR), or
    0 [1]."""
    plate_drag: float = element(default=1.2, minimum=0.0)
    """Force coefficient of the separated flow, across the foil [1]."""
    coefficients: Numbers = ()
    """Instead of the formula: rows of angle of attack [rad], lift and drag coefficient, up to 12,
    rising. A foil of which only angles from 0 on are given is symmetric [rad, 1, 1]."""
    limits: TwoNumbers = (-0.35, 0.35)
    """Least and greatest angle; 0 0 for one that is fixed [rad]."""
    rate: float | None = element(default=None, above=0.0)
    """Greatest speed of its servo; without: any [rad/s]."""
    time_constant: float = element(default=0.0, minimum=0.0, maximum=SLOWEST_ROTOR)
    """First-order lag of its servo [s]."""

    @property
    def slope(self) -> float:
        """Of the lift, given or by the aspect ratio [1/rad]; 0 without either."""
        if self.lift_slope is not None:
            return self.lift_slope
        ratio = self.aspect_ratio
        return 0.0 if ratio is None else 1.0 / (1.0 / (1.8 * math.pi) + 1.0 / (math.pi * ratio))

    @property
    def induced(self) -> float:
        """Drag coefficient per lift coefficient squared, given or by the aspect ratio [1]."""
        if self.induced_drag is not None:
            return self.induced_drag
        return 0.0 if self.aspect_ratio is None else 1.0 / (0.9 * math.pi * self.aspect_ratio)


@dataclass(frozen=True, kw_only=True)
class JointDrive(Spec):
    """Parameters of the electric power of a joint's motor (`uwsim.physics.actuation.power`)."""

    name: str = element(attribute=True)
    """The joint of the URDF."""
    efficiency: float = element(default=0.6, above=0.0, maximum=1.0)
    """Mechanical power per electrical power, copper loss aside [1]."""
    copper_loss: float = element(default=0.0, minimum=0.0)
    """Power per effort squared, moving or not [W/(N m)2, W/N2]."""


@dataclass(frozen=True, kw_only=True)
class VehicleHydrodynamics(Spec):
    """A named set: every link and thruster of a vehicle."""

    name: str = element(attribute=True)
    """What scenes call it in ``<u:dynamics>``."""
    source: str = ""
    """Where the numbers come from, and which are estimates."""
    density: float = element(default=1000.0, minimum=LIQUIDS[0], maximum=LIQUIDS[1])
    """Density of the water that the numbers are for: volumes were trimmed in it [kg/m3]."""
    include: tuple[str, ...] = ()
    """Other hydrodynamics files in its folder; what they have is added when it is read."""
    bodies: tuple[BodyHydrodynamics, ...] = element("body", default=())
    """One a link, at most."""
    thrusters: tuple[ThrusterSpec, ...] = element("thruster", default=())
    """In the order of the command vector."""
    fins: tuple[FinSpec, ...] = element("fin", default=())
    """Control surfaces, in the order of the vector of their angles."""
    joints: tuple[JointDrive, ...] = element("joint", default=())
    """Joints whose drives are known, one each, at most; any other is as `JointDrive` has it."""
    files: tuple[Path, ...] = field(default=(), compare=False, metadata={"path": True})
    """What it was read from, the set's own file first."""

    def body(self, link: str) -> BodyHydrodynamics | None:
        """Find the entry of a link."""
        return next((body for body in self.bodies if body.link == link), None)

    def in_water(self, density: float) -> VehicleHydrodynamics:
        """Return the same vehicle in other water [kg/m3].

        Masses, volumes and thrusts stay. Added mass and drag, which are the water's, grow with its
        density.
        """
        share = density / self.density
        if share == 1.0:
            return self
        bodies = tuple(
            replace(
                body,
                added_mass=_times(share, body.added_mass),
                linear_damping=_times(share, body.linear_damping),
                quadratic_damping=_times(share, body.quadratic_damping),
                body_lift=_times(share, body.body_lift),
            )
            for body in self.bodies
        )
        return replace(self, bodies=bodies, density=density)

    def drive(self, joint: str) -> JointDrive:
        """What moves a joint."""
        known = (drive for drive in self.joints if drive.name == joint)
        return next(known, JointDrive(name=joint))


def _times(factor: float, numbers: Numbers) -> Numbers:
    return tuple(factor * number for number in numbers)


def matrix(numbers: Numbers) -> npt.NDArray[np.float64]:
    """A (6, 6) matrix from its diagonal or its rows."""
    values = np.array(numbers, dtype=np.float64)
    return np.diag(values) if len(values) == 6 else values.reshape(6, 6)
