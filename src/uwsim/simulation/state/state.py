"""The state of a simulation: one record of all values that change while it runs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from ...base.record import ExternalValue, Record, are_equal, copy_record, wrong_scene_error
from ...bus.bus import BusState
from ...errors import UwsimError
from ...model.scene_model import SceneModel
from ...network.network import NetworkState
from ...physics.engine_state import EngineState
from ..access.topics import AccessState
from ..collision.below_ground import BelowGroundState
from ..collision.contacts import ContactsState
from ..faulty_topic import FaultyTopicState
from ..markers.spawned import MarkersState
from ..nodes.node import NodeState
from ..scenery.scenery import SceneryState
from ..schedule import ScheduleState
from ..trajectories import TrajectoryState
from ..vehicles import VehicleState
from ..water.water_motion import WaterState
from .saved_bytes import pack, unpack


@dataclass(frozen=True, slots=True)
class Identity:
    """The constant values that a simulation must share with a state to restore it."""

    seed: int
    """The seed of every random stream."""
    timestep: float
    """The length of a step [s]."""
    compatibility: str
    """The names of the active compatibility quirks, separated by commas; ``none`` if there are
    none."""
    scene: str
    """The hash of the scene, after the variations of the seed are applied."""


class RunningIdentity(ExternalValue):
    """The identity of a running simulation."""

    def __init__(self, model: SceneModel) -> None:
        self._model = model
        self._identity: Identity | None = None

    def value(self) -> Identity:
        """Return the identity."""
        if self._identity is None:
            model = self._model
            quirks = ", ".join(sorted(model.compatibility)) or "none"
            self._identity = Identity(model.seed, model.timestep, quirks, model.digest)
        return self._identity

    def set(self, value: object) -> None:
        """Raise UwsimError if ``value`` is not the identity of this simulation."""
        identity = self.value()
        if not isinstance(value, Identity):
            raise wrong_scene_error()
        for name in ("seed", "timestep", "compatibility"):
            own_value, saved_value = getattr(identity, name), getattr(value, name)
            if own_value != saved_value:
                unit = " s" if name == "timestep" else ""
                raise UwsimError(
                    f"The saved simulation has {name} {saved_value}{unit}; "
                    f"this one has {own_value}{unit}."
                )
        if identity.scene != value.scene:
            raise wrong_scene_error()


@dataclass(slots=True, eq=False)
class State(Record):
    """The values of a simulation that change while it runs.

    `uwsim.Simulation.state` is the state of the running simulation and changes with it; a `copy`
    does not. A copy shares messages, which must not change once they are published. Two states are
    equal if all their numbers are equal to the bit. These include cached poses of bodies, which are
    computed on request: the state differs after `Simulation.pose` or an image.

    Not part of the state: callbacks, and the hash of the images published so far. While an
    algorithm without ``save`` and ``restore`` is attached, the state cannot be copied or saved.
    """

    identity: RunningIdentity
    """The identity of the simulation; the state of another simulation cannot be restored."""
    bus: BusState
    """The step, and the undelivered messages."""
    engine: EngineState
    """The poses, velocities and actuators: the physics."""
    vehicles: list[VehicleState]
    """The state of each vehicle that is not part of the engine's state."""
    sensors: list[Record]
    """The state of each sensor."""
    devices: list[Record]
    """The state of each device."""
    forces: list[Record]
    """The state of each force."""
    interfaces: list[Record]
    """The state of each element of ``<rosInterfaces>``."""
    faults: list[FaultyTopicState]
    """The state of each topic of a sensor with faults."""
    scenery: SceneryState
    """The fog, the light and the sand."""
    water: WaterState
    """The current that a program has set, and the factor on the wave heights of the scene."""
    contacts: ContactsState
    """The state of contacts that is not part of the engine's state."""
    below_ground: BelowGroundState
    """The result of the last check for bodies below the ground."""
    schedule: ScheduleState
    """The timers, and the commands for the next step."""
    network: NetworkState
    """The packets between communication devices."""
    markers: MarkersState
    """The markers that programs have added."""
    trajectories: list[TrajectoryState]
    """The path of each body of a ``<showTrajectory>``."""
    access: AccessState
    """The topics that a program has read, and whether the first samples are published."""
    nodes: list[NodeState]
    """The timers and the states of attached algorithms."""

    def copy(self) -> Self:
        """Return a copy of all values, which the running simulation does not change.

        Raises:
            UwsimError: an attached algorithm has no ``save`` and ``restore``.
        """
        return copy_record(self)

    def to_bytes(self) -> bytes:
        """Return the state as bytes, for the same version of uwsim.

        Raises:
            UwsimError: a value, such as a current of a program's own class, cannot be saved; or an
                attached algorithm has no ``save`` and ``restore``.
        """
        return pack(self)

    @classmethod
    def from_bytes(cls, data: bytes) -> Self:
        """Read a state from bytes.

        Raises:
            UwsimError: the bytes are damaged, or another version of uwsim has written them.
        """
        return unpack(data, cls)

    def __eq__(self, other: object) -> bool:
        """Return whether all values of two states are equal to the bit."""
        return isinstance(other, State) and are_equal(self.copy(), other.copy())

    __hash__ = None  # type: ignore[assignment]
