"""The task of rows of free vehicles, from a benchmark whose environment they can step.

Rows (`uwsim.envs.batch`) step one free vehicle each. They observe the state, act by thrusters, and
are rewarded by the distance from the reference.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base.expression import parse
from ..base.geometry import Array, Pose, quaternion_from_rotation
from ..base.rng import stream
from ..benchmark.environment import EnvironmentSpec
from ..benchmark.environment.reward import REWARD_NAMES
from ..benchmark.reference_trajectory import TrajectorySpec
from ..benchmark.triggers.never import NeverSpec
from ..benchmark.updaters import (
    CurrentForceUpdaterSpec,
    Level,
    SceneUpdaterSpec,
    chain,
    interval,
)
from ..errors import BadSetting
from ..model.body_names import vehicle_body
from ..model.scene_model import SceneModel
from ..physics.hydrodynamics.free_vehicle import free_vehicle
from ..physics.hydrodynamics.kernel.free_step import FreeVehicle
from ..runs.planning.plan import Plan
from ..scene.variation import apply_variations
from ..topics.thruster_commands import ROSThrustersToPATSpec
from .episode import environment_of

MAX_EPISODE = 600.0
"""The length of an episode without an interval [s]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RowPlan:
    """The numbers of a benchmark that rows step."""

    plan: Plan
    """The plan of the benchmark."""
    spec: EnvironmentSpec
    """The environment."""
    trajectory: TrajectorySpec
    """The desired position at each time."""
    vehicle: FreeVehicle
    """The numbers of the vehicle."""
    index: int
    """The index of the vehicle in the scene."""
    world_from_localized: Pose
    """The pose of L in W."""
    substeps: int
    """The number of physics steps in a period."""
    max_steps: int
    """The number of periods in an episode."""

    def start(self, seed: int) -> tuple[Array, Array]:
        """Return the position in W [m] and the attitude (wxyz) at the start of an episode."""
        scene = apply_variations(self.plan.scene, seed)
        vehicle = scene.vehicles[self.index]
        pose = self.world_from_localized @ Pose.from_rpy(vehicle.position, vehicle.orientation)
        return pose.position, quaternion_from_rotation(pose.rotation)

    def current(self, level: Level, seed: int) -> Array:
        """Return the current of an episode in W, (3,) [m/s]: constant, within the swing."""
        updater = chain(self.plan.benchmark.scene_updater)[0]
        if not isinstance(updater, CurrentForceUpdaterSpec):
            return np.zeros(3)
        swing = stream(seed, "environment/current").uniform(-1.0, 1.0, 2)
        mean, amplitude = updater.spherical_direction, updater.direction_variation
        theta = mean.theta + float(swing[0]) * amplitude.theta
        phi = mean.phi + float(swing[1]) * amplitude.phi
        sine = np.sin(theta)
        direction = np.array([-sine * np.sin(phi), sine * np.cos(phi), np.cos(theta)])
        rotation = self.world_from_localized.rotation
        velocity: Array = level.values[0][1] * np.sum(rotation * direction, axis=1)
        return velocity


def plan_rows(plan: Plan, model: SceneModel) -> RowPlan:
    """Return the numbers of a benchmark that rows step.

    Raises:
        BadSetting: rows cannot step it; the message has the reasons.
    """
    spec = environment_of(plan)
    trajectory = spec.trajectory(plan.benchmark.measures)
    reasons = _find_reasons(plan, spec, model)
    if trajectory is None:
        reasons.append("it has no <reference>")
    if reasons:
        raise BadSetting(
            f"{plan.benchmark.path}: rows cannot step this environment: {'; '.join(reasons)}. "
            "Use stepper='engine'."
        )
    assert trajectory is not None
    index = [vehicle.name for vehicle in model.scene.vehicles].index(spec.vehicle)
    root = model.engine_model.body(vehicle_body(index, model.robots[index].root)).id
    length = interval(plan.benchmark.scene_updater) or MAX_EPISODE
    return RowPlan(
        plan=plan,
        spec=spec,
        trajectory=trajectory,
        vehicle=free_vehicle(model.engine_model, root),
        index=index,
        world_from_localized=model.scene.world_from_localized,
        substeps=max(1, round(spec.period / plan.timestep)),
        max_steps=max(1, round(length / spec.period)),
    )


def _find_reasons(plan: Plan, spec: EnvironmentSpec, model: SceneModel) -> list[str]:
    """Return the reasons why rows cannot step an environment."""
    reasons = []
    names = [vehicle.name for vehicle in model.scene.vehicles]
    if len(names) != 1 or names.index(spec.vehicle) not in model.dynamics:
        reasons.append("its scene has other than one vehicle with dynamics")
    if spec.topic_field:
        reasons.append("it observes topics")
    topics = [
        interface.topic
        for interface in model.scene.ros_interfaces
        if isinstance(interface, ROSThrustersToPATSpec)
    ]
    if [action.topic for action in spec.action] != topics[:1] or any(
        action.limits for action in spec.action
    ):
        reasons.append("its action is not the commands of all thrusters")
    measures = [measure.name for measure in plan.benchmark.measures]
    known_names = {spec.reference or "", *REWARD_NAMES}
    reward = parse(spec.reward, [*measures, *REWARD_NAMES])
    other_measures = [name for name in reward.names if name not in known_names]
    if other_measures:
        reasons.append(f"its reward has the measure {', '.join(other_measures)}")
    if not _has_known_updater(plan.benchmark.scene_updater):
        reasons.append("its updater is other than <currentForceUpdater> or <none>")
    if plan.scene.ocean_state.currents:
        reasons.append("its scene has currents")
    solids = [item.name for item in model.scene.objects if item.has_contacts(in_water=True)]
    if solids:
        reasons.append(f"its scene has solid objects ({', '.join(solids[:3])})")
    if not isinstance(plan.benchmark.stop_on, NeverSpec):
        reasons.append("a trigger ends its levels")
    return reasons


def _has_known_updater(updater: SceneUpdaterSpec) -> bool:
    updaters = chain(updater)
    is_known = isinstance(updaters[0], CurrentForceUpdaterSpec) or updaters[0].name in (
        "none",
        "repeat",
    )
    return len(updaters) == 1 and is_known
