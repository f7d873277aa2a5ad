"""The devices of a scene, bound in the file's order, and the light of those that shine."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..assets.pattern import read_pattern
from ..devices.device import Device, DeviceSpec
from ..devices.lamp import MountedLamp
from ..devices.led_array import LedArray
from ..devices.structured_light_projector import MountedProjector
from ..errors import AssetNotFound, SceneError, UnknownName
from ..model.robots import find_file
from ..schema import diagnostic_at
from ..sensors.sensor import Sensor
from ..world import DeviceWorld
from .physical_scene import PhysicalScene
from .scene_sensors import SceneSensors
from .vehicles import SceneVehicle


def bind_devices(
    scene: PhysicalScene, sensors: SceneSensors, world: DeviceWorld
) -> tuple[tuple[Device, ...], dict[str, Path]]:
    """Bind the devices of a scene; those that measure are sensors, and lamps shine.

    Args:
        scene: the scene.
        sensors: get the devices that measure.
        world: the scene as devices see it.

    Returns:
        The devices, and the files that they read, by name.

    Raises:
        SceneError: one names what is not there; with its line.
    """
    devices: list[Device] = []
    visible: list[Device] = []
    for spec, vehicle in zip(scene.model.scene.vehicles, scene.vehicles, strict=True):
        for element, part in spec.all_parts():
            if not isinstance(part, DeviceSpec):
                continue
            device = _bound(element, part, world, vehicle)
            if device is None:
                continue
            devices.append(device)
            if isinstance(device, Sensor):
                sensors.add(element, getattr(part, "name", ""), device)
            if not spec.vr:
                visible.append(device)
    return tuple(devices), _light(scene, visible)


def _bound(
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


def _light(scene: PhysicalScene, devices: Sequence[Device]) -> dict[str, Path]:
    """Let lamps, signal lamps and the last projector shine; return the file of its pattern.

    In a scene of the original a projector without its image does not shine.
    """
    lamps = [each for each in devices if isinstance(each, MountedLamp)]
    arrays = [each for each in devices if isinstance(each, LedArray)]
    scene.scenery.set_lamps(lamps, [led for each in arrays for led in each.leds])
    spec, files = scene.model.scene, dict[str, Path]()
    for projector in [each for each in devices if isinstance(each, MountedProjector)][-1:]:
        try:
            path = find_file(projector.spec.image_name, spec.path, scene.model.data_path)
        except AssetNotFound:
            if not spec.is_original:
                raise
            continue
        files[path.name] = path
        scene.scenery.set_projector(projector, read_pattern(path))
    return files
