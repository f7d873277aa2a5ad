"""Checks of the numbers of bodies and thrusters."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...errors import did_you_mean
from ...schema import Numbers
from .number_checks import beyond_limits, listed, number_errors, words
from .passivity import Kind, bearable_share, driving_motion
from .spec import (
    LIQUIDS,
    MAX_POINTS,
    N_CURVE,
    SIZES,
    BodyHydrodynamics,
    ThrusterSpec,
    matrix,
)

MIN_INERTIA = 1e-12
"""What the engine still takes for one [kg m2]."""
SAG = 0.02
"""A measured thrust curve, or the polynomial through it, may fall by this share of its greatest
thrust."""
MAX_THRUST = 1e7
"""Of a propeller [N]."""
DRAG: dict[str, Kind] = {"linear_damping": "linear", "quadratic_damping": "quadratic"}


def body_errors(body: BodyHydrodynamics) -> list[str]:
    """Return every error in the numbers of a body."""
    who = f"link {body.link!r}"
    if errors := number_errors(who, body):
        return errors
    for name in ("added_mass", "body_lift", *DRAG):
        numbers: Numbers = getattr(body, name)
        if len(numbers) not in (6, 36):
            errors.append(f"{who}: {words(name)} has {len(numbers)} numbers; expected 6 or 36")
        elif name == "body_lift":
            errors += _lift_errors(who, matrix(numbers))
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
        errors += inertia_errors(who, body.inertia)
    return errors + beyond_limits(who, body)


def thruster_errors(thruster: ThrusterSpec) -> list[str]:
    """Return every error in the numbers of a thruster."""
    who = f"thruster {thruster.name!r}"
    if errors := number_errors(who, thruster):
        return errors
    if not math.hypot(*thruster.direction) > 1e-9:
        errors.append(f"{who}: direction is 0 0 0; expected a direction")
    for side in ("forward", "backward", "power", "power_backward"):
        curve = getattr(thruster, side)
        if curve is not None and not 1 <= len(curve) <= N_CURVE:
            errors.append(
                f"{who}: {words(side)} has {len(curve)} coefficients; expected 1 to {N_CURVE}"
            )
    if thruster.power is None and thruster.power_backward is not None:
        errors.append(f"{who}: power backward is given without power")
    if thruster.efficiency is not None and thruster.power is not None:
        errors.append(f"{who}: <efficiency> and <power> both say what it draws; give one")
    for name in ("limits", "saturation"):
        ends = getattr(thruster, name)
        if ends is not None and not (ends[0] <= 0.0 <= ends[1] and ends[0] < ends[1]):
            errors.append(
                f"{who}: {name} are {listed(ends)}; expected least <= 0 <= greatest, not both 0"
            )
    errors += beyond_limits(who, thruster)
    if abs(thruster.torque) > 2.0 * thruster.radius > 0.0:
        errors.append(
            f"{who}: torque is {thruster.torque:g} per thrust; expected at most the propeller's "
            f"diameter, {2.0 * thruster.radius:g} [m]"
        )
    errors += _advance_errors(who, thruster.advance)
    return errors or _thrust_errors(who, thruster)


def density_errors(density: float) -> list[str]:
    """Return every error in the density of the water."""
    if LIQUIDS[0] <= density <= LIQUIDS[1]:
        return []
    return [
        f"density is {density:g}; expected that of a liquid, {LIQUIDS[0]:g} to {LIQUIDS[1]:g} "
        "(fresh water 1000, sea water 1025) [kg/m3]"
    ]


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
            f"{who}: {words(name)} has the diagonal {listed(np.diag(drag))}; "
            "expected none below 0 (drag opposes motion with positive coefficients)"
        ]
    driving = driving_motion(DRAG[name], drag)
    if driving is None:
        return []
    motion, power = driving
    share = bearable_share(DRAG[name], drag)
    bearable = f"at most {share:.2f} times as large" if share > 0.0 else "0 where that is 0"
    return [
        f"{who}: {words(name)} drives the body: at the velocity "
        f"{listed(np.round(motion, 3) + 0.0)} [m/s, rad/s] it gives it {power:.3g} W; expected "
        f"drag that only takes energy: entries beside this diagonal {bearable}"
    ]


def _lift_errors(who: str, lift: Array) -> list[str]:
    if min(np.diag(lift)) >= 0.0:
        return []
    return [
        f"{who}: body lift has the diagonal {listed(np.diag(lift))}; expected none below 0 (lift "
        "opposes motion across the hull with positive coefficients)"
    ]


def _advance_errors(who: str, advance: Numbers) -> list[str]:
    """Return every error in the curve of the thrust over the advance ratio."""
    if not advance:
        return []
    if len(advance) % 2 or not 4 <= len(advance) <= 2 * MAX_POINTS:
        return [
            f"{who}: advance has {len(advance)} numbers; expected 2 to {MAX_POINTS} pairs of "
            "advance ratio and thrust coefficient"
        ]
    ratios, factors = np.reshape(advance, (-1, 2)).T
    if ratios[0] != 0.0 or not np.all(np.diff(ratios) > 0.0):
        return [f"{who}: advance has the ratios {listed(ratios)}; expected 0 first, rising"]
    if not factors[0] > 0.0:
        return [f"{who}: advance has KT {factors[0]:g} at rest; expected > 0"]
    if np.any(np.diff(factors) > 0.0):
        return [f"{who}: advance has the KT {listed(factors)}; expected none above the one before"]
    return []


def _thrust_errors(who: str, thruster: ThrusterSpec) -> list[str]:
    """Report where the thrust curve does not rise."""
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


def inertia_errors(who: str, inertia: Numbers) -> list[str]:
    """Return what is wrong with the inertia xx yy zz xy xz yz of ``who`` [kg m2]."""
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
            f"{who}: inertia has the principal moments {listed(principal)}; no body can have one "
            "above the sum of the two others"
        ]
    return []
