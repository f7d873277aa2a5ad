"""Errors about the lamps and rangefinders of ``<u:ardupilot>``."""

from __future__ import annotations

from collections.abc import Iterator

from ...autopilots.ardupilot.answer import N_RANGES
from ...devices.ardupilot import ArduPilotSpec
from ...devices.lamp import LampSpec
from ...errors import Diagnostic
from ..subjects import CheckedScene


def check_wiring(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report channels of unknown lamps, and more rangefinders than ArduPilot reads."""
    lamps = {lamp.name for v in scene.spec.vehicles for lamp in v.parts_of(LampSpec)}
    for vehicle in scene.spec.vehicles:
        for spec in vehicle.parts_of(ArduPilotSpec):
            for channel in spec.channels:
                if channel.lamp is not None and channel.lamp not in lamps:
                    near = scene.diagnostics.suggest(channel.lamp, lamps)
                    yield scene.error(channel, f"No lamp is called {channel.lamp!r}.{near}", "lamp")
            if len(spec.rangefinders) > N_RANGES:
                message = f"{len(spec.rangefinders)} <rangefinder>: ArduPilot reads {N_RANGES}."
                yield scene.error(spec, message, "rangefinder")
