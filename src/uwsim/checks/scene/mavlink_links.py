"""Errors about ``<u:mavlink>``: addresses, and names that several devices have."""

from __future__ import annotations

from collections.abc import Iterator

from ...devices.mavlink import MavlinkSpec
from ...errors import Diagnostic, UwsimError
from ...schema import line_of
from ...world.addresses import parse_address
from ..subjects import CheckedScene


def check_links(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report invalid addresses, and devices with the name of an earlier one."""
    owners: dict[str, MavlinkSpec] = {}
    for vehicle in scene.spec.vehicles:
        for spec in vehicle.parts_of(MavlinkSpec):
            try:
                parse_address(spec.complete(vehicle.parts).address)
            except UwsimError as error:
                yield scene.error(spec, f"<u:mavlink>: <address>: {error}", "address")
            other = owners.setdefault(spec.name.strip("/"), spec)
            if other is not spec:
                line = f" (line {line_of(other)})" if line_of(other) else ""
                message = (
                    f"<u:mavlink>: {spec.name!r} is the name of another <u:mavlink>{line}; "
                    "expected a <name> of its own, because its topics begin with it"
                )
                yield scene.error(spec, message, "name")
