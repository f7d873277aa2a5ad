"""The devices of a scene: they are bound in the file's order, then lamps and projectors are set."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ..assets.pattern import read_pattern
from ..devices.device import Device, DeviceSpec
from ..devices.lamp import MountedLamp
from ..devices.led_array import LedArray
from ..devices.motion.follow_pose import PoseFollower
from ..devices.motion.scripted_motion import ScriptedMotion
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
    """Bind the devices of a scene; some of them are also sensors or lamps.

    Args:
        scene: the scene.
        sensors: the sensors of the scene; devices that measure are added to them.
        world: the view of the scene for devices.

    Returns:
        The devices, and the paths of the files that they read, by file name.

    Raises:
        SceneError: a device names a missing part; the error has the line of the device in the file.
    """
    devices: list[Device] = []
    visible_devices: list[Device] = []
    for spec, vehicle in zip(scene.model.scene.vehicles, scene.vehicles, strict=True):
        for element, part in spec.all_parts():
            if not isinstance(part, DeviceSpec):
                continue
            device = _bind(element, part.complete(spec.parts), world, vehicle)
            if device is None:
                continue
            devices.append(device)
            if isinstance(device, Sensor):
                sensors.add(element, getattr(part, "name", ""), device)
            if not spec.vr:
                visible_devices.append(device)
    _stop_sensors(sensors, devices)
    files = {**_set_lights(scene, visible_devices), **_read_motions(scene, devices)}
    return tuple(devices), files


def _bind(
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


def _stop_sensors(sensors: SceneSensors, devices: Sequence[Device]) -> None:
    """Let no sensor publish while a vehicle whose poses it requires has stale ones."""
    followers = [device for device in devices if isinstance(device, PoseFollower)]
    stopping_followers = [item for item in followers if item.spec.on_timeout == "stop"]
    if stopping_followers:
        sensors.is_silent = lambda: any(follower.is_stale for follower in stopping_followers)


def _read_motions(scene: PhysicalScene, devices: Sequence[Device]) -> dict[str, Path]:
    """Read the tables of scripted motions; return their paths by file name."""
    files = dict[str, Path]()
    for device in devices:
        if isinstance(device, ScriptedMotion) and device.spec.file:
            path = find_file(device.spec.file, scene.model.scene.path, scene.model.data_path)
            device.follow(device.spec.read(path))
            files[path.name] = path
    return files


def _set_lights(scene: PhysicalScene, devices: Sequence[Device]) -> dict[str, Path]:
    """Pass lamps, signal lamps and the last projector to the renderer; return the pattern file.

    In a scene of the original UWSim, a projector whose image is missing emits no light.
    """
    lamps = [device for device in devices if isinstance(device, MountedLamp)]
    led_arrays = [device for device in devices if isinstance(device, LedArray)]
    scene.scenery.set_lamps(lamps, [led for device in led_arrays for led in device.leds])
    spec, files = scene.model.scene, dict[str, Path]()
    for projector in [device for device in devices if isinstance(device, MountedProjector)][-1:]:
        try:
            path = find_file(projector.spec.image_name, spec.path, scene.model.data_path)
        except AssetNotFound:
            if not spec.is_original:
                raise
            continue
        files[path.name] = path
        scene.scenery.set_projector(projector, read_pattern(path))
    return files
