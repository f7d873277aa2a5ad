"""Warnings about what the autopilots of a scene cannot do."""

from __future__ import annotations

import numpy as np

from ...base.numerics.linear import length, product
from ...devices.battery import BatterySpec
from ...physics.actuation.allocation import (
    AXES,
    HEAVE,
    LEAN,
    MIN_LEVER,
    PITCH,
    SURGE,
    SWAY,
    UNITS,
    YAW,
    Allocation,
    allocate,
    thrusters_on_base,
)
from ...physics.actuation.power import greatest_power
from .vehicles import Candidate

WANTED = (SURGE, SWAY, HEAVE, YAW)
"""What an autopilot holds a place with."""
HELD_BY = {SWAY: "sway", HEAVE: "depth (heave)", YAW: "heading (yaw)", SURGE: "surge"}


def thrust_said(one: Candidate) -> str:
    """Report what the thrusters of a simulated vehicle cannot do; empty if nothing.

    Axes that they cannot drive, and thrusts that no battery of the vehicle can feed.
    """
    messages = [limits_said(allocation_of(one))]
    dynamics = one.dynamics
    greatest = sum(greatest_power(each, dynamics.density) for each in dynamics.thrusters)
    for battery in one.vehicle.parts_of(BatterySpec):
        if greatest + battery.hotel_load > battery.max_load:
            messages.append(
                f"the battery {battery.name!r} feeds {battery.max_load:.4g} W at most, and "
                f"all thrusters draw up to {greatest:.4g} W: they then give less thrust; "
                "expected a higher <voltage> or a lower <resistance>"
            )
    return "; ".join(filter(None, messages))


def allocation_of(one: Candidate) -> Allocation:
    """The thrust allocation of a vehicle at its start."""
    body = one.dynamics.body(one.robot.root)
    reference = np.array(body.reference if body else (0.0, 0.0, 0.0))
    thrusters = thrusters_on_base(one.robot, one.dynamics.thrusters, one.vehicle.joint_values)
    return allocate(thrusters, reference, one.balance.stiffness(one.up))


def limits_said(found: Allocation) -> str:
    """Describe the limits of an allocation; empty where there are none."""
    if not found.wrenches.shape[1]:
        return "it has no thrusters: it drifts"
    missing = [axis for axis in WANTED if axis not in found.axes]
    short = [axis for axis in found.axes if found.reach(axis) != found.full_reach(axis)]
    messages = []
    if missing:
        reached = [_reach(found, axis) for axis in found.axes]
        messages.append(
            f"its thrusters ({found.wrenches.shape[1]}) drive {', '.join(reached) or 'nothing'}; "
            "expected surge, sway, heave and yaw. "
            f"Not held: {', '.join(HELD_BY[axis] for axis in missing)}"
        )
        messages += [_together(found, axis) for axis in missing if _is_coupled(found, axis)]
    if HEAVE in missing and PITCH in found.axes:
        messages.append("depth is held by pitching while it moves ahead")
    for axis in short:
        there, full = max(found.reach(axis)), max(found.full_reach(axis))
        messages.append(
            f"{AXES[axis]} is asked for up to {there:.3g} N of {full:.3g} N, beyond which the hull "
            f"would lean by more than {np.degrees(LEAN):.0f} degrees"
        )
    return "; ".join(messages)


def _reach(found: Allocation, axis: int) -> str:
    least, greatest = found.reach(axis)
    return f"{AXES[axis]} ({least:.3g} to {greatest:.3g} {UNITS[axis]})"


def _is_coupled(found: Allocation, axis: int) -> bool:
    return bool(length(found.wrenches[axis]) > MIN_LEVER)


def _together(found: Allocation, axis: int) -> str:
    """Report the driven axes to which an axis is coupled."""
    shares = product(found.wrenches[axis], found.share)  # of each driven axis
    bound = [AXES[a] for a, share in zip(found.axes, shares, strict=True) if abs(share) > 1e-3]
    return f"{AXES[axis]} comes only together with {' and '.join(bound)}"
