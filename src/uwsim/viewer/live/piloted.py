"""Which vehicle viewers pilot, by which axes; and what a scene lacks whose vehicles stay put."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ...algorithms.pilot import N_JOINTS, THRUSTER_AXES, TWIST_AXES
from ...simulation.stage import SceneStage
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

    def keys(self, mapping: PilotMapping) -> dict[str, str]:
        """Return the keys that do something, with their axes."""
        return {key: does for key, does in mapping.keys.items() if self._moves(does)}

    def sticks(self, mapping: PilotMapping) -> list[bool]:
        """Return whether the left and the right stick on the screen do something."""
        each = [self._moves(does) for does in mapping.sticks]
        return [any(each[:2]), any(each[2:])]

    def _moves(self, does: str) -> bool:
        return any(target.lstrip("+-") in self.axes for target in does.split())


def piloted_of(world: SceneStage, parameters: Mapping[str, float | str]) -> Piloted:
    """Return what a pilot with these parameters can move in a scene."""
    given = {name: str(value) for name, value in parameters.items()}
    topics = {given[name] for name in STEERING if given.get(name)}
    axes: set[str] = set()
    if given.get("twist_topic") or given.get("odom_topic"):
        axes.update(TWIST_AXES)
    if given.get("thrusters_topic"):
        axes.update(THRUSTER_AXES[: int(float(given.get("n_thrusters", 0)))])
    if given.get("joints_topic"):
        n_joints = len(given.get("joints", "").split()[:N_JOINTS])
        axes.update(f"joint{k}" for k in range(1, n_joints + 1))
        axes.update(["jaw"] if given.get("jaw", "").strip() else [])
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
        world.vehicles.index(name)
        for spec in world.scene.ros_interfaces
        if getattr(spec, "topic", None) in topics
        and (name := getattr(spec, "vehicle_name", None)) in world.vehicles
    ]
    return Piloted(vehicle=next(iter(steered), 0), axes=frozenset(axes), why=why)
