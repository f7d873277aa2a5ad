"""The motion of the water in a scene: currents, waves, and a flow that is added while it runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ...base.numerics.calls import CompiledFunction
from ...base.numerics.jit import njit
from ...base.numerics.linear import product
from ...base.record import Record
from ...currents import SceneContext, TotalCurrent, bind_currents
from ...currents.current import flow_function_of, is_steady
from ...currents.flow_function import FlowFunction
from ...errors import UwsimError
from ...model.robots import find_file
from ...model.scene_model import SceneModel
from ...physics.hydrodynamics.water_function import DriftFunction, WaterFunction
from ...scene.spec import SceneSpec
from ...waves import bind_waves
from ...world import Flow
from .drift_kernel import drift_function
from .point_kernel import point_function
from .water_kernel import SHEAR_DISTANCE, flow_function, row_function
from .wave_kernel import add_waves, add_waves_to_drift, add_waves_to_points

F = TypeVar("F")
_CachedFunction = tuple[Flow | None, Sequence[str], FlowFunction | None, F | None]
WaterRow = tuple[Array, Array, Array | None]
"""The velocity, acceleration and angular velocity of the water at n points in W, (n, 3) each; the
last is None for uniform water."""


@dataclass(slots=True)
class WaterState(Record):
    """The state of the motion of the water."""

    added_flow: Flow | None = None
    """The flow that is added to the currents of the scene; None: none."""
    wave_scale: Array = field(default_factory=lambda: np.ones(1))
    """The factor on the wave heights of the scene, (1,) [1]."""


class WaterMotion:
    """The motion of the water around the vehicles of a scene, in the world frame W.

    Currents are defined in L, the frame of the scene file.

    Args:
        scene: the spec of the scene.
        context: the properties of the scene that currents may read.
    """

    def __init__(self, scene: SceneSpec, context: SceneContext) -> None:
        specs = scene.ocean_state.currents
        self._world_from_localized = scene.world_from_localized
        self._localized_from_world = scene.world_from_localized.inverse()
        self._scene_current = bind_currents(specs, context)
        self._last_added_flow: Flow | None = None
        self._sum: Flow = self._scene_current
        self.state = WaterState()
        """The state: the added flow and the scale of the waves."""
        self.waves = bind_waves(
            scene.ocean_state.waves, scene.ocean_state.sea, context, self.state.wave_scale
        )
        """The waves; None if the surface is level."""
        # the flow and the vehicles for which the functions are valid, and the functions
        self._water_cache: _CachedFunction[WaterFunction] = None, (), None, None
        self._drift_cache: _CachedFunction[DriftFunction] = None, (), None, None
        # the function for currents alone, and the function for currents and waves
        self._wave_cache: tuple[WaterFunction | None, WaterFunction | None] = None, None
        # the flow for which the functions are valid; the functions by vehicle and number of points
        self._point_cache: tuple[Flow, dict[tuple[str, int], CompiledFunction | None]] = (
            self._sum,
            {},
        )
        self.files: dict[str, Path] = {}
        """The paths of the files that the currents read, by file name."""
        for spec in specs:
            self.files |= spec.files(context)

    def set(self, flow: Flow | None) -> None:
        """Add a flow to the currents of the scene; None removes it."""
        self.state.added_flow = flow

    def set_wave_height(self, height: float | None) -> None:
        """Set the significant wave height.

        Args:
            height: the significant wave height of all wave systems together [m]; None: the height
                in the scene file.

        Raises:
            UwsimError: the scene has no waves whose height could change.
        """
        stated_height = 0.0 if self.waves is None else self.waves.significant_height
        if height is not None and stated_height == 0.0:
            raise UwsimError(
                "The scene has no waves whose height could change; "
                "expected <u:waves> with a height above 0 in its <oceanState>."
            )
        self.state.wave_scale[0] = 1.0 if height is None else height / stated_height

    @property
    def surface_function(self) -> CompiledFunction | None:
        """The function that `uwsim.world.mounts.read_surface` calls; None for a level surface."""
        return None if self.waves is None else self.waves.surface_function

    @property
    def _flow(self) -> Flow:
        added_flow = self.state.added_flow
        if added_flow is not self._last_added_flow:
            self._last_added_flow, scene_current = added_flow, self._scene_current
            if added_flow is None:
                self._sum = scene_current
            elif scene_current.is_still:
                self._sum = added_flow
            else:
                self._sum = TotalCurrent([scene_current, added_flow])
        return self._sum

    @property
    def is_still(self) -> bool:
        """True if the water does not move at all."""
        return self._flow.is_still and self.waves is None

    def needs_positions(self, vehicles: Sequence[str]) -> bool:
        """Return whether `motion_during` needs the positions of the bodies in every step."""
        flow = self._flow
        return not (flow.is_still or flow.is_uniform or self._functions(vehicles)[0] is not None)

    def motion_during(
        self,
        positions: Callable[[], Array],
        steps: range,
        timestep: float,
        vehicles: Sequence[str],
    ) -> WaterFunction | None:
        """Return the function of the water's motion at bodies in some steps; None for still water.

        The motion is in W, and in the middle of each step.

        Args:
            positions: returns the present positions of the bodies in W, (n, 3) [m].
            steps: the numbers of the steps; only one if `needs_positions`.
            timestep: the length of a step [s].
            vehicles: the name of the vehicle of each body; empty for other bodies.
        """
        currents = self._currents_during(positions, steps, timestep, vehicles)
        waves = self.waves
        if waves is None:
            return currents
        if self._wave_cache[1] is None or self._wave_cache[0] is not currents:
            self._wave_cache = currents, add_waves(currents, waves, len(vehicles))
        return self._wave_cache[1]

    def _currents_during(
        self,
        positions: Callable[[], Array],
        steps: range,
        timestep: float,
        vehicles: Sequence[str],
    ) -> WaterFunction | None:
        """Return the function of the water's motion in currents alone; see `motion_during`."""
        flow = self._flow
        if flow.is_still:
            return None
        function, compiled_flow = self._functions(vehicles)
        if function is not None and compiled_flow is not None:
            compiled_flow.prepare(steps[-1] * timestep)
            return function
        times = [step * timestep - 0.5 * timestep for step in steps]
        if flow.is_uniform:
            sample_times = times[:1] if is_steady(flow) else times
            return row_function(self._uniform_rows(sample_times, vehicles))
        row = np.zeros((1, len(vehicles), 9))
        row[0, :, 0:3], row[0, :, 3:6], rotation = self.motion_at(positions(), times[0], vehicles)
        if rotation is not None:
            row[0, :, 6:9] = rotation
        return row_function(row)

    def drift_function(
        self, vehicles: Sequence[str], timestep: float, end: float
    ) -> DriftFunction | None:
        """Return the function that moves vehicles with the water in steps, as `drifted_pose` does.

        The result is None if Python has to compute the flow.

        Args:
            vehicles: the names of all kinematic vehicles.
            timestep: the length of a step [s].
            end: the time at the end of the last step [s].
        """
        flow, (for_flow, for_vehicles, compiled_flow, function) = self._flow, self._drift_cache
        if flow is not for_flow or vehicles != for_vehicles:
            indices, names = _index_names(vehicles)
            compiled_flow, function = flow_function_of(flow, names), None
            if compiled_flow is not None:
                function = drift_function(
                    compiled_flow, self._world_from_localized, indices, timestep
                )
            if self.waves is not None and (function is not None or flow.is_still):
                function = add_waves_to_drift(function, self.waves, len(vehicles), timestep)
            self._drift_cache = flow, vehicles, compiled_flow, function
        if compiled_flow is not None:
            compiled_flow.prepare(end)
        return function

    def _functions(
        self, vehicles: Sequence[str]
    ) -> tuple[WaterFunction | None, FlowFunction | None]:
        """Return the compiled functions of the present flow; None where Python computes it."""
        flow, (for_flow, for_vehicles, compiled_flow, function) = self._flow, self._water_cache
        if flow is not for_flow or vehicles != for_vehicles:
            indices, names = _index_names(vehicles)
            compiled_flow, function = flow_function_of(flow, names), None
            if compiled_flow is not None:
                function = flow_function(
                    compiled_flow,
                    self._localized_from_world,
                    indices,
                    is_uniform=flow.is_uniform,
                    is_steady=flow.is_uniform and is_steady(flow),
                )
            self._water_cache = flow, vehicles, compiled_flow, function
        return function, compiled_flow

    def _uniform_rows(self, times: Sequence[float], vehicles: Sequence[str]) -> Array:
        """Return the rows for `row_function` of uniform water, computed once for each vehicle."""
        indices, names = _index_names(vehicles)
        flow, points = self._flow, np.zeros((len(names), 3))
        motions = np.empty((len(times), 2, len(names), 3))
        for row, time in zip(motions, times, strict=True):
            row[0], row[1] = flow.motion(points, time, names)
        return _expand_rows(motions, indices, self._localized_from_world.rotation)

    def motion_at(self, points: Array, time: float, vehicles: Sequence[str]) -> WaterRow:
        r"""Return the motion of the water at points in currents alone, in W.

        The acceleration is the material derivative, of the water that passes a point:
        :math:`Du/Dt = \partial u/\partial t + (u \cdot \nabla) u`. The pressure in the
        accelerating water exerts the Froude-Krylov force :math:`\rho V Du/Dt` on a body.

        Args:
            points: the points in W, (n, 3) [m].
            time: the time [s].
            vehicles: the name of the vehicle of each point; empty for other points.

        Returns:
            The velocity, (n, 3) [m/s], the acceleration, (n, 3) [m/s2], and the angular velocity of
            the water, :math:`\tfrac12 \nabla \times u`, (n, 3) [rad/s]; the last is None for
            uniform water.
        """
        local_points = self._localized_from_world.transform(points)
        rotation = self._localized_from_world.rotation
        velocity, acceleration = self._flow.motion(local_points, time, vehicles)
        if self._flow.is_uniform:
            return product(velocity, rotation), product(acceleration, rotation), None
        gradient = self._gradient(local_points, time, vehicles)
        acceleration += np.einsum("nij,nj->ni", gradient, velocity)
        x, y, z = (gradient[:, j, i] - gradient[:, i, j] for i, j in ((1, 2), (2, 0), (0, 1)))
        angular_velocity = 0.5 * np.stack([x, y, z], axis=1)
        return (
            product(velocity, rotation),
            product(acceleration, rotation),
            product(angular_velocity, rotation),
        )

    def _gradient(self, points: Array, time: float, vehicles: Sequence[str]) -> Array:
        """Return the velocity gradient in L, (n, 3, 3) [1/s]: [:, k, j] is du_k / dx_j."""
        n = len(points)
        offsets = SHEAR_DISTANCE * np.concatenate([np.eye(3), -np.eye(3)])  # (6, 3) [m]
        neighbours = (points + offsets[:, None]).reshape(-1, 3)  # (6 n, 3)
        names = tuple(vehicles) * len(offsets)
        velocities = self._flow.velocity(neighbours, time, names).reshape(6, n, 3)
        slopes: Array = (velocities[:3] - velocities[3:]) / (2.0 * SHEAR_DISTANCE)  # (by j, n, i)
        return slopes.transpose(1, 2, 0)

    def velocity(self, points: Array, time: float, vehicle: str) -> Array:
        """Return the velocity of the water in W at points of W, (n, 3) [m/s].

        Args:
            points: the points in W, (n, 3) [m].
            time: the time [s].
            vehicle: the name of the vehicle of the points; some currents differ by vehicle.
        """
        velocity = np.zeros((len(points), 3))
        if not self._flow.is_still:
            local_points = self._localized_from_world.transform(points)
            velocity = self._flow.velocity(local_points, time, (vehicle,) * len(points))
            velocity = product(velocity, self._localized_from_world.rotation)
        waves = self.waves
        return velocity if waves is None else velocity + waves.motion(points, time).velocity

    def velocity_function(self, vehicle: str, n: int) -> CompiledFunction | None:
        """Return `velocity` as a compiled function; None if Python has to compute the flow.

        Args:
            vehicle: the name of the vehicle of the points.
            n: the number of points.
        """
        flow, (for_flow, functions) = self._flow, self._point_cache
        if for_flow is not flow:
            functions = {}
            self._point_cache = flow, functions
        if (vehicle, n) not in functions:
            function = None if flow.is_still else flow_function_of(flow, (vehicle,))
            needs_python = function is None and not flow.is_still
            point_velocity = (
                None if needs_python else point_function(function, self._localized_from_world, n)
            )
            if point_velocity is not None and self.waves is not None:
                point_velocity = add_waves_to_points(point_velocity, self.waves, n)
            functions[vehicle, n] = point_velocity
        return functions[vehicle, n]

    def drifted_pose(
        self, world_from_base: Pose, time: float, timestep: float, vehicle: str
    ) -> Pose:
        """Return the pose of a vehicle after a step of drifting with the water: ``p += v dt``."""
        point = self._localized_from_world.transform(world_from_base.position[None])  # (1, 3) [m]
        velocity = self._flow.velocity(point, time, (vehicle,))[0]  # (3,) [m/s]
        position = self._world_from_localized.transform(point + velocity * timestep)[0]
        waves = self.waves
        if waves is not None:
            position += waves.motion(world_from_base.position[None], time).velocity[0] * timestep
        return Pose(position, world_from_base.rotation)


def _index_names(vehicles: Sequence[str]) -> tuple[npt.NDArray[np.int64], tuple[str, ...]]:
    """Return the index of each name in the tuple of distinct names, and that tuple."""
    names = tuple(dict.fromkeys(vehicles))
    return np.array([names.index(name) for name in vehicles], dtype=np.int64), names


@njit
def _expand_rows(motions: Array, indices: npt.NDArray[np.int64], rotation: Array) -> Array:
    """Rotate velocities and accelerations (times, 2, m, 3) to W, and copy them to each point.

    Returns:
        Rows for `row_function`, (times, n, 9).
    """
    rows = np.zeros((len(motions), len(indices), 9))
    for t in range(len(motions)):
        for kind in range(2):
            for i in range(len(indices)):
                for k in range(3):
                    total = 0.0
                    for j in range(3):
                        total += motions[t, kind, indices[i], j] * rotation[j, k]
                    rows[t, i, 3 * kind + k] = total
    return rows


def water_motion(
    model: SceneModel, stream: Callable[[str], np.random.Generator], *, runs_code: bool
) -> WaterMotion:
    """Return the motion of the water in a scene.

    Args:
        model: the compiled scene.
        stream: a function that returns the random generator of a stream's name.
        runs_code: True to run the Python code to which the scene refers; False: a current that
            requires such code is zero.
    """
    scene = model.scene
    context = SceneContext(
        stream=stream,
        find=lambda name: find_file(name, scene.path, model.data_path),
        world_from_localized=scene.world_from_localized,
        runs_code=runs_code,
        surface_height=scene.ocean_state.ocean_surface_height,
    )
    return WaterMotion(scene, context)
