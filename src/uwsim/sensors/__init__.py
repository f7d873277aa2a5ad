"""Sensors, one file each: the spec of the XML element, and the sensor that is bound from it.

`SENSORS` lists them. The interface that publishes a sensor on a topic is in `uwsim.topics`;
docs/adding-a-sensor.md shows how to add one.
"""

from ..schema import NAMESPACE
from .dvl_sensor import DvlSensorSpec
from .gps_sensor import GpsSensorSpec
from .imu import ImuSpec
from .pressure_sensor import PressureSensorSpec
from .range_sensor import RangeSensorSpec
from .sensor import SensorSpec
from .sonar.imaging_sonar import ImagingSonarSpec
from .sonar.multibeam_sensor import MultibeamSensorSpec
from .sonar.profiling_sonar import ProfilingSonarSpec
from .sonar.scanning_sonar import ScanningSonarSpec
from .sonar.side_scan_sonar import SideScanSonarSpec
from .usbl import UsblSpec
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
    "virtualCamera": VirtualCameraSpec,
    "virtualRangeImage": VirtualRangeImageSpec,
    f"{{{NAMESPACE}}}imagingSonar": ImagingSonarSpec,
    f"{{{NAMESPACE}}}scanningSonar": ScanningSonarSpec,
    f"{{{NAMESPACE}}}sideScanSonar": SideScanSonarSpec,
    f"{{{NAMESPACE}}}usbl": UsblSpec,
}
"""The spec of each sensor element; elements whose spec has no ``bind`` are not simulated."""

__all__ = ["SENSORS", "SensorSpec"]
