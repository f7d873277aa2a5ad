"""Vehicles, objects and markers, as entities of ROS 2's simulation_interfaces.

Poses are in the frame of the scene file, L, as on all topics. Vehicles with dynamics also have a
velocity over ground, with the axes of L; accelerations are not computed. A service can place a
vehicle, at rest. A spawned entity is a marker with a mesh (`uwsim.simulation.markers`).
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
"""The namespace of the markers that are spawned as entities."""
NAME_PATTERN = re.compile(r"[A-Za-z0-9_./-]{1,100}")
"""The names that an entity may have."""
MAX_FILTER_LENGTH = 100
"""The maximum number of characters of a regular expression that filters names."""
MAX_REPETITIONS = 3
"""The maximum number of repetition operators in such an expression; groups cannot be repeated."""


class Entities:
    """The services that list, read, set, spawn and delete entities."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._marker_ids: dict[str, int] = {}
        self._n_spawned = 0

    def serve(self, bus: Bus) -> None:
        """Offer the services on a bus."""
        bus.services.serve("get_entities", GetEntities, self.get_entities)
        bus.services.serve("get_entity_state", GetEntityState, self.get_state)
        bus.services.serve("set_entity_state", SetEntityState, self.set_state)
        bus.services.serve("spawn_entity", SpawnEntity, self.spawn)
        bus.services.serve("delete_entity", DeleteEntity, self.delete)

    @property
    def names(self) -> list[str]:
        """The names of vehicles, objects and markers."""
        scene = self._simulation.world.model.scene
        shown_markers = self._simulation.world.markers.active_markers
        self._marker_ids = {
            n: i for n, i in self._marker_ids.items() if f"{i}+{NAMESPACE}" in shown_markers
        }
        vehicles, objects = scene.vehicles, scene.objects
        scene_names = [*(spec.name for spec in vehicles), *(spec.name for spec in objects)]
        return [*scene_names, *self._marker_ids]

    def get_entities(self, request: GetEntities) -> GetEntitiesResponse:
        """List the entities whose names match the filter; other filters are not supported."""
        filters = request.filters
        if filters.categories or filters.tags.tags or filters.bounds.points:
            message = "Entities are filtered by name only."
            return GetEntitiesResponse(Result(Result.FEATURE_UNSUPPORTED, message))
        try:
            check_filter(filters.filter)
            with warnings.catch_warnings(action="ignore", category=FutureWarning):
                pattern = re.compile(filters.filter)
        except (re.error, OverflowError) as error:
            message = f"The filter is no regular expression: {error}."
            return GetEntitiesResponse(Result(Result.OPERATION_FAILED, message))
        return GetEntitiesResponse(entities=[n for n in self.names if pattern.search(n)])

    def get_state(self, request: GetEntityState) -> GetEntityStateResponse:
        """Return the pose of an entity, and its twist if it is a vehicle with dynamics."""
        name, world = request.entity, self._simulation.world
        if name not in self.names:
            return GetEntityStateResponse(_make_not_found(name))
        state = EntityState(header=header(self._simulation.time))
        if name in self._marker_ids:
            state.pose = world.markers.active_markers[f"{self._marker_ids[name]}+{NAMESPACE}"].pose
            return GetEntityStateResponse(state=state)
        pose = self._simulation.pose(name)
        state.pose = _pose_message(pose)
        if name in world.vehicles.names and world.engine.has_dynamics(
            world.vehicles.find(name).index
        ):
            twist = self._simulation.velocity(name)
            linear, angular = rotate(pose.rotation, twist[:3]), rotate(pose.rotation, twist[3:])
            state.twist = Twist(linear=Vector3(*linear), angular=Vector3(*angular))
        return GetEntityStateResponse(state=state)

    def set_state(self, request: SetEntityState) -> SetEntityStateResponse:
        """Place a vehicle, at rest."""
        name, world = request.entity, self._simulation.world
        if name not in self.names:
            return SetEntityStateResponse(_make_not_found(name))
        if name not in world.vehicles.names or request.set_twist or request.set_acceleration:
            message = "Only the pose of a vehicle can be set; it is at rest then."
            return SetEntityStateResponse(Result(Result.FEATURE_UNSUPPORTED, message))
        pose = read_pose(request.state.pose)
        if pose is None:
            message = f"The pose is not valid; expected {EXPECTED_POSE}."
            return SetEntityStateResponse(Result(Result.OPERATION_FAILED, message))
        if request.set_pose:
            world.vehicles.find(name).reset_pose(world.model.scene.world_from_localized @ pose)
        return SetEntityStateResponse()

    def spawn(self, request: SpawnEntity) -> SpawnEntityResponse:
        """Add a marker with a mesh."""
        code = SpawnEntityResponse
        uri, name = request.entity_resource.uri, request.name
        if not uri:
            return code(Result(code.NO_RESOURCE, "Only a uri of a mesh can be spawned."))
        if (not name or name in self.names) and request.allow_renaming:
            name = f"{name or 'entity'}_{self._n_spawned}"
        if not NAME_PATTERN.fullmatch(name):
            return code(Result(code.NAME_INVALID, "Expected letters, digits and _ . / -"))
        if name in self.names:
            return code(Result(code.NAME_NOT_UNIQUE, f"There is an entity {name}."))
        marker = Marker(ns=NAMESPACE, id=self._n_spawned, type=Marker.MESH_RESOURCE)
        marker.mesh_resource, marker.pose = uri, request.initial_pose.pose
        marker.scale = Vector3(1.0, 1.0, 1.0)
        response = self._simulation.world.markers.answer(SpawnMarker(marker=marker))
        if not response.success:
            is_lost = "there is no mesh" in response.status_message
            result_code = code.MISSING_ASSETS if is_lost else code.INVALID_POSE
            return code(Result(result_code, response.status_message))
        self._marker_ids[name] = self._n_spawned
        self._n_spawned += 1
        return code(entity_name=name)

    def delete(self, request: DeleteEntity) -> DeleteEntityResponse:
        """Delete a spawned marker."""
        name = request.entity
        if name not in self.names:
            return DeleteEntityResponse(_make_not_found(name))
        if name not in self._marker_ids:
            message = "Vehicles and objects of the scene cannot be deleted."
            return DeleteEntityResponse(Result(Result.FEATURE_UNSUPPORTED, message))
        marker = Marker(ns=NAMESPACE, id=self._marker_ids.pop(name), action=Marker.DELETE)
        self._simulation.world.markers.answer(SpawnMarker(marker=marker))
        return DeleteEntityResponse()


def check_filter(filter: str) -> None:
    """Raise re.error if a regular expression could take too long to match."""
    if len(filter) > MAX_FILTER_LENGTH:
        raise re.error(f"it has more than {MAX_FILTER_LENGTH} characters")
    if len(re.findall(r"[*+?{]", filter)) > MAX_REPETITIONS or re.search(r"\)[*+?{]", filter):
        raise re.error(f"it has more than {MAX_REPETITIONS} repetitions, or one of a group")


def _make_not_found(name: str) -> Result:
    return Result(Result.NOT_FOUND, f"There is no entity {name!r}.")


def _pose_message(pose: Pose) -> messages.Pose:
    w, x, y, z = map(float, quaternion_from_rotation(pose.rotation))
    point = messages.Point(*map(float, pose.position))
    return messages.Pose(position=point, orientation=messages.Quaternion(x, y, z, w))
