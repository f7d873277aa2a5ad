r"""Weight, buoyancy and hydrostatic stiffness of a vehicle.

A submerged vehicle whose centre of buoyancy is a height h above its centre of mass has, at a roll
or pitch angle :math:`\theta`, the righting moment

.. math:: \rho g \nabla h \sin\theta

with the density :math:`\rho`, the gravity g and the displaced volume :math:`\nabla` (Fossen,
*Handbook of Marine Craft*, 2011, section 4.1). Joints have the values in the scene file. Not
modelled: the effect of arm motion, the waterplane at the surface.
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
    """The mass, the displaced mass and their centres, for a vehicle with all its links."""

    mass: float
    """The mass [kg]."""
    centre_of_mass: Array
    """The centre of mass in the base's frame, (3,) [m]."""
    displaced_mass: float
    """The mass of the displaced water of the fully submerged vehicle [kg]."""
    centre_of_buoyancy: Array
    """The centre of buoyancy in the base's frame, (3,) [m]."""

    @property
    def buoyancy(self) -> float:
        """The net buoyancy: buoyancy minus weight, positive upwards [N]."""
        return GRAVITY * (self.displaced_mass - self.mass)

    def stiffness(self, up: Array) -> float:
        """Compute the righting moment per angle [N m/rad]; if negative, the vehicle capsizes.

        Args:
            up: the z axis of W in the base's frame, a unit vector (3,).
        """
        height = dot(self.centre_of_buoyancy - self.centre_of_mass, up)
        return float(GRAVITY * self.displaced_mass * height)


def balance_of(
    robot: RobotSpec, dynamics: VehicleHydrodynamics, joint_values: Sequence[float] = ()
) -> Balance:
    """Compute the balance of a vehicle from its links.

    Args:
        robot: the links of the vehicle.
        dynamics: the hydrodynamics of the vehicle; masses in it replace those of the robot.
        joint_values: the joint vector [rad or m]; missing values are 0.
    """
    poses = link_poses(robot, joint_values)
    masses, volumes = [0.0], [0.0]
    mass_centres, volume_centres = [np.zeros(3)], [np.zeros(3)]
    for link in robot.links:
        body = dynamics.body(link.name)
        mass = link.mass if body is None or body.mass is None else body.mass
        centre = link.centre_of_mass
        if body is not None and body.centre_of_mass is not None:
            centre = body.centre_of_mass
        masses.append(mass)
        mass_centres.append(_transform_point(poses[link.name], centre))
        if body is not None:
            volumes.append(body.volume)
            volume_centres.append(_transform_point(poses[link.name], body.centre_of_buoyancy))
    return Balance(
        mass=sum(masses),
        centre_of_mass=_mean(masses, mass_centres),
        displaced_mass=dynamics.density * sum(volumes),
        centre_of_buoyancy=_mean(volumes, volume_centres),
    )


def _transform_point(base_from_link: Pose, point: tuple[float, float, float]) -> Array:
    position: Array = base_from_link.transform(np.array([point]))[0]
    return position


def _mean(weights: Sequence[float], points: Sequence[Array]) -> Array:
    total = sum(weights)
    if not total > 0.0:
        return np.zeros(3)
    mean: Array = product(np.array(weights), np.array(points)) / total
    return mean
