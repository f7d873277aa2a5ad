r"""The planar mode, for surface craft: surge, sway and yaw move, heave, roll and pitch are held.

A craft at the surface is carried by the water at its hull, which the deep-water simulation of
windows does not have. In the planar mode its height, roll and pitch are held instead:

- Gravity is 0, so that neither weight, buoyancy nor a righting moment acts.
- The added mass of heave, roll and pitch is `HELD_FACTOR` times the mass and the inertia. Forces F
  of the thrusters along held axes then give velocities of :math:`F t / (10^6 m)`, below 1 mm/s.
- The measured motion is levelled: the attitude keeps its heading alone, and velocities are those of
  the levelled axes. With roll :math:`\phi` and pitch :math:`\theta`, the rate of yaw is
  :math:`(q \sin\phi + r \cos\phi) / \cos\theta`, the rate of the heading.

The equations of the plane are those of Fossen (2011, section 6.5, without roll): with the diagonals
of added mass and damping, :math:`(m + A_1) \dot u - (m + A_2) v r = X` and so on.

Not modelled: waves, wind, the change of the hull's draught and trim with the speed, and
off-diagonal terms that a hydrodynamics file does not have.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..base.geometry import Array
from ..logs import VehicleLog
from ..logs.frames import multiply_quaternions, rotate_vectors, rotate_vectors_back
from ..physics.hydrodynamics import columns as c
from .vehicle_model import VehicleModel

PLANAR_AXES = ("surge", "sway", "yaw")
"""The axes that move in the planar mode."""
HELD_AXES = (2, 3, 4)
"""The indices of the axes that are held: heave, roll, pitch."""
HELD_FACTOR = 1e6
"""The ratio of the added mass of a held axis and the mass or the inertia."""


def has_vertical_motion(logs: Sequence[VehicleLog]) -> bool:
    """Return True if a log has a depth or a velocity of heave; without any motion, too.

    A depth, a roll and a pitch that are constants of the mapping file are none.
    """
    motions = [log.motion for log in logs if log.motion is not None]
    free_motions = [motion for motion in motions if not motion.is_planar]
    columns = [motion.positions[:, 2] for motion in free_motions]
    columns += [motion.twists[:, 2] for motion in free_motions if motion.twists is not None]
    return not motions or any(bool(np.isfinite(column).any()) for column in columns)


def hold_vertical(model: VehicleModel) -> VehicleModel:
    """Return the vehicle of the planar mode."""
    numbers = model.numbers._replace(
        bodies=model.numbers.bodies.copy(), gravity=np.zeros_like(model.numbers.gravity)
    )
    mass, inertia = float(numbers.rigid_body[0]), numbers.rigid_body[4:7]
    sizes = (mass, float(inertia[0]), float(inertia[1]))
    for axis, size in zip(HELD_AXES, sizes, strict=True):
        numbers.bodies[model.part, c.M_A + 7 * axis] = HELD_FACTOR * max(size, 1e-3 * mass)
    return replace(model, numbers=numbers, is_planar=True)


def level_motion(rows: Array) -> Array:
    """Return the motion of the planar mode, (n, 13), as `windows`; held columns are not measured.

    Args:
        rows: the motion in W, (n, 13); NaN where there is none.
    """
    level_rows = rows.copy()
    attitudes = rows[:, 3:7]
    headings = level_attitudes(attitudes)
    level_rows[:, 3:7] = headings
    velocities = np.where(np.isfinite(rows[:, 7:10]), rows[:, 7:10], 0.0)
    rates = np.where(np.isfinite(rows[:, 10:]), rows[:, 10:], 0.0)
    level_velocities = rotate_vectors_back(headings, rotate_vectors(attitudes, velocities))
    level_rows[:, 7:9] = np.where(np.isfinite(rows[:, 7:9]), level_velocities[:, :2], np.nan)
    down = np.zeros((len(rows), 3))
    down[:, 2] = 1.0  # the base's z axis of the levelled axes
    down_in_base = rotate_vectors_back(attitudes, rotate_vectors(headings, down))
    cosine = np.sqrt(np.maximum(1.0 - down_in_base[:, 0] ** 2, 1e-12))
    heading_rate = (down_in_base[:, 1:] * rates[:, 1:]).sum(axis=1) / (cosine * cosine)
    level_rows[:, 12] = np.where(np.isfinite(rows[:, 12]), heading_rate, np.nan)
    level_rows[:, [2, 9, 10, 11]] = np.nan
    return level_rows


def level_attitudes(attitudes: Array) -> Array:
    """Return attitudes wxyz (n, 4) whose base has the same heading and a vertical z axis."""
    is_inverted = float(np.nanmedian(1.0 - 2.0 * (attitudes[:, 1] ** 2 + attitudes[:, 2] ** 2))) < 0
    flip = np.array([0.0, 1.0, 0.0, 0.0])  # the base's z axis points down in W
    upright_attitudes = multiply_quaternions(attitudes, flip) if is_inverted else attitudes
    twists = upright_attitudes * np.array([1.0, 0.0, 0.0, 1.0])
    size = np.sqrt((twists * twists).sum(axis=1, keepdims=True))
    twists = np.where(size > 1e-9, twists / np.maximum(size, 1e-9), np.array([1.0, 0.0, 0.0, 0.0]))
    return multiply_quaternions(twists, -flip) if is_inverted else twists
