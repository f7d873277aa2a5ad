"""The waves of a scene: a sum of wave systems, evaluated at points of W."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..base.geometry import Array, Pose
from ..base.numerics.calls import CompiledFunction, address_of, function_address
from ..base.numerics.elementwise import arctan2, exp
from ..base.numerics.jit import njit
from ..base.numerics.linear import product
from ..currents import SceneContext
from ..errors import UwsimError
from . import kernel as k
from .components import WaveComponents
from .dispersion import wave_numbers
from .wave_system import SeaSettings, WaveSystemSpec, find_sea_errors


@dataclass(frozen=True, kw_only=True, eq=False)
class WaterUnderWaves:
    """The surface above some points, and the motion of the water there, in W."""

    elevation: Array
    """The elevation of the surface above its still height, (n,) [m]."""
    slope: Array
    """The slopes of the surface along x and y, (n, 2) [1]."""
    velocity: Array
    """The orbital velocity, (n, 3) [m/s]."""
    acceleration: Array
    """The local rate of change of the velocity, (n, 3) [m/s2]."""
    gradient: Array
    """The velocity gradient, rows are components, (n, 3, 3) [1/s]; symmetric, without trace."""
    dynamic_pressure: Array
    """The dynamic pressure over the density of the water, (n,) [m2/s2]."""


class Waves:
    """The waves of a scene, in W. They are a function of position and time alone.

    Args:
        components: the components, in L.
        depth: the depth of the water [m].
        world_from_localized: W from L.
        surface_height: the height of the still surface in W [m].
        scale: the factor on all amplitudes, (1,), which may change [1].
    """

    def __init__(
        self,
        components: WaveComponents,
        depth: float,
        world_from_localized: Pose,
        surface_height: float,
        scale: Array,
    ) -> None:
        self._scale = scale
        self._columns = _world_columns(components, depth, world_from_localized)
        self.significant_height = components.significant_height
        """The significant wave height as the scene states it [m]."""
        self.record = np.zeros(1, k.WAVES)
        """The waves for compiled code: a record of `kernel.WAVES`, (1,)."""
        self.record["n"], self.record["columns"] = len(components), address_of(self._columns)
        self.record["surface"], self.record["depth"] = surface_height, depth
        self.record["scale"] = address_of(scale)

    @property
    def components(self) -> tuple[Array, Array, Array, Array, Array]:
        """The components in W before the factor on amplitudes, each (n,).

        They are the amplitude [m], the angular frequency [rad/s], the phase at the origin at time 0
        [rad], and the wave numbers along x and y [rad/m].
        """
        columns = self._columns
        rows = k.AMPLITUDE, k.OMEGA, k.PHASE, k.KX, k.KY
        amplitude, omega, phase, kx, ky = (columns[row].copy() for row in rows)
        return amplitude, omega, phase, kx, ky

    def motion(self, points: Array, time: float) -> WaterUnderWaves:
        """Compute the surface and the motion of the water at some points.

        Args:
            points: the points in W, (n, 3) [m].
            time: the simulation time [s].
        """
        rows = _compute_rows(self.record, np.ascontiguousarray(points, dtype=np.float64), time)
        xx, xy, yy, xz, yz = rows[:, k.GRADIENT : k.PRESSURE].T
        gradient = np.stack([xx, xy, xz, xy, yy, yz, xz, yz, -xx - yy], axis=1)
        return WaterUnderWaves(
            elevation=rows[:, k.ELEVATION],
            slope=rows[:, k.SLOPE : k.VELOCITY],
            velocity=rows[:, k.VELOCITY : k.ACCELERATION],
            acceleration=rows[:, k.ACCELERATION : k.GRADIENT],
            gradient=gradient.reshape(-1, 3, 3),
            dynamic_pressure=rows[:, k.PRESSURE],
        )

    def elevation(self, points: Array, time: float) -> Array:
        """Compute the elevation of the surface above some points.

        Args:
            points: the points in W, (n, 2) or (n, 3) [m].
            time: the simulation time [s].

        Returns:
            The elevations above the still surface, (n,) [m].
        """
        return _compute_elevations(self.record, np.ascontiguousarray(points, np.float64), time)

    @functools.cached_property
    def surface_function(self) -> CompiledFunction:
        """The function `kernel.write_surface` of these waves."""
        return CompiledFunction(
            addresses=(function_address(k.write_surface), address_of(self.record)),
            memory_owners=(self,),
        )


def _world_columns(components: WaveComponents, depth: float, world_from_localized: Pose) -> Array:
    """Return the columns of `kernel.WAVES` from components in L.

    The horizontal axes of L may be turned and mirrored against those of W, but not tilted: a tilted
    one is projected onto the horizontal plane.
    """
    directions = np.stack(
        [
            np.cos(components.direction),
            np.sin(components.direction),
            np.zeros(len(components)),
        ],
        axis=1,
    )
    travel = product(directions, world_from_localized.rotation.T)
    angle = arctan2(travel[:, 1], travel[:, 0])
    omega = components.angular_frequency
    number = wave_numbers(omega, depth)
    columns = np.empty((k.N_COLUMNS, len(components)))
    columns[k.AMPLITUDE], columns[k.OMEGA], columns[k.K] = components.amplitude, omega, number
    columns[k.UNIT_X], columns[k.UNIT_Y] = np.cos(angle), np.sin(angle)
    columns[k.KX], columns[k.KY] = number * columns[k.UNIT_X], number * columns[k.UNIT_Y]
    origin = world_from_localized.position
    columns[k.PHASE] = components.phase - columns[k.KX] * origin[0] - columns[k.KY] * origin[1]
    columns[k.SPEED] = omega / number
    columns[k.DECAY] = exp(-2.0 * number * depth)
    columns[k.FACTOR] = omega / (1.0 - columns[k.DECAY])
    return columns


@njit
def _compute_rows(record: Any, points: Array, time: float) -> Array:
    rows = np.empty((len(points), k.N_VALUES))
    for i in range(len(points)):
        rows[i] = k.compute_wave_motion(record[0], points[i, 0], points[i, 1], points[i, 2], time)
    return rows


@njit
def _compute_elevations(record: Any, points: Array, time: float) -> Array:
    elevations = np.empty(len(points))
    for i in range(len(points)):
        elevations[i] = k.compute_elevation(record[0], points[i, 0], points[i, 1], time)
    return elevations


def bind_waves(
    specs: Sequence[WaveSystemSpec], sea: SeaSettings, context: SceneContext, scale: Array
) -> Waves | None:
    """Return the waves of a scene; None without wave systems.

    Args:
        specs: the wave systems.
        sea: the settings of the sea.
        context: the properties of the scene.
        scale: the factor on all amplitudes, (1,), which may change [1].

    Raises:
        UwsimError: the sea has settings that the wave systems cannot use.

    Wave system number i draws from the random stream ``scene/waves/i``.
    """
    if not specs:
        return None
    for error in find_sea_errors(specs, sea):
        raise UwsimError(f"In <oceanState>, {error}.")
    systems = [
        spec.components(sea, context.stream(f"scene/waves/{i}")) for i, spec in enumerate(specs)
    ]
    return Waves(
        WaveComponents.concatenate(systems),
        sea.depth,
        context.world_from_localized,
        context.surface_height,
        scale,
    )
