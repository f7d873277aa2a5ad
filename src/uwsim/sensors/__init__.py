"""Sensors, one file each."""

from .dvl_sensor import DvlSensorSpec
from .gps_sensor import GpsSensorSpec
from .imu import ImuSpec
from .multibeam_sensor import MultibeamSensorSpec
from .pressure_sensor import PressureSensorSpec
from .profiling_sonar import ProfilingSonarSpec
from .range_sensor import RangeSensorSpec
from .sensor import SensorSpec
from .structured_light_projector import StructuredLightProjectorSpec
from .virtual_camera import VirtualCameraSpec
from .virtual_range_image import VirtualRangeImageSpec

SENSORS: dict[str, type[SensorSpec]] = {
    "ProfilingSonar": ProfilingSonarSpec,
    "dvlSensor": DvlSensorSpec,
    "gpsSensor": GpsSensorSpec,
    "imu": ImuSpec,
    "multibeamSensor": MultibeamSensorSpec,
    "pressureSensor": PressureSensorSpec,
    "rangeSensor": RangeSensorSpec,
    "structuredLightProjector": StructuredLightProjectorSpec,
    "virtualCamera": VirtualCameraSpec,
    "virtualRangeImage": VirtualRangeImageSpec,
}
"""Element of a vehicle -> spec; one without ``bind`` is read and not simulated."""

__all__ = ["SENSORS", "SensorSpec"]
