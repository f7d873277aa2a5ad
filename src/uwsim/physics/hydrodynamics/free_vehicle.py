"""A vehicle without moving joints as the numbers of `kernel.free_step`, and its simulation."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, rotation_from_quaternion
from ...base.numerics.linear import product, rotate
from . import columns as c
from .hydrodynamics import NoWater
from .kernel.free_step import POSE, RIGID_BODY, FreeVehicle


def free_vehicle(model: mujoco.MjModel, root: int) -> FreeVehicle:
    """Return the numbers of a free vehicle of a compiled model; joints keep their zero positions.

    Args:
        model: a model with hydrodynamics.
        root: the MuJoCo ID of the vehicle's base.

    Raises:
        NoWater: the model has no hydrodynamics, or the integrator RK4.
    """
    if model.nuser_body != c.BODY_COLUMNS or model.body_user[0, c.MAGIC] != c.MAGIC_NUMBER:
        raise NoWater("The model has no hydrodynamics.")
    if model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4:
        raise NoWater("A free vehicle is simulated by the midpoint rule, not by RK4.")
    parts = [i for i in range(model.nbody) if model.body_rootid[i] == root]
    poses = _find_poses(model, root, parts)
    bodies, actuators = links_in_water(model, root), actuators_in_water(model, root)
    sites = [int(model.actuator_trnid[i, 0]) for i in actuators]
    limits = [
        model.actuator_ctrlrange[i]
        if model.actuator_user[i, c.ROLE] == c.PROPELLER
        else (-np.inf, np.inf)
        for i in actuators
    ]
    return FreeVehicle(
        rigid_body=_combine_rigid_bodies(model, poses),
        bodies=np.array(model.body_user[bodies]).reshape(-1, c.BODY_COLUMNS),
        poses=_to_rows([poses[i] for i in bodies]),
        actuators=np.array(model.actuator_user[actuators]).reshape(-1, c.ACTUATOR_COLUMNS),
        sites=_to_rows([_site_pose(model, i, poses) for i in sites]),
        limits=np.array(limits, dtype=np.float64).reshape(-1, 2),
        gravity=np.array(model.opt.gravity),
        density=float(model.body_user[0, c.DENSITY]),
        world=np.array(model.body_user[0]),
        actuator_links=_find_links(bodies, [int(model.site_bodyid[i]) for i in sites]),
    )


def links_in_water(model: mujoco.MjModel, root: int) -> list[int]:
    """Return the MuJoCo IDs of the links with hydrodynamics, in the order of `FreeVehicle`."""
    return [
        i
        for i in range(model.nbody)
        if model.body_rootid[i] == root and model.body_user[i, c.KIND] != c.DRY_BODY
    ]


def actuators_in_water(model: mujoco.MjModel, root: int) -> list[int]:
    """Return the MuJoCo IDs of the thrusters and fins, in the order of `FreeVehicle`."""
    return [
        i
        for i in range(model.nactuator)
        if model.actuator_user[i, c.ROLE] != c.NO_ROLE
        and model.body_rootid[model.site_bodyid[model.actuator_trnid[i, 0]]] == root
    ]


def _find_links(links: Sequence[int], parts: Sequence[int]) -> npt.NDArray[np.int64]:
    """Return the index of each part among the links in the water; -1 if it is none of them."""
    return np.array([links.index(i) if i in links else -1 for i in parts], dtype=np.int64)


_Pose = tuple[Array, Array]  # position (3,) [m] and rotation (3, 3)


def _find_poses(model: mujoco.MjModel, root: int, parts: Sequence[int]) -> dict[int, _Pose]:
    """Return the pose of each link in the base; parents have smaller IDs than their children."""
    poses: dict[int, _Pose] = {root: (np.zeros(3), np.eye(3))}
    for i in parts:
        if i == root:
            continue
        position, rotation = poses[int(model.body_parentid[i])]
        poses[i] = (
            position + rotate(rotation, model.body_pos[i]),
            product(rotation, rotation_from_quaternion(model.body_quat[i])),
        )
    return poses


def _site_pose(model: mujoco.MjModel, site: int, poses: dict[int, _Pose]) -> _Pose:
    position, rotation = poses[int(model.site_bodyid[site])]
    return (
        position + rotate(rotation, model.site_pos[site]),
        product(rotation, rotation_from_quaternion(model.site_quat[site])),
    )


def _to_rows(poses: Sequence[_Pose]) -> Array:
    rows = [np.concatenate([position, rotation.ravel()]) for position, rotation in poses]
    return np.array(rows, dtype=np.float64).reshape(-1, POSE)


def _combine_rigid_bodies(model: mujoco.MjModel, poses: dict[int, _Pose]) -> Array:
    """Return the mass, the centre of mass and the inertia about it of all links together."""
    mass, moment, inertia = 0.0, np.zeros(3), np.zeros((3, 3))
    for i, (position, rotation) in poses.items():
        centre = position + rotate(rotation, model.body_ipos[i])
        axes = product(rotation, rotation_from_quaternion(model.body_iquat[i]))
        mass += float(model.body_mass[i])
        moment += model.body_mass[i] * centre
        inertia += product(axes * model.body_inertia[i], axes.T)
        inertia += model.body_mass[i] * _spread(centre)
    centre = moment / mass
    inertia -= mass * _spread(centre)
    rigid_body = np.zeros(RIGID_BODY)
    rigid_body[0], rigid_body[1:4] = mass, centre
    rigid_body[4:] = inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    return rigid_body


def _spread(point: Array) -> Array:
    """Return the inertia of a unit mass at a point, (3, 3) [m2]."""
    spread: Array = float((point * point).sum()) * np.eye(3) - np.outer(point, point)
    return spread
