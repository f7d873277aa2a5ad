"""Everything that is wrong with the numbers of bodies, thrusters and drives, all at once."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable

import numpy as np

from ...errors import choices, did_you_mean
from ...geometry import Array
from ...schema import Numbers, fields_of
from .passivity import Kind, bearable_share, driving_motion
from .spec import (
    LIQUIDS,
    N_CURVE,
    SIZES,
    BodyHydrodynamics,
    JointDrive,
    ThrusterSpec,
    VehicleHydrodynamics,
    matrix,
)

MAX_LENGTH = 500.0
"""No length or place of a vehicle is beyond that of the longest ship [m]."""
MIN_INERTIA = 1e-12
"""What the engine still takes for one [kg m2]."""
SAG = 0.02
"""A measured thrust curve, or the polynomial through it, may fall by this share of its greatest
thrust."""
MAX_THRUST = 1e7
"""Of a propeller [N]."""
LENGTHS = ("reference", "centre_of_buoyancy", "size", "centre_of_mass", "position", "radius")
DRAG: dict[str, Kind] = {"linear_damping": "linear", "quadratic_damping": "quadratic"}


def body_errors(body: BodyHydrodynamics) -> list[str]:
    """Everything that is wrong with the numbers of a body."""
    who = f"link {body.link!r}"
    if errors := _no_numbers(who, body):
        return errors
    for name in ("added_mass", *DRAG):
        numbers: Numbers = getattr(body, name)
        if len(numbers) not in (6, 36):
            errors.append(f"{who}: {_words(name)} has {len(numbers)} numbers; expected 6 or 36")
        elif name == "added_mass":
            errors += _mass_errors(who, matrix(numbers))
        else:
            errors += _drag_errors(who, name, matrix(numbers))
    if body.shape not in SIZES:
        errors.append(
            f"{who}: shape is {body.shape!r}; expected one of {', '.join(SIZES)}."
            f"{did_you_mean(body.shape, SIZES)}"
        )
    elif body.size and len(body.size) != SIZES[body.shape]:
        errors.append(
            f"{who}: a {body.shape} has {SIZES[body.shape]} "
            f"{'length' if SIZES[body.shape] == 1 else 'lengths'}; found {len(body.size)}"
        )
    elif not body.size and body.shape != "sphere":
        errors.append(f"{who}: a {body.shape} needs its {SIZES[body.shape]} lengths (size) [m]")
    if body.inertia is not None:
        errors += _inertia_errors(who, body.inertia)
    return errors + _beyond_limits(who, body)


def thruster_errors(thruster: ThrusterSpec) -> list[str]:
    """Everything that is wrong with the numbers of a thruster."""
    who = f"thruster {thruster.name!r}"
    if errors := _no_numbers(who, thruster):
        return errors
    if not math.hypot(*thruster.direction) > 1e-9:
        errors.append(f"{who}: direction is 0 0 0; expected a direction")
    for side in ("forward", "backward", "power", "power_backward"):
        curve = getattr(thruster, side)
        if curve is not None and not 1 <= len(curve) <= N_CURVE:
            errors.append(
                f"{who}: {_words(side)} has {len(curve)} coefficients; expected 1 to {N_CURVE}"
            )
    if thruster.power is None and thruster.power_backward is not None:
        errors.append(f"{who}: power backward is given without power")
    if thruster.efficiency is not None and thruster.power is not None:
        errors.append(f"{who}: <efficiency> and <power> both say what it draws; give one")
    for name in ("limits", "saturation"):
        ends = getattr(thruster, name)
        if ends is not None and not (ends[0] <= 0.0 <= ends[1] and ends[0] < ends[1]):
            errors.append(
                f"{who}: {name} are {_list(ends)}; expected least <= 0 <= greatest, not both 0"
            )
    errors += _beyond_limits(who, thruster)
    if abs(thruster.torque) > 2.0 * thruster.radius > 0.0:
        errors.append(
            f"{who}: torque is {thruster.torque:g} per thrust; expected at most the propeller's "
            f"diameter, {2.0 * thruster.radius:g} [m]"
        )
    return errors or _thrust_errors(who, thruster)


def drive_errors(drive: JointDrive) -> list[str]:
    """Everything that is wrong with the numbers of a joint's drive."""
    who = f"joint {drive.name!r}"
    return _no_numbers(who, drive) or _beyond_limits(who, drive)


def density_errors(density: float) -> list[str]:
    """Say what is wrong with the density of the water."""
    if LIQUIDS[0] <= density <= LIQUIDS[1]:
        return []
    return [
        f"density is {density:g}; expected that of a liquid, {LIQUIDS[0]:g} to {LIQUIDS[1]:g} "
        "(fresh water 1000, sea water 1025) [kg/m3]"
    ]


def vehicle_errors(vehicle: VehicleHydrodynamics, links: Iterable[str]) -> list[str]:
    """Everything that is wrong with a set, for a robot with these links."""
    known = list(links)
    errors = []
    links_named = [body.link for body in vehicle.bodies]
    for kind, names in (
        ("link", links_named),
        ("thruster", [thruster.name for thruster in vehicle.thrusters]),
        ("joint", [drive.name for drive in vehicle.joints]),
    ):
        errors += [
            f"two entries for the {kind} {name!r}; only one may be"
            for name in sorted({name for name in names if names.count(name) > 1})
        ]
    for body in vehicle.bodies:
        errors += body_errors(body)
    for thruster in vehicle.thrusters:
        errors += thruster_errors(thruster)
    for drive in vehicle.joints:
        errors += drive_errors(drive)
    places = [("", link) for link in links_named]
    places += [(f"thruster {one.name!r}: ", one.link) for one in vehicle.thrusters]
    for who, link in places:
        if link not in known:
            errors.append(
                f"{who}the robot has no link {link!r}.{choices(link, known, called='Links')}"
            )
    return errors + density_errors(vehicle.density)


def _no_numbers(who: str, spec: BodyHydrodynamics | ThrusterSpec | JointDrive) -> list[str]:
    """Say what is not finite, and which lengths are beyond those of any vehicle."""
    errors = []
    for each in dataclasses.fields(spec):
        numbers = _numbers_of(spec, each.name)
        if not all(math.isfinite(number) for number in numbers):
            errors.append(
                f"{who}: {_words(each.name)} is {_list(numbers)}; expected finite numbers"
            )
        elif each.name in LENGTHS and any(abs(number) > MAX_LENGTH for number in numbers):
            errors.append(
                f"{who}: {_words(each.name)} is {_list(numbers)}; expected none beyond "
                f"{MAX_LENGTH:g} (metres, not millimetres) [m]"
            )
    return errors


def _beyond_limits(who: str, spec: BodyHydrodynamics | ThrusterSpec | JointDrive) -> list[str]:
    """Say which numbers are beyond the limits that their fields declare."""
    return [
        f"{who}: {_words(field.name)} is {_list(numbers)}; expected {field.expected}"
        for field in fields_of(type(spec))
        if not all(map(field.allows, numbers := _numbers_of(spec, field.name)))
    ]


def _numbers_of(spec: BodyHydrodynamics | ThrusterSpec | JointDrive, field: str) -> list[float]:
    value = getattr(spec, field)
    values = value if isinstance(value, tuple) else (value,)
    return [one for one in values if isinstance(one, int | float)]


def _mass_errors(who: str, added: Array) -> list[str]:
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


def _drag_errors(who: str, name: str, drag: Array) -> list[str]:
    if min(np.diag(drag)) < 0.0:
        return [
            f"{who}: {_words(name)} has the diagonal {_list(np.diag(drag))}; "
            "expected none below 0 (drag opposes motion with positive coefficients)"
        ]
    driving = driving_motion(DRAG[name], drag)
    if driving is None:
        return []
    motion, power = driving
    share = bearable_share(DRAG[name], drag)
    bearable = f"at most {share:.2f} times as large" if share > 0.0 else "0 where that is 0"
    return [
        f"{who}: {_words(name)} drives the body: at the velocity "
        f"{_list(np.round(motion, 3) + 0.0)} [m/s, rad/s] it gives it {power:.3g} W; expected drag "
        f"that only takes energy: entries beside this diagonal {bearable}"
    ]


def _thrust_errors(who: str, thruster: ThrusterSpec) -> list[str]:
    """Say where more command is less thrust, or none at all."""
    backward = thruster.forward if thruster.backward is None else thruster.backward
    sides = [
        ("forward", thruster.forward, thruster.limits[1], "0 at most"),
        ("backward", backward, -thruster.limits[0], "0 at least"),
    ]
    errors = []
    for side, curve, end, without in sides:
        if end == 0.0:
            continue
        if thruster.dead_zone >= end:
            return [
                f"{who}: dead zone is {thruster.dead_zone:g}; expected below {end:g}, the limit of "
                f"a {side} command: none gives thrust"
            ]
        sizes = np.linspace(0.0, end - thruster.dead_zone, 1001)
        thrusts = np.polynomial.polynomial.polyval(sizes, (0.0, *curve))  # (1001,) [N]
        before = np.maximum.accumulate(thrusts)
        if thrusts.max() > MAX_THRUST:
            errors.append(
                f"{who}: {side} gives {thrusts.max():.3g} N; expected at most {MAX_THRUST:g} N, "
                "twice the thrust of the largest ships"
            )
        worst = int(np.argmax(before - thrusts))
        if not thrusts[-1] > 0.0:
            errors.append(
                f"{who}: {side} gives {thrusts[-1]:g} N at the limit {end:g}; expected more than 0 "
                f"(a propeller that pushes the other way has another direction, one that does not "
                f"run {side} the limit {without})"
            )
        elif before[worst] - thrusts[worst] > SAG * before[-1]:
            at = sizes[worst] + thruster.dead_zone
            errors.append(
                f"{who}: {side} falls from {before[worst]:.4g} N to {thrusts[worst]:.4g} N at the "
                f"command {at:.3g}; expected thrust that grows with the command"
            )
        if thruster.backward is None and thruster.limits[0] == -thruster.limits[1]:
            break  # both sides are one
    return errors


def _inertia_errors(who: str, inertia: Numbers) -> list[str]:
    if len(inertia) != 6:
        return [f"{who}: inertia has {len(inertia)} numbers; expected xx yy zz xy xz yz"]
    xx, yy, zz, xy, xz, yz = inertia
    principal = np.linalg.eigvalsh(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
    if not principal[0] > MIN_INERTIA:
        return [
            f"{who}: inertia has the least principal moment {principal[0]:g}; "
            f"expected > {MIN_INERTIA:g} [kg m2]"
        ]
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
