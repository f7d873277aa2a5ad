"""The vehicle and the axes that viewers can pilot, or the reason why they cannot."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...algorithms.pilot import MODE_AXES, N_JOINTS, THRUSTER_AXES, TWIST_AXES
from ...devices.mavlink import MavlinkSpec
from ...simulation.live_scene import LiveScene
from .mapping import PilotMapping

STEERING_TOPICS = ("twist_topic", "odom_topic", "thrusters_topic")
"""The parameters of `uwsim.algorithms.pilot.Pilot` with the topics that steer a vehicle."""


@dataclass(frozen=True, kw_only=True)
class PilotTargets:
    """The vehicle and the axes that pilots can move."""

    vehicle: int
    """The index of the vehicle in the scene; 0 if no vehicle can be steered."""
    axes: frozenset[str]
    """The axes of `uwsim.algorithms.pilot.AXES` that have an effect."""
    reason: str
    """The reason why no vehicle can be steered; empty if a vehicle can be steered."""
    names: Mapping[str, str]
    """The names of joints and thrusters in the vehicle's files, by the pilot's axis."""

    def keys(self, mapping: PilotMapping) -> dict[str, str]:
        """Return the keys that have an effect, with their targets (`PilotMapping`)."""
        return {key: targets for key, targets in mapping.keys.items() if self._have_effect(targets)}

    def sticks(self, mapping: PilotMapping) -> list[str]:
        """Return the targets of the sticks: left x, left y, right x, right y; empty: no effect."""
        return [targets if self._have_effect(targets) else "" for targets in mapping.sticks]

    def _have_effect(self, targets: str) -> bool:
        return any(target.lstrip("+-") in self.axes for target in targets.split())


def find_pilot_targets(world: LiveScene, parameters: Mapping[str, float | str]) -> PilotTargets:
    """Find the vehicle and the axes that a pilot can move in a scene.

    Args:
        world: the scene.
        parameters: the parameters of the pilot (`uwsim.algorithms.pilot.Pilot`).
    """
    settings = {name: str(value) for name, value in parameters.items()}
    topics = {settings[name] for name in STEERING_TOPICS if settings.get(name)}
    axes: set[str] = set()
    names: dict[str, str] = {}
    autopilot = settings.get("autopilot", "")
    if autopilot:
        axes.update(TWIST_AXES, MODE_AXES, {"arm"})
        names.update({"arm": "arm / disarm", **MODE_AXES})
    if settings.get("twist_topic") or settings.get("odom_topic"):
        axes.update(TWIST_AXES)
    if settings.get("thrusters_topic"):
        axes.update(THRUSTER_AXES[: int(float(settings.get("n_thrusters", 0)))])
    if settings.get("joints_topic"):
        joints = enumerate(settings.get("joints", "").split()[:N_JOINTS], start=1)
        names.update({f"joint{number}": name for number, name in joints})
        names.update({"jaw": jaw} if (jaw := settings.get("jaw", "").strip()) else {})
        axes.update(names)
    if settings.get("lamp_topics", "").strip():
        axes.add("lamps")
    reason = ""
    if not world.vehicles:
        reason = "Nothing can be piloted: the scene has no vehicle."
    elif not topics and not autopilot:
        reason = (
            "No vehicle can be steered: the scene has no <ROSTwistToPAT> and no "
            "<u:ROSThrustersToPAT> in its <rosInterfaces>."
        )
    vehicles = [
        world.vehicles.names.index(name)
        for spec in world.model.scene.ros_interfaces
        if getattr(spec, "topic", None) in topics
        and (name := getattr(spec, "vehicle_name", None)) in world.vehicles.names
    ]
    vehicles += [
        index
        for index, spec in enumerate(world.model.scene.vehicles)
        if any(part.name == autopilot for part in spec.parts_of(MavlinkSpec))
    ]
    vehicle = next(iter(vehicles), 0)
    if world.vehicles:
        thrusters = world.vehicles.find(world.vehicles.names[vehicle]).thrusters
        pairs = zip(THRUSTER_AXES, thrusters, strict=False)
        names.update({axis: name for axis, name in pairs if axis in axes})
    return PilotTargets(vehicle=vehicle, axes=frozenset(axes), reason=reason, names=names)
