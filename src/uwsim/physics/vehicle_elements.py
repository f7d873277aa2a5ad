"""The elements of a vehicle's hydrodynamics file, as `vehicle_file` reads them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..schema import element
from .hydrodynamics.faults import LIQUIDS, MIN_RADIUS, SLOWEST_ROTOR
from .hydrodynamics.spec import BEST_EFFICIENCY

Triple = tuple[float, float, float]
ZERO: Triple = (0.0, 0.0, 0.0)


@dataclass(frozen=True, kw_only=True)
class BodyElement:
    """A ``<body>``: what the water does to one link."""

    link: str = element(attribute=True)
    """The link of the URDF."""
    mass: float | None = element(default=None, above=0.0)
    """Replaces the URDF's mass [kg]."""
    centre_of_mass: Triple | None = None
    """Replaces the URDF's, in the link's frame [m]."""
    inertia: str = ""
    """Replaces the URDF's: xx yy zz xy xz yz about the centre of mass, link's axes [kg m2]."""
    reference: Triple = ZERO
    """The point that the three next are about, in the link's frame [m]."""
    added_mass: str = ""
    """6 numbers (the diagonal) or 36 (rows), surge sway heave roll pitch yaw, positive
    [kg, kg m, kg m2]."""
    linear_damping: str = ""
    """6 or 36, positive: force per speed [N s/m, N s, N m s]."""
    quadratic_damping: str = ""
    """6 or 36, positive: force per speed squared [N s2/m2, N s2, N m s2]."""
    volume: float = element(default=0.0, minimum=0.0)
    """Water displaced when fully submerged [m3]."""
    centre_of_buoyancy: Triple = ZERO
    """In the link's frame [m]."""
    shape: Literal["sphere", "ellipsoid", "box", "cylinder", "shrinking-sphere"] = "sphere"
    """How it comes out of the water; stands at the centre of buoyancy, along the link's axes."""
    size: str = ""
    """Of the shape: radius; three half-axes; three edges; radius and length along z. Without:
    the sphere of that volume [m]."""
    drag_law: Literal["axes", "speed", "x", "y", "z"] | None = None
    """What 6 numbers of quadratic damping go with: by ``axes`` each component's own speed, by
    ``speed`` that of all three components, about ``x``, ``y`` or ``z`` that of the two across the
    axis. Without: ``speed`` where the first three numbers are equal, else ``axes``."""
    implicitness: float = element(default=0.5, minimum=0.0, maximum=1.0)
    """Share of the drag taken at the end of a step; 1 for light things with much drag [1]."""


@dataclass(frozen=True, kw_only=True)
class ThrusterElement:
    """A ``<thruster>``: a propeller."""

    name: str = element(attribute=True)
    """Its name."""
    link: str = element(attribute=True)
    """The link it is fixed to."""
    position: Triple = ZERO
    """In the link's frame [m]."""
    direction: Triple = (1.0, 0.0, 0.0)
    """Of the force on the vehicle at a positive command, in the link's frame [1]."""
    forward: str
    """Thrust at a command x > 0: c1 x + c2 x^2 + ..., up to nine coefficients [N]."""
    backward: str = ""
    """The same of |x| for x < 0; without: as forward [N]."""
    dead_zone: float = element(default=0.0, minimum=0.0)
    """Commands up to this give nothing; the curve starts there [1]."""
    limits: str = "-1 1"
    """Least and greatest command [1]."""
    saturation: str = ""
    """Least and greatest thrust [N]."""
    time_constant: float = element(default=0.0, minimum=0.0, maximum=SLOWEST_ROTOR)
    """First-order lag of the rotor [s]."""
    torque: float = 0.0
    """Torque about the direction per thrust, positive right-handed [m]."""
    radius: float = element(default=0.05, minimum=MIN_RADIUS)
    """Of the propeller: at the surface its thrust is lost over this height, and the power it
    draws is that of its disc [m]."""
    efficiency: float | None = element(default=None, above=0.0, maximum=BEST_EFFICIENCY)
    """From the battery to the ideal propeller of that radius; without: 0.4 [1]."""
    power: str = ""
    """What it draws instead, c1 |T| + c2 |T|^2 + ... of its thrust T, up to nine [W]."""
    power_backward: str = ""
    """The same for a thrust below 0; without: as power [W]."""


@dataclass(frozen=True, kw_only=True)
class JointElement:
    """A ``<joint>``: what moves a joint of the URDF."""

    name: str = element(attribute=True)
    """The joint of the URDF."""
    efficiency: float = element(default=0.6, above=0.0, maximum=1.0)
    """Mechanical power per electrical power, copper loss aside [1]."""
    copper_loss: float = element(default=0.0, minimum=0.0)
    """Power per effort squared, moving or held [W/(N m)2, W/N2]."""


@dataclass(frozen=True, kw_only=True)
class HydrodynamicsElement:
    """A hydrodynamics file."""

    name: str = element(attribute=True)
    """What scenes call the set in ``<u:dynamics>``."""
    source: str = ""
    """Where the numbers come from, and which are estimates."""
    density: float = element(default=1000.0, minimum=LIQUIDS[0], maximum=LIQUIDS[1])
    """Of the water the numbers were given for [kg/m3]."""
    include: tuple[str, ...] = ()
    """Other hydrodynamics files, beside this one."""
    body: tuple[BodyElement, ...] = ()
    """One a link, at most."""
    thruster: tuple[ThrusterElement, ...] = ()
    """In the order of the command vector."""
    joint: tuple[JointElement, ...] = ()
    """What moves the joints, one each, at most."""
