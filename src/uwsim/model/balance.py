r"""Weight, buoyancy and hydrostatic stiffness of a vehicle.

A hull whose centre of buoyancy lies a height h above its centre of mass rights itself: leaning by
an angle it feels the moment

.. math:: \rho g \nabla h \sin\theta

with the volume :math:`\nabla` (Fossen, *Handbook of Marine Craft*, 2011, section 4.1). Joints are
as the file says. Not modelled: how an arm that moves shifts it, the waterplane at the surface.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base.geometry import Array, Pose
from ..base.numerics.linear import dot, product
from ..scene.hydrodynamics.spec import VehicleHydrodynamics
from ..scene.urdf.kinematics import link_poses
from ..scene.urdf.robot import RobotSpec
from ..world import GRAVITY


@dataclass(frozen=True, eq=False, kw_only=True)
class Balance:
    """Weight and buoyancy of a vehicle with all its links."""

    mass: float
    """[kg]"""
    centre_of_mass: Array
    """In the base's frame, (3,) [m]."""
    displaced: float
    """Water, fully submerged [kg]."""
    centre_of_buoyancy: Array
    """In the base's frame, (3,) [m]."""

    @property
    def buoyancy(self) -> float:
        """Net buoyancy: buoyancy less weight, upwards [N]."""
        return GRAVITY * (self.displaced - self.mass)

    def stiffness(self, up: Array) -> float:
        """Moment per angle with which it rights itself; below 0 it turns over [N m/rad].

        Args:
            up: W's z in the base's frame, (3,).
        """
        height = dot(self.centre_of_buoyancy - self.centre_of_mass, up)
        return float(GRAVITY * self.displaced * height)


def balance_of(
    robot: RobotSpec, dynamics: VehicleHydrodynamics, joint_values: Sequence[float] = ()
) -> Balance:
    """Add up the links of a vehicle.

    Args:
        robot: its links.
        dynamics: what the water does to them; its masses replace those of the robot.
        joint_values: its joints [rad or m].
    """
    poses = link_poses(robot, joint_values)
    masses, volumes = [0.0], [0.0]
    of_mass, of_volume = [np.zeros(3)], [np.zeros(3)]
    for link in robot.links:
        body = dynamics.body(link.name)
        own = link.mass if body is None or body.mass is None else body.mass
        middle = link.centre_of_mass
        if body is not None and body.centre_of_mass is not None:
            middle = body.centre_of_mass
        masses.append(own)
        of_mass.append(_at(poses[link.name], middle))
        if body is not None:
            volumes.append(body.volume)
            of_volume.append(_at(poses[link.name], body.centre_of_buoyancy))
    return Balance(
        mass=sum(masses),
        centre_of_mass=_mean(masses, of_mass),
        displaced=dynamics.density * sum(volumes),
        centre_of_buoyancy=_mean(volumes, of_volume),
    )


def _at(base_from_link: Pose, point: tuple[float, float, float]) -> Array:
    place: Array = base_from_link.transform(np.array([point]))[0]
    return place


def _mean(weights: Sequence[float], points: Sequence[Array]) -> Array:
    total = sum(weights)
    if not total > 0.0:
        return np.zeros(3)
    mean: Array = product(np.array(weights), np.array(points)) / total
    return mean
