"""Services of simulation_interfaces, with which ROS 2 programs control simulators.

Their classes are generated from the ``.msg`` and ``.srv`` files in ``simulation_interfaces/``; the
names and order of fields and the codes are those of the ROS 2 package.
"""

from __future__ import annotations

from . import simulation_interfaces
from .services import Service
from .simulation_interfaces import *  # noqa: F403

PACKAGE = "simulation_interfaces"
MAX_STEPS = 10_000_000
"""The maximum number of steps of one ``StepSimulation``."""
MESSAGES: tuple[type, ...] = tuple(
    kind
    for kind in vars(simulation_interfaces).values()
    if getattr(kind, "__module__", "") == simulation_interfaces.__name__
    and "/msg/" in kind.__msgtype__
)
"""The message types of the package."""
SIMULATION_SERVICES: dict[str, Service] = {
    f"{PACKAGE}/srv/{name}": Service(
        f"{PACKAGE}/srv/{name}",
        getattr(simulation_interfaces, name),
        getattr(simulation_interfaces, f"{name}Response"),
    )
    for name in (
        "GetSimulatorFeatures",
        "GetSimulationState",
        "SetSimulationState",
        "StepSimulation",
        "ResetSimulation",
        "GetEntities",
        "GetEntityState",
        "SetEntityState",
        "SpawnEntity",
        "DeleteEntity",
    )
}
"""The service types of the package, by their names in ROS 2."""
