"""The numbers of a vehicle with the parameters of one episode: mass, volume, drag, thrust, lag."""

from __future__ import annotations

from ...base.numerics.jit import njit, njit_borrowed
from ...base.numerics.memory import Floats
from ...physics.hydrodynamics import columns as h
from ...physics.hydrodynamics.kernel.free_step import FreeVehicle
from . import columns as c


@njit
def vehicle_of_row(vehicles: FreeVehicle, k: int) -> FreeVehicle:
    """Return the numbers of one of several vehicles."""
    return FreeVehicle(
        vehicles.rigid_body[k],
        vehicles.bodies[k],
        vehicles.poses,
        vehicles.actuators[k],
        vehicles.sites,
        vehicles.limits,
        vehicles.gravity,
        vehicles.world,
        vehicles.actuator_links,
        vehicles.density,
    )


@njit_borrowed
def vary_vehicle(nominal_vehicle: FreeVehicle, parameters: Floats, vehicle: FreeVehicle) -> None:
    """Write the numbers of a vehicle times the factors of an episode.

    The moments of inertia are proportional to the mass; drag includes lift.

    Args:
        nominal_vehicle: the numbers of the nominal vehicle.
        parameters: the parameters of the episode (`columns`), (p,).
        vehicle: receives the numbers.
    """
    mass = parameters[c.MASS]
    for i in range(len(nominal_vehicle.rigid_body)):
        is_centre = 1 <= i <= 3
        vehicle.rigid_body[i] = nominal_vehicle.rigid_body[i] * (1.0 if is_centre else mass)
    for part in range(len(nominal_vehicle.bodies)):
        row, source = vehicle.bodies[part], nominal_vehicle.bodies[part]
        row[h.DISPLACED_MASS] = parameters[c.VOLUME] * source[h.DISPLACED_MASS]
        for i in range(36):
            row[h.M_A + i] = parameters[c.ADDED_MASS] * source[h.M_A + i]
        for i in range(h.LINEAR, h.BODY_COLUMNS):
            row[i] = parameters[c.DRAG] * source[i]
    for k in range(len(nominal_vehicle.actuators)):
        row, source = vehicle.actuators[k], nominal_vehicle.actuators[k]
        row[h.LAG] = parameters[c.TIME_CONSTANT] * source[h.LAG]
        if row[h.ROLE] != h.PROPELLER:
            continue
        row[h.MIN_THRUST] = parameters[c.THRUST] * source[h.MIN_THRUST]
        row[h.MAX_THRUST] = parameters[c.THRUST] * source[h.MAX_THRUST]
        for i in range(h.CURVE_TERMS):
            row[h.FORWARD + i] = parameters[c.THRUST] * source[h.FORWARD + i]
            row[h.BACKWARD + i] = parameters[c.THRUST] * source[h.BACKWARD + i]
