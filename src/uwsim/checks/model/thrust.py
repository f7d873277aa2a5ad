"""Warnings about axes that the thrusters of a vehicle cannot drive, and about lack of power."""

from __future__ import annotations

import numpy as np

from ...base.numerics.linear import length, product
from ...devices.battery import BatterySpec
from ...physics.actuation.allocation import (
    AXES,
    HEAVE,
    MAX_TILT,
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
from .vehicles import DynamicVehicle

STATION_AXES = (SURGE, SWAY, HEAVE, YAW)
"""The axes that an autopilot needs for station keeping."""
AXIS_LABELS = {SWAY: "sway", HEAVE: "depth (heave)", YAW: "heading (yaw)", SURGE: "surge"}


def describe_thrust(vehicle: DynamicVehicle) -> str:
    """Describe the limits of the thrusters of a vehicle; empty if there are none.

    Limits are axes that the thrusters cannot drive, and power that a battery cannot supply.
    """
    messages = [describe_limits(allocation_of(vehicle))]
    dynamics = vehicle.dynamics
    max_power = sum(greatest_power(thruster, dynamics.density) for thruster in dynamics.thrusters)
    for battery in vehicle.spec.parts_of(BatterySpec):
        if max_power + battery.hotel_load > battery.max_load:
            messages.append(
                f"the battery {battery.name!r} supplies {battery.max_load:.4g} W at most, and "
                f"all thrusters draw up to {max_power:.4g} W. They then give less thrust; "
                "expected a higher <voltage> or a lower <resistance>"
            )
    return "; ".join(filter(None, messages))


def allocation_of(vehicle: DynamicVehicle) -> Allocation:
    """Compute the thrust allocation of a vehicle at its start attitude."""
    body = vehicle.dynamics.body(vehicle.robot.root)
    reference = np.array(body.reference if body else (0.0, 0.0, 0.0))
    values = vehicle.spec.joint_values
    thrusters = thrusters_on_base(vehicle.robot, vehicle.dynamics.thrusters, values)
    return allocate(thrusters, reference, vehicle.balance.stiffness(vehicle.up))


def describe_limits(allocation: Allocation) -> str:
    """Describe the limits of an allocation; empty if there are none."""
    if not allocation.wrenches.shape[1]:
        return "it has no thrusters: it drifts"
    missing_axes = [axis for axis in STATION_AXES if axis not in allocation.axes]
    messages = []
    if missing_axes:
        ranges = ", ".join(_describe_range(allocation, axis) for axis in allocation.axes)
        messages.append(
            f"its thrusters ({allocation.wrenches.shape[1]}) drive {ranges or 'nothing'}; "
            "expected surge, sway, heave and yaw. "
            f"Not held: {', '.join(AXIS_LABELS[axis] for axis in missing_axes)}"
        )
        coupled_axes = (axis for axis in missing_axes if _is_coupled(allocation, axis))
        messages += [_describe_coupling(allocation, axis) for axis in coupled_axes]
    if HEAVE in missing_axes and PITCH in allocation.axes:
        messages.append("depth is held by pitching while it moves ahead")
    for axis in allocation.axes:
        if allocation.force_limits(axis) == allocation.thruster_limits(axis):
            continue
        limit, full_limit = (
            max(allocation.force_limits(axis)),
            max(allocation.thruster_limits(axis)),
        )
        messages.append(
            f"{AXES[axis]} is limited to {limit:.3g} N of {full_limit:.3g} N, beyond which the "
            f"hull would pitch or roll by more than {np.degrees(MAX_TILT):.0f} degrees"
        )
    return "; ".join(messages)


def _describe_range(allocation: Allocation, axis: int) -> str:
    minimum, maximum = allocation.force_limits(axis)
    return f"{AXES[axis]} ({minimum:.3g} to {maximum:.3g} {UNITS[axis]})"


def _is_coupled(allocation: Allocation, axis: int) -> bool:
    return bool(length(allocation.wrenches[axis]) > MIN_LEVER)


def _describe_coupling(allocation: Allocation, axis: int) -> str:
    # the force along the axis for a unit wrench of each driven axis
    shares = product(allocation.wrenches[axis], allocation.inverse_allocation_matrix)
    pairs = zip(allocation.axes, shares, strict=True)
    coupled_axes = [AXES[a] for a, share in pairs if abs(share) > 1e-3]
    return f"{AXES[axis]} is driven only together with {' and '.join(coupled_axes)}"
