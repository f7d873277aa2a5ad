"""Which vehicle viewers pilot, by which axes; and what a scene lacks whose vehicles stay put."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...algorithms.pilot import N_JOINTS, THRUSTER_AXES, TWIST_AXES
from ...simulation.live_scene import LiveScene
from .mapping import PilotMapping

STEERING = ("twist_topic", "odom_topic", "thrusters_topic")
"""Parameters of `uwsim.algorithms.pilot.Pilot` that steer the vehicle."""


@dataclass(frozen=True, kw_only=True)
class Piloted:
    """What pilots can move."""

    vehicle: int
    """Number of the vehicle in the scene; 0 where none is steered."""
    axes: frozenset[str]
    """Those that do something, of `uwsim.algorithms.pilot.AXES`."""
    why: str
    """Why no vehicle can be steered; empty where one can be."""
    names: Mapping[str, str]
    """Axis -> name of what it moves in the files of the vehicle: of joints and thrusters."""

    def keys(self, mapping: PilotMapping) -> dict[str, str]:
        """Return the keys that do something, with their axes."""
        return {key: does for key, does in mapping.keys.items() if self._moves(does)}

    def sticks(self, mapping: PilotMapping) -> list[str]:
        """Return what the sticks on the screen move: left x, left y, right x, right y; or empty."""
        return [does if self._moves(does) else "" for does in mapping.sticks]

    def _moves(self, does: str) -> bool:
        return any(target.lstrip("+-") in self.axes for target in does.split())


def piloted_of(world: LiveScene, parameters: Mapping[str, float | str]) -> Piloted:
    """Return what a pilot with these parameters can move in a scene."""
    given = {name: str(value) for name, value in parameters.items()}
    topics = {given[name] for name in STEERING if given.get(name)}
    axes: set[str] = set()
    names: dict[str, str] = {}
    if given.get("twist_topic") or given.get("odom_topic"):
        axes.update(TWIST_AXES)
    if given.get("thrusters_topic"):
        axes.update(THRUSTER_AXES[: int(float(given.get("n_thrusters", 0)))])
    if given.get("joints_topic"):
        joints = enumerate(given.get("joints", "").split()[:N_JOINTS], start=1)
        names.update({f"joint{number}": name for number, name in joints})
        names.update({"jaw": jaw} if (jaw := given.get("jaw", "").strip()) else {})
        axes.update(names)
    if given.get("lamp_topics", "").strip():
        axes.add("lamps")
    why = ""
    if not world.vehicles:
        why = "Nothing can be piloted: the scene has no vehicle."
    elif not topics:
        why = (
            "No vehicle can be steered: the scene has no <ROSTwistToPAT> and no "
            "<u:ROSThrustersToPAT> in its <rosInterfaces>."
        )
    steered = [
        world.vehicles.names.index(name)
        for spec in world.model.scene.ros_interfaces
        if getattr(spec, "topic", None) in topics
        and (name := getattr(spec, "vehicle_name", None)) in world.vehicles.names
    ]
    vehicle = next(iter(steered), 0)
    if world.vehicles:
        thrusters = world.vehicles.find(world.vehicles.names[vehicle]).thrusters
        named = zip(THRUSTER_AXES, thrusters, strict=False)
        names.update({axis: name for axis, name in named if axis in axes})
    return Piloted(vehicle=vehicle, axes=frozenset(axes), why=why, names=names)
