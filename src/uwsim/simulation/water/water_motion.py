"""The flow of a scene: its currents, and what scene updaters add."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from ...base.geometry import Array, Pose
from ...base.numerics.calls import CompiledFunction
from ...base.numerics.jit import njit
from ...base.numerics.linear import product
from ...base.record import Record
from ...currents import Place, TotalCurrent, bind_currents
from ...currents.current import flow_function_of, is_steady
from ...currents.flow_function import FlowFunction
from ...model.robots import find_file
from ...model.scene_model import SceneModel
from ...physics.hydrodynamics.water_function import DriftFunction, WaterFunction
from ...scene.spec import SceneSpec
from ...world import Flow
from .drift_kernel import of_drift
from .point_kernel import at_points
from .water_kernel import NEARBY, of_flow, of_rows

F = TypeVar("F")
_Found = tuple[Flow | None, Sequence[str], FlowFunction | None, F | None]
WaterRow = tuple[Array, Array, Array | None]
"""Velocity, acceleration and rotation of the water at some points."""


@dataclass(slots=True)
class WaterState(Record):
    """What changes of the flow."""

    added: Flow | None = None
    """What is added to the currents of the scene."""


class WaterMotion:
    """The flow that the vehicles of a scene feel, in W.

    Args:
        scene: spec of the scene.
        place: what currents may see of the scene.
    """

    def __init__(self, scene: SceneSpec, place: Place) -> None:
        specs = scene.ocean_state.currents
        self._world_from_localized = scene.world_from_localized
        self._localized_from_world = scene.world_from_localized.inverse()
        self._scene_current = bind_currents(specs, place)
        self._added: Flow | None = None
        self._sum: Flow = self._scene_current
        self.state = WaterState()
        """What changes of it."""
        # a flow, the vehicles it is felt by, and its functions
        self._felt: _Found[WaterFunction] = None, (), None, None
        self._drift: _Found[DriftFunction] = None, (), None, None
        # a flow, and its functions by the vehicle and the number of points
        self._points: tuple[Flow, dict[tuple[str, int], CompiledFunction | None]] = self._sum, {}
        self.files: dict[str, Path] = {}
        """Files that the currents read, by name."""
        for spec in specs:
            self.files |= spec.files(place)

    def set(self, current: Flow | None) -> None:
        """Add a flow to the currents of the scene; None removes it."""
        self.state.added = current

    @property
    def _flow(self) -> Flow:
        added = self.state.added
        if added is not self._added:
            self._added, scene = added, self._scene_current
            if added is None:
                self._sum = scene
            else:
                self._sum = added if scene.is_still else TotalCurrent([scene, added])
        return self._sum

    @property
    def is_still(self) -> bool:
        """Whether the water does not move at all."""
        return self._flow.is_still

    def is_asked_where_bodies_are(self, vehicles: Sequence[str]) -> bool:
        """Whether Python has to be asked in every step where the bodies of `during` are then."""
        flow = self._flow
        return not (flow.is_still or flow.is_uniform or self._compiled(vehicles)[0] is not None)

    def during(
        self,
        positions: Callable[[], Array],
        steps: range,
        timestep: float,
        vehicles: Sequence[str],
    ) -> WaterFunction | None:
        """Return how the water moves at some bodies in some steps, in W; None if it is still.

        It is that of the middle of each step.

        Args:
            positions: where the bodies are now, in W, (n, 3) [m].
            steps: their numbers; one alone, if `is_asked_where_bodies_are`.
            timestep: length of a step [s].
            vehicles: as `at` takes them.
        """
        flow = self._flow
        if flow.is_still:
            return None
        function, compiled_flow = self._compiled(vehicles)
        if function is not None and compiled_flow is not None:
            compiled_flow.prepare(steps[-1] * timestep)
            return function
        times = [step * timestep - 0.5 * timestep for step in steps]
        if flow.is_uniform:
            asked = times[:1] if is_steady(flow) else times
            return of_rows(self._everywhere(asked, vehicles))
        found = np.zeros((1, len(vehicles), 9))
        found[0, :, 0:3], found[0, :, 3:6], rotation = self.at(positions(), times[0], vehicles)
        if rotation is not None:
            found[0, :, 6:9] = rotation
        return of_rows(found)

    def drift(self, vehicles: Sequence[str], timestep: float, until: float) -> DriftFunction | None:
        """Return what moves vehicles with the water as `carried` does, in compiled steps.

        None where Python has to be asked.

        Args:
            vehicles: names of all vehicles that are not simulated.
            timestep: length of a step [s].
            until: the end of the last step [s].
        """
        flow, (for_flow, for_vehicles, compiled_flow, function) = self._flow, self._drift
        if flow is not for_flow or vehicles != for_vehicles:
            felt, names = _numbered(vehicles)
            compiled_flow, function = flow_function_of(flow, names), None
            if compiled_flow is not None:
                function = of_drift(compiled_flow, self._world_from_localized, felt, timestep)
            self._drift = flow, vehicles, compiled_flow, function
        if compiled_flow is not None:
            compiled_flow.prepare(until)
        return function

    def _compiled(
        self, vehicles: Sequence[str]
    ) -> tuple[WaterFunction | None, FlowFunction | None]:
        """Return the functions of the present flow; None where Python has to be asked."""
        flow, (for_flow, for_vehicles, compiled_flow, function) = self._flow, self._felt
        if flow is not for_flow or vehicles != for_vehicles:
            felt, names = _numbered(vehicles)
            compiled_flow, function = flow_function_of(flow, names), None
            if compiled_flow is not None:
                function = of_flow(
                    compiled_flow,
                    self._localized_from_world,
                    felt,
                    is_uniform=flow.is_uniform,
                    is_steady=flow.is_uniform and is_steady(flow),
                )
            self._felt = flow, vehicles, compiled_flow, function
        return function, compiled_flow

    def _everywhere(self, times: Sequence[float], vehicles: Sequence[str]) -> Array:
        """Return rows of uniform water: a vehicle's points feel the same, asked for once."""
        felt, names = _numbered(vehicles)
        flow, points = self._flow, np.zeros((len(names), 3))
        localized = np.empty((len(times), 2, len(names), 3))
        for row, time in zip(localized, times, strict=True):
            row[0], row[1] = flow.motion(points, time, names)
        return _spread(localized, felt, self._localized_from_world.rotation)

    def at(self, points: Array, time: float, vehicles: Sequence[str]) -> WaterRow:
        r"""Return how the water moves, in W.

        The acceleration is that of the water which passes a point, and what its pressure gives to
        a body: :math:`Du/Dt = \partial u/\partial t + (u \cdot \nabla) u`.

        Args:
            points: in W, (n, 3) [m].
            time: [s].
            vehicles: the name of the vehicle that each point belongs to, or empty.

        Returns:
            The velocity, (n, 3) [m/s], the acceleration, (n, 3) [m/s2], and how fast the water
            turns, :math:`\tfrac12 \nabla \times u`, (n, 3) [rad/s]; None if it is nowhere sheared.
        """
        localized = self._localized_from_world.transform(points)
        turn = self._localized_from_world.rotation
        velocity, acceleration = self._flow.motion(localized, time, vehicles)
        if self._flow.is_uniform:
            return product(velocity, turn), product(acceleration, turn), None
        gradient = self._gradient(localized, time, vehicles)
        acceleration += np.einsum("nij,nj->ni", gradient, velocity)
        x, y, z = (gradient[:, j, i] - gradient[:, i, j] for i, j in ((1, 2), (2, 0), (0, 1)))
        rotation = 0.5 * np.stack([x, y, z], axis=1)
        return product(velocity, turn), product(acceleration, turn), product(rotation, turn)

    def _gradient(self, localized: Array, time: float, vehicles: Sequence[str]) -> Array:
        """Derivative of the velocity by the place, in L, (n, 3, 3) [1/s]: rows are components."""
        n = len(localized)
        offsets = NEARBY * np.concatenate([np.eye(3), -np.eye(3)])  # (6, 3) [m]
        around = (localized + offsets[:, None]).reshape(-1, 3)  # (6 n, 3)
        names = tuple(vehicles) * len(offsets)
        found = self._flow.velocity(around, time, names).reshape(6, n, 3)
        slopes: Array = (found[:3] - found[3:]) / (2.0 * NEARBY)  # (by j, n, i)
        return slopes.transpose(1, 2, 0)

    def velocity(self, points: Array, time: float, vehicle: str) -> Array:
        """Return the velocity at points of W (n, 3) [m] as a vehicle feels it, (n, 3) [m/s]."""
        if self.is_still:
            return np.zeros((len(points), 3))
        localized = self._localized_from_world.transform(points)
        velocity = self._flow.velocity(localized, time, (vehicle,) * len(points))
        return product(velocity, self._localized_from_world.rotation)

    def at_points(self, vehicle: str, n: int) -> CompiledFunction | None:
        """Return what says `velocity` at ``n`` points in compiled code; None if Python is asked.

        Args:
            vehicle: the name of that which feels it.
            n: how many points.
        """
        flow, (for_flow, known) = self._flow, self._points
        if for_flow is not flow:
            known = {}
            self._points = flow, known
        if (vehicle, n) not in known:
            function = None if flow.is_still else flow_function_of(flow, (vehicle,))
            is_asked = function is None and not flow.is_still
            known[vehicle, n] = (
                None if is_asked else at_points(function, self._localized_from_world, n)
            )
        return known[vehicle, n]

    def carried(self, world_from_base: Pose, time: float, timestep: float, vehicle: str) -> Pose:
        """Return where a vehicle is after a step of drifting with the water: ``p += v dt``."""
        point = self._localized_from_world.transform(world_from_base.position[None])  # (1, 3) [m]
        velocity = self._flow.velocity(point, time, (vehicle,))[0]  # (3,) [m/s]
        moved = self._world_from_localized.transform(point + velocity * timestep)[0]
        return Pose(moved, world_from_base.rotation)


def _numbered(vehicles: Sequence[str]) -> tuple[npt.NDArray[np.int64], tuple[str, ...]]:
    """Return the number of each name, and the names, each once."""
    names = tuple(dict.fromkeys(vehicles))
    return np.array([names.index(name) for name in vehicles], dtype=np.int64), names


@njit
def _spread(localized: Array, felt: npt.NDArray[np.int64], turn: Array) -> Array:
    """Turn velocities and accelerations (times, 2, m, 3) to W, and give each point its own.

    Returns:
        Rows as `of_rows` takes them, (times, n, 9).
    """
    found = np.zeros((len(localized), len(felt), 9))
    for t in range(len(localized)):
        for kind in range(2):
            for i in range(len(felt)):
                for k in range(3):
                    total = 0.0
                    for j in range(3):
                        total += localized[t, kind, felt[i], j] * turn[j, k]
                    found[t, i, 3 * kind + k] = total
    return found


def water_motion(
    model: SceneModel, stream: Callable[[str], np.random.Generator], *, runs_code: bool
) -> WaterMotion:
    """Return the flow of a scene.

    Args:
        model: its model.
        stream: returns the random generator of a name.
        runs_code: let Python code that the scene names run.
    """
    scene = model.scene
    place = Place(
        stream=stream,
        find=lambda name: find_file(name, scene.path, model.data_path),
        world_from_localized=scene.world_from_localized,
        runs_code=runs_code,
        surface_height=scene.ocean_state.ocean_surface_height,
    )
    return WaterMotion(scene, place)
