"""Checks of the numbers of bodies and thrusters in hydrodynamics files."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...errors import did_you_mean
from ...schema import Numbers
from .number_checks import field_words, limit_errors, number_errors, text_of
from .passivity import Kind, driving_motion, passive_share
from .spec import (
    DENSITY_LIMITS,
    MAX_COEFFICIENTS,
    MAX_POINTS,
    N_LENGTHS,
    BodyHydrodynamics,
    ThrusterSpec,
    matrix,
)

MIN_INERTIA = 1e-12
"""The minimum moment of inertia that the engine accepts [kg m2]."""
MAX_THRUST_DROP = 0.02
"""The greatest drop of a thrust curve with rising command, as a fraction of the greatest thrust
[1]: fits to measurements are not exactly monotonic."""
MAX_THRUST = 1e7
"""The greatest thrust of a propeller [N]."""
DRAG_KINDS: dict[str, Kind] = {"linear_damping": "linear", "quadratic_damping": "quadratic"}
"""The kind of drag law of each damping field of `BodyHydrodynamics`."""


def body_errors(body: BodyHydrodynamics) -> list[str]:
    """Return every error in the numbers of a body."""
    owner = f"link {body.link!r}"
    if errors := number_errors(owner, body):
        return errors
    for name in ("added_mass", "body_lift", *DRAG_KINDS):
        numbers: Numbers = getattr(body, name)
        if len(numbers) not in (6, 36):
            errors.append(
                f"{owner}: {field_words(name)} has {len(numbers)} numbers; expected 6 or 36"
            )
        elif name == "body_lift":
            errors += _lift_errors(owner, matrix(numbers))
        elif name == "added_mass":
            errors += _added_mass_errors(owner, matrix(numbers))
        else:
            errors += _drag_errors(owner, name, matrix(numbers))
    if body.shape not in N_LENGTHS:
        errors.append(
            f"{owner}: shape is {body.shape!r}; expected one of {', '.join(N_LENGTHS)}."
            f"{did_you_mean(body.shape, N_LENGTHS)}"
        )
    elif body.size and len(body.size) != N_LENGTHS[body.shape]:
        errors.append(
            f"{owner}: a {body.shape} has {N_LENGTHS[body.shape]} "
            f"{'length' if N_LENGTHS[body.shape] == 1 else 'lengths'}; found {len(body.size)}"
        )
    elif not body.size and body.shape != "sphere":
        errors.append(
            f"{owner}: a {body.shape} needs its {N_LENGTHS[body.shape]} lengths (size) [m]"
        )
    if body.inertia is not None:
        errors += inertia_errors(owner, body.inertia)
    return errors + limit_errors(owner, body)


def thruster_errors(thruster: ThrusterSpec) -> list[str]:
    """Return every error in the numbers of a thruster."""
    owner = f"thruster {thruster.name!r}"
    if errors := number_errors(owner, thruster):
        return errors
    if not math.hypot(*thruster.direction) > 1e-9:
        errors.append(f"{owner}: direction is 0 0 0; expected a direction")
    for side in ("forward", "backward", "power", "power_backward"):
        curve = getattr(thruster, side)
        if curve is not None and not 1 <= len(curve) <= MAX_COEFFICIENTS:
            message = f"{field_words(side)} has {len(curve)} coefficients"
            errors.append(f"{owner}: {message}; expected 1 to {MAX_COEFFICIENTS}")
    if thruster.power is None and thruster.power_backward is not None:
        errors.append(f"{owner}: power backward is given without power")
    if thruster.efficiency is not None and thruster.power is not None:
        errors.append(f"{owner}: <efficiency> and <power> both set its power; expected one")
    for name in ("limits", "saturation"):
        ends = getattr(thruster, name)
        if ends is not None and not (ends[0] <= 0.0 <= ends[1] and ends[0] < ends[1]):
            errors.append(
                f"{owner}: {name} are {text_of(ends)}; expected least <= 0 <= greatest, not both 0"
            )
    errors += limit_errors(owner, thruster)
    if abs(thruster.torque) > 2.0 * thruster.radius > 0.0:
        errors.append(
            f"{owner}: torque is {thruster.torque:g} per thrust; expected at most the propeller's "
            f"diameter, {2.0 * thruster.radius:g} [m]"
        )
    errors += _advance_errors(owner, thruster.advance)
    return errors or _thrust_errors(owner, thruster)


def density_errors(density: float) -> list[str]:
    """Return the error in the density of the water [kg/m3], if any."""
    low, high = DENSITY_LIMITS
    if low <= density <= high:
        return []
    return [
        f"density is {density:g}; expected that of a liquid, {low:g} to {high:g} "
        "(fresh water 1000, sea water 1025) [kg/m3]"
    ]


def _added_mass_errors(owner: str, added_mass: Array) -> list[str]:
    scale = float(np.abs(added_mass).max())
    skew = np.abs(added_mass - added_mass.T)
    if scale and skew.max() > 1e-6 * scale:
        i, j = np.unravel_index(int(np.argmax(skew)), skew.shape)
        return [
            f"{owner}: added mass is not symmetric: entry ({i + 1},{j + 1}) is "
            f"{added_mass[i, j]:g} and ({j + 1},{i + 1}) is {added_mass[j, i]:g}"
        ]
    min_eigenvalue = float(np.linalg.eigvalsh(0.5 * (added_mass + added_mass.T))[0])
    if min_eigenvalue < -1e-9 * scale:
        return [
            f"{owner}: added mass is not positive semi-definite: its least eigenvalue is "
            f"{min_eigenvalue:g} (published derivatives carry the opposite sign)"
        ]
    return []


def _drag_errors(owner: str, name: str, drag: Array) -> list[str]:
    if min(np.diag(drag)) < 0.0:
        return [
            f"{owner}: {field_words(name)} has the diagonal {text_of(np.diag(drag))}; "
            "expected none below 0 (drag opposes motion with positive coefficients)"
        ]
    motion_and_power = driving_motion(DRAG_KINDS[name], drag)
    if motion_and_power is None:
        return []
    motion, power = motion_and_power
    share = passive_share(DRAG_KINDS[name], drag)
    limit = f"at most {share:.2f} times as large" if share > 0.0 else "0 where that is 0"
    return [
        f"{owner}: {field_words(name)} drives the body with {power:.3g} W at the velocity "
        f"{text_of(np.round(motion, 3) + 0.0)} [m/s, rad/s]. Expected drag that only takes "
        f"energy: entries off this diagonal {limit}"
    ]


def _lift_errors(owner: str, lift: Array) -> list[str]:
    if min(np.diag(lift)) >= 0.0:
        return []
    return [
        f"{owner}: body lift has the diagonal {text_of(np.diag(lift))}; expected none below 0 "
        "(lift opposes motion across the hull with positive coefficients)"
    ]


def _advance_errors(owner: str, advance: Numbers) -> list[str]:
    if not advance:
        return []
    if len(advance) % 2 or not 4 <= len(advance) <= 2 * MAX_POINTS:
        return [
            f"{owner}: advance has {len(advance)} numbers; expected 2 to {MAX_POINTS} pairs of "
            "advance ratio and thrust coefficient"
        ]
    ratios, factors = np.reshape(advance, (-1, 2)).T
    if ratios[0] != 0.0 or not np.all(np.diff(ratios) > 0.0):
        return [f"{owner}: advance has the ratios {text_of(ratios)}; expected 0 first, rising"]
    if not factors[0] > 0.0:
        return [f"{owner}: advance has KT {factors[0]:g} at rest; expected > 0"]
    if np.any(np.diff(factors) > 0.0):
        return [
            f"{owner}: advance has the KT {text_of(factors)}; expected none above the one before"
        ]
    return []


def _thrust_errors(owner: str, thruster: ThrusterSpec) -> list[str]:
    backward = thruster.forward if thruster.backward is None else thruster.backward
    sides = [
        ("forward", thruster.forward, thruster.limits[1], "0 at most"),
        ("backward", backward, -thruster.limits[0], "0 at least"),
    ]
    errors = []
    for side, curve, end, zero_limit in sides:
        if end == 0.0:
            continue
        if thruster.dead_zone >= end:
            return [
                f"{owner}: dead zone is {thruster.dead_zone:g}; expected below {end:g}, the limit "
                f"of a {side} command: none gives thrust"
            ]
        sizes = np.linspace(0.0, end - thruster.dead_zone, 1001)
        thrusts = np.polynomial.polynomial.polyval(sizes, (0.0, *curve))  # (1001,) [N]
        peaks = np.maximum.accumulate(thrusts)
        if thrusts.max() > MAX_THRUST:
            errors.append(
                f"{owner}: {side} gives {thrusts.max():.3g} N; expected at most {MAX_THRUST:g} N, "
                "twice the thrust of the largest ships"
            )
        index = int(np.argmax(peaks - thrusts))
        if not thrusts[-1] > 0.0:
            errors.append(
                f"{owner}: {side} gives {thrusts[-1]:g} N at the limit {end:g}; expected more than "
                f"0. A propeller with reverse thrust needs another direction, one that does not "
                f"run {side} the limit {zero_limit}"
            )
        elif peaks[index] - thrusts[index] > MAX_THRUST_DROP * peaks[-1]:
            command = sizes[index] + thruster.dead_zone
            errors.append(
                f"{owner}: {side} falls from {peaks[index]:.4g} N to {thrusts[index]:.4g} N at the "
                f"command {command:.3g}; expected thrust that grows with the command"
            )
        if thruster.backward is None and thruster.limits[0] == -thruster.limits[1]:
            break  # both sides are equal
    return errors


def inertia_errors(owner: str, inertia: Numbers) -> list[str]:
    """Return the errors in an inertia, xx yy zz xy xz yz [kg m2].

    Args:
        owner: the name of the body in messages.
        inertia: the six numbers.
    """
    if len(inertia) != 6:
        return [f"{owner}: inertia has {len(inertia)} numbers; expected xx yy zz xy xz yz"]
    xx, yy, zz, xy, xz, yz = inertia
    moments = np.linalg.eigvalsh(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]))
    if not moments[0] > MIN_INERTIA:
        return [
            f"{owner}: inertia has the least principal moment {moments[0]:g}; "
            f"expected > {MIN_INERTIA:g} [kg m2]"
        ]
    if moments[2] > (moments[0] + moments[1]) * (1.0 + 1e-6):
        return [
            f"{owner}: inertia has the principal moments {text_of(moments)}; no body can have one "
            "above the sum of the two others"
        ]
    return []
