"""Types of simulation_interfaces, by which ROS 2 programs control simulators, with defaults.

Their text is in ``simulation_interfaces/``; names, order and codes are those of the ROS 2 package.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import Any, ClassVar

import numpy as np

from .geometry_msgs import Pose, PoseStamped, Twist, Vector3
from .services import Service
from .std_msgs import Header

MAX_STEPS = 10_000_000
"""Most steps of one ``StepSimulation``."""

PACKAGE = "simulation_interfaces"
_CODES: Any = partial(np.zeros, 0, np.uint16)


@dataclass
class Accel:
    """Linear [m/s^2] and angular [rad/s^2] acceleration."""

    linear: Vector3 = field(default_factory=Vector3)
    angular: Vector3 = field(default_factory=Vector3)
    __msgtype__: ClassVar[str] = "geometry_msgs/msg/Accel"


@dataclass
class Result:
    """How a call ended."""

    FEATURE_UNSUPPORTED: ClassVar[int] = 0
    OK: ClassVar[int] = 1
    NOT_FOUND: ClassVar[int] = 2
    INCORRECT_STATE: ClassVar[int] = 3
    OPERATION_FAILED: ClassVar[int] = 4
    result: int = 1
    error_message: str = ""
    __msgtype__: ClassVar[str] = "simulation_interfaces/msg/Result"


@dataclass
class SimulatorFeatures:
    """What a simulator can do; the codes are below."""

    SPAWNING: ClassVar[int] = 0
    DELETING: ClassVar[int] = 1
    ENTITY_STATE_GETTING: ClassVar[int] = 10
    ENTITY_STATE_SETTING: ClassVar[int] = 11
    SIMULATION_RESET: ClassVar[int] = 20
    SIMULATION_STATE_GETTING: ClassVar[int] = 24
    SIMULATION_STATE_SETTING: ClassVar[int] = 25
    SIMULATION_STATE_PAUSE: ClassVar[int] = 26
    STEP_SIMULATION_SINGLE: ClassVar[int] = 31
    STEP_SIMULATION_MULTIPLE: ClassVar[int] = 32
    features: np.ndarray[tuple[int, ...], np.dtype[np.uint16]] = field(default_factory=_CODES)
    spawn_formats: list[str] = field(default_factory=list)
    custom_info: str = ""
    __msgtype__: ClassVar[str] = "simulation_interfaces/msg/SimulatorFeatures"


@dataclass
class SimulationState:
    """Whether the simulation runs."""

    STOPPED: ClassVar[int] = 0
    PLAYING: ClassVar[int] = 1
    PAUSED: ClassVar[int] = 2
    QUITTING: ClassVar[int] = 3
    state: int = 0
    __msgtype__: ClassVar[str] = "simulation_interfaces/msg/SimulationState"


@dataclass
class EntityState:
    """Pose, velocity and acceleration of a body."""

    header: Header = field(default_factory=Header)
    pose: Pose = field(default_factory=Pose)
    twist: Twist = field(default_factory=Twist)
    acceleration: Accel = field(default_factory=Accel)
    __msgtype__: ClassVar[str] = "simulation_interfaces/msg/EntityState"


@dataclass
class EntityCategory:
    """The kind of an entity."""

    category: int = 0
    __msgtype__: ClassVar[str] = "simulation_interfaces/msg/EntityCategory"


@dataclass
class TagsFilter:
    """Tags that entities must have."""

    tags: list[str] = field(default_factory=list)
    filter_mode: int = 0
    __msgtype__: ClassVar[str] = "simulation_interfaces/msg/TagsFilter"


@dataclass
class Bounds:
    """A region; without points there is none."""

    type: int = 0
    points: list[Vector3] = field(default_factory=list)
    __msgtype__: ClassVar[str] = "simulation_interfaces/msg/Bounds"


@dataclass
class EntityFilters:
    """Which entities."""

    filter: str = ""
    categories: list[EntityCategory] = field(default_factory=list)
    tags: TagsFilter = field(default_factory=TagsFilter)
    bounds: Bounds = field(default_factory=Bounds)
    __msgtype__: ClassVar[str] = "simulation_interfaces/msg/EntityFilters"


@dataclass
class Resource:
    """A file, or what would be in it."""

    uri: str = ""
    resource_string: str = ""
    __msgtype__: ClassVar[str] = "simulation_interfaces/msg/Resource"


@dataclass
class GetSimulatorFeatures:
    """Request of ``GetSimulatorFeatures``: what the simulator can do."""

    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/GetSimulatorFeatures_Request"


@dataclass
class GetSimulatorFeaturesResponse:
    """Response of ``GetSimulatorFeatures``."""

    features: SimulatorFeatures = field(default_factory=SimulatorFeatures)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/GetSimulatorFeatures_Response"


@dataclass
class GetSimulationState:
    """Request of ``GetSimulationState``: whether it runs."""

    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/GetSimulationState_Request"


@dataclass
class GetSimulationStateResponse:
    """Response of ``GetSimulationState``."""

    state: SimulationState = field(default_factory=SimulationState)
    result: Result = field(default_factory=Result)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/GetSimulationState_Response"


@dataclass
class SetSimulationState:
    """Request of ``SetSimulationState``: play, pause, stop or quit."""

    state: SimulationState = field(default_factory=SimulationState)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/SetSimulationState_Request"


@dataclass
class SetSimulationStateResponse:
    """Response of ``SetSimulationState``."""

    ALREADY_IN_TARGET_STATE: ClassVar[int] = 101
    INCORRECT_TRANSITION: ClassVar[int] = 103
    result: Result = field(default_factory=Result)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/SetSimulationState_Response"


@dataclass
class StepSimulation:
    """Request of ``StepSimulation``: take some steps while it is paused."""

    steps: int = 0
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/StepSimulation_Request"


@dataclass
class StepSimulationResponse:
    """Response of ``StepSimulation``."""

    result: Result = field(default_factory=Result)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/StepSimulation_Response"


@dataclass
class ResetSimulation:
    """Request of ``ResetSimulation``: begin anew."""

    SCOPE_DEFAULT: ClassVar[int] = 0
    SCOPE_ALL: ClassVar[int] = 255
    scope: int = 0
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/ResetSimulation_Request"


@dataclass
class ResetSimulationResponse:
    """Response of ``ResetSimulation``."""

    result: Result = field(default_factory=Result)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/ResetSimulation_Response"


@dataclass
class GetEntities:
    """Request of ``GetEntities``: names of vehicles, objects and what was spawned."""

    filters: EntityFilters = field(default_factory=EntityFilters)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/GetEntities_Request"


@dataclass
class GetEntitiesResponse:
    """Response of ``GetEntities``."""

    result: Result = field(default_factory=Result)
    entities: list[str] = field(default_factory=list)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/GetEntities_Response"


@dataclass
class GetEntityState:
    """Request of ``GetEntityState``: where an entity is."""

    entity: str = ""
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/GetEntityState_Request"


@dataclass
class GetEntityStateResponse:
    """Response of ``GetEntityState``."""

    result: Result = field(default_factory=Result)
    state: EntityState = field(default_factory=EntityState)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/GetEntityState_Response"


@dataclass
class SetEntityState:
    """Request of ``SetEntityState``: put an entity somewhere."""

    entity: str = ""
    state: EntityState = field(default_factory=EntityState)
    set_pose: bool = False
    set_twist: bool = False
    set_acceleration: bool = False
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/SetEntityState_Request"


@dataclass
class SetEntityStateResponse:
    """Response of ``SetEntityState``."""

    result: Result = field(default_factory=Result)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/SetEntityState_Response"


@dataclass
class SpawnEntity:
    """Request of ``SpawnEntity``: add an entity."""

    name: str = ""
    allow_renaming: bool = False
    entity_resource: Resource = field(default_factory=Resource)
    entity_namespace: str = ""
    initial_pose: PoseStamped = field(default_factory=PoseStamped)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/SpawnEntity_Request"


@dataclass
class SpawnEntityResponse:
    """Response of ``SpawnEntity``."""

    NAME_NOT_UNIQUE: ClassVar[int] = 101
    NAME_INVALID: ClassVar[int] = 102
    NO_RESOURCE: ClassVar[int] = 104
    MISSING_ASSETS: ClassVar[int] = 107
    INVALID_POSE: ClassVar[int] = 109
    result: Result = field(default_factory=Result)
    entity_name: str = ""
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/SpawnEntity_Response"


@dataclass
class DeleteEntity:
    """Request of ``DeleteEntity``: take away what was spawned."""

    entity: str = ""
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/DeleteEntity_Request"


@dataclass
class DeleteEntityResponse:
    """Response of ``DeleteEntity``."""

    result: Result = field(default_factory=Result)
    __msgtype__: ClassVar[str] = "simulation_interfaces/srv/DeleteEntity_Response"


MESSAGES: tuple[type, ...] = (
    Accel,
    Result,
    SimulatorFeatures,
    SimulationState,
    EntityState,
    EntityCategory,
    TagsFilter,
    Bounds,
    EntityFilters,
    Resource,
)
"""The message types."""
SIMULATION_SERVICES: dict[str, Service] = {
    name: Service(name, request, response)
    for name, request, response in (
        (
            "simulation_interfaces/srv/GetSimulatorFeatures",
            GetSimulatorFeatures,
            GetSimulatorFeaturesResponse,
        ),
        (
            "simulation_interfaces/srv/GetSimulationState",
            GetSimulationState,
            GetSimulationStateResponse,
        ),
        (
            "simulation_interfaces/srv/SetSimulationState",
            SetSimulationState,
            SetSimulationStateResponse,
        ),
        ("simulation_interfaces/srv/StepSimulation", StepSimulation, StepSimulationResponse),
        ("simulation_interfaces/srv/ResetSimulation", ResetSimulation, ResetSimulationResponse),
        ("simulation_interfaces/srv/GetEntities", GetEntities, GetEntitiesResponse),
        ("simulation_interfaces/srv/GetEntityState", GetEntityState, GetEntityStateResponse),
        ("simulation_interfaces/srv/SetEntityState", SetEntityState, SetEntityStateResponse),
        ("simulation_interfaces/srv/SpawnEntity", SpawnEntity, SpawnEntityResponse),
        ("simulation_interfaces/srv/DeleteEntity", DeleteEntity, DeleteEntityResponse),
    )
}
"""The service types by their names in ROS 2."""
