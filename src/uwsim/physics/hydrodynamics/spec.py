"""What the water does to a body, and what a thruster does: numbers, checked all at once.

Every 6x6 matrix is in the literature's order (surge, sway, heave, roll, pitch, yaw) in the axes of
the body (link) it belongs to, about its reference point. Forces oppose motion with positive
coefficients; published derivatives (``X_udot``, ``X_u``) mostly carry the other sign.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np
import numpy.typing as npt

from ...errors import UwsimError, did_you_mean

Triple = tuple[float, float, float]
Numbers = tuple[float, ...]
Shape = Literal["sphere", "ellipsoid", "box", "cylinder", "shrinking-sphere"]

ZERO: Triple = (0.0, 0.0, 0.0)
SIZES: dict[str, int] = {
    "sphere": 1, "ellipsoid": 3, "box": 3, "cylinder": 2, "shrinking-sphere": 1
}  # fmt: skip
"""Shape -> how many lengths it has."""
N_CURVE = 9
BEST_EFFICIENCY = 1.41
"""Of a thruster, sqrt(2): an ideal propeller in an ideal duct [1]."""


class BadHydrodynamics(UwsimError):
    """Coefficients that no body in water can have; carries every fault."""

    def __init__(self, faults: Sequence[str]) -> None:
        self.faults = tuple(faults)
        super().__init__("\n".join(faults))


@dataclass(frozen=True, kw_only=True)
class BodyHydrodynamics:
    """What the water does to one link or object."""

    link: str
    """The link it belongs to."""
    reference: Triple = ZERO
    """The point that added mass and damping are about, in the link's frame [m]."""
    added_mass: Numbers = (0.0,) * 6
    """6 numbers (the diagonal) or 36, row by row; symmetric, positive semi-definite
    [kg, kg m, kg m2]."""
    linear_damping: Numbers = (0.0,) * 6
    """6 or 36: force per relative velocity [N s/m, N s, N m s]."""
    quadratic_damping: Numbers = (0.0,) * 6
    """6 or 36: force = coefficient |v_j| v_j of the column's velocity [N s2/m2, ...]."""
    volume: float = 0.0
    """Water displaced when fully submerged [m3]."""
    centre_of_buoyancy: Triple = ZERO
    """In the link's frame [m]."""
    shape: Shape = "sphere"
    """How it comes out of the water: volume as a function of depth and attitude. The shape
    stands at the centre of buoyancy with the link's axes; a cylinder's axis is z."""
    size: Numbers = ()
    """Of the shape [m]: radius; half-axes; edges; radius and length. Without: the sphere of that
    volume. Only the submerged *fraction* is taken from the shape."""
    mass: float | None = None
    """Replaces the URDF's mass [kg]."""
    centre_of_mass: Triple | None = None
    """Replaces the URDF's; in the link's frame [m]."""
    inertia: Numbers | None = None
    """Replaces the URDF's, about the centre of mass, link's axes: xx, yy, zz, xy, xz, yz
    [kg m2]."""
    implicitness: float = 0.5
    """How much of the drag is taken at the end of a step: 0 explicit, 0.5 the trapezoidal rule, 1
    implicit (for light things with much drag). Not used by RK4."""


@dataclass(frozen=True, kw_only=True)
class ThrusterSpec:
    """A propeller: command in, thrust out, along its direction at its place."""

    name: str
    """Its name; the actuator's too."""
    link: str
    """The link it is fixed to."""
    position: Triple = ZERO
    """In the link's frame [m]."""
    direction: Triple = (1.0, 0.0, 0.0)
    """Of the force on the vehicle at a positive command, in the link's frame [1]."""
    forward: Numbers = (1.0,)
    """Thrust = c1 x + c2 x^2 + ... of the command x > 0, up to nine coefficients [N]."""
    backward: Numbers | None = None
    """The same for x < 0 (thrust = -(c1 |x| + c2 x^2 + ...)); without: as forward [N]."""
    dead_zone: float = 0.0
    """Commands up to this give nothing, and the curve starts there [1]."""
    limits: tuple[float, float] = (-1.0, 1.0)
    """Least and greatest command [1]."""
    saturation: tuple[float, float] | None = None
    """Least and greatest thrust [N]."""
    time_constant: float = 0.0
    """First-order lag between command and rotor [s]; 0 for none."""
    torque: float = 0.0
    """Torque about the direction per thrust, positive right-handed [m]."""
    radius: float = 0.05
    """Of the propeller, for the loss of thrust at the surface and the power it draws [m]."""
    efficiency: float = 0.4
    """From the battery to the ideal propeller of that radius (`uwsim.physics.power`) [1]."""
    power: Numbers | None = None
    """What it draws instead: c1 |T| + c2 |T|^2 + ... of its thrust T, up to nine [W]."""
    power_backward: Numbers | None = None
    """The same for T < 0; without: as forward [W]."""


@dataclass(frozen=True, kw_only=True)
class JointDrive:
    """What the motor of a joint draws (`uwsim.physics.power`)."""

    name: str
    """Of the joint."""
    efficiency: float = 0.6
    """Mechanical power per electrical power, copper loss aside [1]."""
    copper_loss: float = 0.0
    """Power per effort squared, moving or not [W/(N m)2 or W/N2]."""


@dataclass(frozen=True, kw_only=True)
class VehicleHydrodynamics:
    """A named set: every link and thruster of a vehicle."""

    name: str
    """As scenes call it in ``<u:dynamics>``."""
    source: str
    """Where the numbers come from, and which are estimates."""
    bodies: tuple[BodyHydrodynamics, ...]
    """One a link, at most."""
    thrusters: tuple[ThrusterSpec, ...] = ()
    """In the order of the command vector."""
    joints: tuple[JointDrive, ...] = ()
    """Joints whose drives are known; any other is as `JointDrive` has it."""
    density: float = 1000.0
    """Of the water that the numbers were given for [kg/m3]."""
    files: tuple[Path, ...] = field(default=(), compare=False)
    """What it was read from, the set's own file first."""

    def body(self, link: str) -> BodyHydrodynamics | None:
        """Find the entry of a link."""
        return next((body for body in self.bodies if body.link == link), None)

    def drive(self, joint: str) -> JointDrive:
        """What moves a joint."""
        known = (drive for drive in self.joints if drive.name == joint)
        return next(known, JointDrive(name=joint))


def matrix(numbers: Numbers) -> npt.NDArray[np.float64]:
    """A (6, 6) matrix from its diagonal or its rows."""
    values = np.array(numbers, dtype=np.float64)
    return np.diag(values) if len(values) == 6 else values.reshape(6, 6)


def body_faults(body: BodyHydrodynamics) -> list[str]:
    """Everything that is wrong with the numbers of a body."""
    who = f"link {body.link!r}"
    faults = []
    for name in ("added_mass", "linear_damping", "quadratic_damping"):
        numbers: Numbers = getattr(body, name)
        if len(numbers) not in (6, 36):
            faults.append(f"{who}: {_words(name)} has {len(numbers)} numbers; expected 6 or 36")
        elif not all(math.isfinite(number) for number in numbers):
            faults.append(f"{who}: {_words(name)} holds a number that is not finite")
        elif name == "added_mass":
            faults += _mass_faults(who, matrix(numbers))
        elif min(np.diag(matrix(numbers))) < 0.0:
            faults.append(
                f"{who}: {_words(name)} has the diagonal {_list(np.diag(matrix(numbers)))}; "
                "expected none below 0 (drag opposes motion with positive coefficients)"
            )
    if not body.volume >= 0.0:
        faults.append(f"{who}: volume is {body.volume:g}; expected >= 0 [m3]")
    if body.shape not in SIZES:
        faults.append(
            f"{who}: shape is {body.shape!r}; expected one of {', '.join(SIZES)}."
            f"{did_you_mean(body.shape, SIZES)}"
        )
    elif body.size and len(body.size) != SIZES[body.shape]:
        faults.append(
            f"{who}: a {body.shape} has {SIZES[body.shape]} lengths; found {len(body.size)}"
        )
    elif not body.size and body.shape != "sphere":
        faults.append(f"{who}: a {body.shape} needs its {SIZES[body.shape]} lengths (size) [m]")
    if any(not length > 0.0 for length in body.size):
        faults.append(f"{who}: size is {_list(body.size)}; expected lengths > 0 [m]")
    if body.mass is not None and not body.mass > 0.0:
        faults.append(f"{who}: mass is {body.mass:g}; expected > 0 [kg]")
    if body.inertia is not None:
        faults += _inertia_faults(who, body.inertia)
    if not 0.0 <= body.implicitness <= 1.0:
        faults.append(f"{who}: implicitness is {body.implicitness:g}; expected 0..1")
    return faults


def thruster_faults(thruster: ThrusterSpec) -> list[str]:
    """Everything that is wrong with the numbers of a thruster."""
    who = f"thruster {thruster.name!r}"
    faults = []
    if not math.hypot(*thruster.direction) > 1e-9:
        faults.append(f"{who}: direction is 0 0 0; expected a direction")
    for side in ("forward", "backward", "power", "power_backward"):
        curve = getattr(thruster, side)
        if curve is not None and not 1 <= len(curve) <= N_CURVE:
            faults.append(
                f"{who}: {_words(side)} has {len(curve)} coefficients; expected 1 to {N_CURVE}"
            )
    if thruster.power is None and thruster.power_backward is not None:
        faults.append(f"{who}: power backward is given without power")
    if not 0.0 < thruster.efficiency <= BEST_EFFICIENCY:
        faults.append(
            f"{who}: efficiency is {thruster.efficiency:g}; expected > 0 and <= {BEST_EFFICIENCY:g}"
        )
    if not thruster.dead_zone >= 0.0:
        faults.append(f"{who}: dead zone is {thruster.dead_zone:g}; expected >= 0")
    for name in ("limits", "saturation"):
        ends = getattr(thruster, name)
        if ends is not None and not ends[0] <= 0.0 <= ends[1]:
            faults.append(f"{who}: {name} are {_list(ends)}; expected least <= 0 <= greatest")
    if not thruster.limits[0] < thruster.limits[1]:
        faults.append(f"{who}: limits are {_list(thruster.limits)}; expected least < greatest")
    if not thruster.time_constant >= 0.0:
        faults.append(f"{who}: time constant is {thruster.time_constant:g}; expected >= 0 [s]")
    if not thruster.radius > 0.0:
        faults.append(f"{who}: radius is {thruster.radius:g}; expected > 0 [m]")
    return faults


def drive_faults(drive: JointDrive) -> list[str]:
    """Everything that is wrong with the numbers of a joint's drive."""
    who = f"joint {drive.name!r}"
    faults = []
    if not 0.0 < drive.efficiency <= 1.0:
        faults.append(f"{who}: efficiency is {drive.efficiency:g}; expected > 0 and <= 1")
    if not drive.copper_loss >= 0.0:
        faults.append(f"{who}: copper loss is {drive.copper_loss:g}; expected >= 0")
    return faults


def vehicle_faults(vehicle: VehicleHydrodynamics, links: Iterable[str]) -> list[str]:
    """Everything that is wrong with a set, for a robot with these links."""
    known = list(links)
    faults = []
    links_named = [body.link for body in vehicle.bodies]
    for kind, names in (
        ("link", links_named),
        ("thruster", [thruster.name for thruster in vehicle.thrusters]),
        ("joint", [drive.name for drive in vehicle.joints]),
    ):
        faults += [
            f"two entries for the {kind} {name!r}; only one may be"
            for name in sorted({name for name in names if names.count(name) > 1})
        ]
    for body in vehicle.bodies:
        faults += body_faults(body)
    for thruster in vehicle.thrusters:
        faults += thruster_faults(thruster)
    for drive in vehicle.joints:
        faults += drive_faults(drive)
    places = [("", link) for link in links_named]
    places += [(f"thruster {one.name!r}: ", one.link) for one in vehicle.thrusters]
    for who, link in places:
        if link not in known:
            faults.append(
                f"{who}the robot has no link {link!r}.{did_you_mean(link, known)} "
                f"Links: {', '.join(known) or 'none'}"
            )
    if not vehicle.density > 0.0:
        faults.append(f"density is {vehicle.density:g}; expected > 0 [kg/m3]")
    return faults


def _mass_faults(who: str, added: npt.NDArray[np.float64]) -> list[str]:
    scale = float(np.abs(added).max())
    skew = np.abs(added - added.T)
    if scale and skew.max() > 1e-6 * scale:
        i, j = np.unravel_index(int(np.argmax(skew)), skew.shape)
        return [
            f"{who}: added mass is not symmetric: entry ({i + 1},{j + 1}) is {added[i, j]:g} and "
            f"({j + 1},{i + 1}) is {added[j, i]:g}"
        ]
    least = float(np.linalg.eigvalsh(0.5 * (added + added.T))[0])
    if least < -1e-9 * scale:
        return [
            f"{who}: added mass is not positive semi-definite: its least eigenvalue is "
            f"{least:g} (published derivatives carry the opposite sign)"
        ]
    return []


def _inertia_faults(who: str, inertia: Numbers) -> list[str]:
    if len(inertia) != 6:
        return [f"{who}: inertia has {len(inertia)} numbers; expected xx yy zz xy xz yz"]
    xx, yy, zz, xy, xz, yz = inertia
    principal = np.linalg.eigvalsh(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
    if not principal[0] > 0.0:
        return [f"{who}: inertia has the least principal moment {principal[0]:g}; expected > 0"]
    if principal[2] > (principal[0] + principal[1]) * (1.0 + 1e-6):
        return [
            f"{who}: inertia has the principal moments {_list(principal)}; no body can have one "
            "above the sum of the two others"
        ]
    return []


def _words(name: str) -> str:
    return name.replace("_", " ")


def _list(values: Iterable[float]) -> str:
    return " ".join(f"{value:g}" for value in values)
