"""Thrusters that fail when the scene says so."""

from __future__ import annotations

from ..devices.thruster_fault import ThrusterFaultSpec
from ..physics.state import State
from ..scene.spec import SceneSpec


class ThrusterFaults:
    """The ``<u:fault>`` of all vehicles at work."""

    def __init__(self, scene: SceneSpec, state: State) -> None:
        """Find the thrusters; `read_dynamics` has looked their names up."""
        self._state = state
        self._faults: dict[tuple[int, int], list[ThrusterFaultSpec]] = {}
        for index, vehicle in enumerate(scene.vehicles):
            names = state.thrusters(index)
            for fault in vehicle.faults:
                key = (index, names.index(fault.thruster))
                self._faults.setdefault(key, []).append(fault)

    def apply(self, time: float) -> None:
        """Set the losses of the step that begins at ``time`` [s]."""
        for (vehicle, thruster), faults in self._faults.items():
            losses = [fault.loss for fault in faults if fault.acts(time + 1e-9)]
            self._state.set_loss(vehicle, thruster, max(losses, default=0.0))
