"""Errors about the outputs of ``<u:px4>``: the thrusters that they command."""

from __future__ import annotations

from collections.abc import Iterator

from ...devices.px4 import Px4Spec
from ...devices.px4.px4 import Motors
from ...errors import Diagnostic, UwsimError
from ..subjects import CheckedScene


def check_motors(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report outputs of unknown thrusters, too many of them, and vehicles without thrusters."""
    for index, vehicle in enumerate(scene.spec.vehicles):
        for spec in vehicle.parts_of(Px4Spec):
            if vehicle.dynamics is None:
                message = f"<u:px4>: {vehicle.name} has no dynamics, so PX4 cannot drive it."
                yield scene.error(spec, message)
                continue
            names = scene.thruster_names(index)
            if names is None:
                continue
            unknown_names = [n for n in spec.motor if n.removeprefix("-") not in names]
            for name in unknown_names:
                near = scene.diagnostics.suggest(name.removeprefix("-"), names)
                message = f"<u:px4>: no thruster is called {name.removeprefix('-')!r}.{near}"
                yield scene.error(spec, message, "motor")
            if not unknown_names:
                try:
                    Motors(spec.motor, names)
                except UwsimError as error:
                    yield scene.error(spec, str(error), "motor")
