"""The devices of a scene, bound in the file's order."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..assets.pattern import read_pattern
from ..devices.device import Device, DeviceSpec
from ..devices.lamp import MountedLamp
from ..devices.led_array import Led, LedArray
from ..devices.structured_light_projector import MountedProjector
from ..errors import AssetNotFound, SceneError, UnknownName
from ..model.robots import find_file
from ..schema import diagnostic_at
from ..sensors.sensor import Sensor
from ..world import DeviceWorld
from .vehicles import SceneVehicle
from .world_views.device_view import DeviceView

if TYPE_CHECKING:
    from .live_scene import LiveScene


def bind_devices(scene: LiveScene) -> Iterator[Device]:
    """Bind the devices of a scene; those that measure are sensors, and lamps shine.

    Raises:
        SceneError: one names what is not there; with its line.
    """
    world = DeviceView(scene)
    lamps: list[MountedLamp] = []
    leds: list[Led] = []
    projectors: list[MountedProjector] = []
    for spec, vehicle in zip(scene.model.scene.vehicles, scene.vehicles, strict=True):
        for element, part in spec.all_parts():
            if isinstance(part, DeviceSpec):
                device = _bound_device(element, part, world, vehicle)
                if device is None:
                    continue
                yield device
                if isinstance(device, Sensor):
                    scene.sensors.add(element, getattr(part, "name", ""), device)
                if isinstance(device, MountedLamp) and not spec.vr:
                    lamps.append(device)
                if isinstance(device, LedArray) and not spec.vr:
                    leds.extend(device.leds)
                if isinstance(device, MountedProjector) and not spec.vr:
                    projectors.append(device)
    scene.scenery.set_lamps(lamps, leds)
    for projector in projectors[-1:]:
        _set_projector(scene, projector)


def _bound_device(
    element: str, spec: DeviceSpec, world: DeviceWorld, vehicle: SceneVehicle
) -> Device | None:
    try:
        return spec.bind(world, vehicle)
    except UnknownName as error:
        if spec.is_left_out:
            return None
        if spec.source_line is None:
            raise
        raise SceneError([diagnostic_at(spec, f"<{element}>: {error}")]) from error


def _set_projector(scene: LiveScene, projector: MountedProjector) -> None:
    """Load its image; in a scene of the original one without its image shines nothing."""
    spec = scene.model.scene
    try:
        path = find_file(projector.spec.image_name, spec.path, scene.model.data_path)
    except AssetNotFound:
        if not spec.is_original:
            raise
        return
    scene.files[path.name] = path
    scene.scenery.set_projector(projector, read_pattern(path))
