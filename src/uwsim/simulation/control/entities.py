"""Vehicles, objects and markers, as entities of ROS 2's simulation_interfaces.

Poses and velocities are in the frame of the scene file, L, as on all topics. Velocities are those
of simulated vehicles, over ground, with the axes of L; accelerations are not computed. A vehicle
may be placed, at rest. What is spawned is a marker with a mesh (`uwsim.simulation.markers`).
"""

from __future__ import annotations

import re
import warnings

from ... import messages
from ...base.external_values import EXPECTED_POSE, read_pose
from ...base.geometry import Pose, quaternion_from_rotation
from ...base.numerics.linear import rotate
from ...bus import Bus
from ...messages import Marker, SpawnMarker, Twist, Vector3
from ...messages.build import header
from ...messages.simulation_control import (
    DeleteEntity,
    DeleteEntityResponse,
    EntityState,
    GetEntities,
    GetEntitiesResponse,
    GetEntityState,
    GetEntityStateResponse,
    Result,
    SetEntityState,
    SetEntityStateResponse,
    SpawnEntity,
    SpawnEntityResponse,
)
from ..simulation import Simulation

NAMESPACE = "spawned"
"""Namespace of the markers that are spawned as entities."""
NAME = re.compile(r"[A-Za-z0-9_./-]{1,100}")
"""What an entity may be called."""
MAX_FILTER = 100
"""Longest expression over names."""
MAX_REPETITIONS = 3
"""Repetitions in such an expression; none of a group."""


class Entities:
    """Answers what is asked about entities."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._spawned: dict[str, int] = {}
        self._n_spawned = 0

    def serve(self, bus: Bus) -> None:
        """Offer the services."""
        bus.services.serve("get_entities", GetEntities, self.get_entities)
        bus.services.serve("get_entity_state", GetEntityState, self.get_state)
        bus.services.serve("set_entity_state", SetEntityState, self.set_state)
        bus.services.serve("spawn_entity", SpawnEntity, self.spawn)
        bus.services.serve("delete_entity", DeleteEntity, self.delete)

    @property
    def names(self) -> list[str]:
        """Vehicles, objects and what was spawned."""
        scene = self._simulation.world.model.scene
        shown = self._simulation.world.markers.shown
        self._spawned = {n: i for n, i in self._spawned.items() if f"{i}+{NAMESPACE}" in shown}
        vehicles, objects = scene.vehicles, scene.objects
        own = [*(each.name for each in vehicles), *(each.name for each in objects)]
        return [*own, *self._spawned]

    def get_entities(self, request: GetEntities) -> GetEntitiesResponse:
        """List them; only names are filtered."""
        filters = request.filters
        if filters.categories or filters.tags.tags or filters.bounds.points:
            message = "Entities are filtered by name only."
            return GetEntitiesResponse(Result(Result.FEATURE_UNSUPPORTED, message))
        try:
            check_filter(filters.filter)
            with warnings.catch_warnings(action="ignore", category=FutureWarning):
                wanted = re.compile(filters.filter)
        except (re.error, OverflowError) as error:
            message = f"The filter is no regular expression: {error}."
            return GetEntitiesResponse(Result(Result.OPERATION_FAILED, message))
        return GetEntitiesResponse(entities=[n for n in self.names if wanted.search(n)])

    def get_state(self, request: GetEntityState) -> GetEntityStateResponse:
        """Return where an entity is."""
        name, world = request.entity, self._simulation.world
        if name not in self.names:
            return GetEntityStateResponse(_not_found(name))
        state = EntityState(header=header(self._simulation.time))
        if name in self._spawned:
            state.pose = world.markers.shown[f"{self._spawned[name]}+{NAMESPACE}"].pose
            return GetEntityStateResponse(state=state)
        pose = self._simulation.pose(name)
        state.pose = _message(pose)
        if name in world.vehicles.names and world.engine.is_simulated(
            world.vehicles.find(name).index
        ):
            twist = self._simulation.velocity(name)
            linear, angular = rotate(pose.rotation, twist[:3]), rotate(pose.rotation, twist[3:])
            state.twist = Twist(linear=Vector3(*linear), angular=Vector3(*angular))
        return GetEntityStateResponse(state=state)

    def set_state(self, request: SetEntityState) -> SetEntityStateResponse:
        """Put a vehicle somewhere, at rest."""
        name, world = request.entity, self._simulation.world
        if name not in self.names:
            return SetEntityStateResponse(_not_found(name))
        if name not in world.vehicles.names or request.set_twist or request.set_acceleration:
            message = "Only the pose of a vehicle can be set; it is at rest then."
            return SetEntityStateResponse(Result(Result.FEATURE_UNSUPPORTED, message))
        pose = read_pose(request.state.pose)
        if pose is None:
            message = f"The pose is not valid; expected {EXPECTED_POSE}."
            return SetEntityStateResponse(Result(Result.OPERATION_FAILED, message))
        if request.set_pose:
            world.vehicles.find(name).put(world.model.scene.world_from_localized @ pose)
        return SetEntityStateResponse()

    def spawn(self, request: SpawnEntity) -> SpawnEntityResponse:
        """Add a marker with a mesh."""
        code = SpawnEntityResponse
        uri, name = request.entity_resource.uri, request.name
        if not uri:
            return code(Result(code.NO_RESOURCE, "Only a uri of a mesh can be spawned."))
        if (not name or name in self.names) and request.allow_renaming:
            name = f"{name or 'entity'}_{self._n_spawned}"
        if not NAME.fullmatch(name):
            return code(Result(code.NAME_INVALID, "Expected letters, digits and _ . / -"))
        if name in self.names:
            return code(Result(code.NAME_NOT_UNIQUE, f"There is an entity {name}."))
        marker = Marker(ns=NAMESPACE, id=self._n_spawned, type=Marker.MESH_RESOURCE)
        marker.mesh_resource, marker.pose = uri, request.initial_pose.pose
        marker.scale = Vector3(1.0, 1.0, 1.0)
        answer = self._simulation.world.markers.answer(SpawnMarker(marker=marker))
        if not answer.success:
            is_lost = "there is no mesh" in answer.status_message
            failed = code.MISSING_ASSETS if is_lost else code.INVALID_POSE
            return code(Result(failed, answer.status_message))
        self._spawned[name] = self._n_spawned
        self._n_spawned += 1
        return code(entity_name=name)

    def delete(self, request: DeleteEntity) -> DeleteEntityResponse:
        """Take away a marker that was spawned."""
        name = request.entity
        if name not in self.names:
            return DeleteEntityResponse(_not_found(name))
        if name not in self._spawned:
            message = "Vehicles and objects of the scene cannot be deleted."
            return DeleteEntityResponse(Result(Result.FEATURE_UNSUPPORTED, message))
        marker = Marker(ns=NAMESPACE, id=self._spawned.pop(name), action=Marker.DELETE)
        self._simulation.world.markers.answer(SpawnMarker(marker=marker))
        return DeleteEntityResponse()


def check_filter(filter: str) -> None:
    """Raise re.error if an expression may take for ever: how long it takes cannot be bounded."""
    if len(filter) > MAX_FILTER:
        raise re.error(f"it has more than {MAX_FILTER} characters")
    if len(re.findall(r"[*+?{]", filter)) > MAX_REPETITIONS or re.search(r"\)[*+?{]", filter):
        raise re.error(f"it has more than {MAX_REPETITIONS} repetitions, or one of a group")


def _not_found(name: str) -> Result:
    return Result(Result.NOT_FOUND, f"There is no entity {name!r}.")


def _message(pose: Pose) -> messages.Pose:
    w, x, y, z = map(float, quaternion_from_rotation(pose.rotation))
    place = messages.Point(*map(float, pose.position))
    return messages.Pose(position=place, orientation=messages.Quaternion(x, y, z, w))
