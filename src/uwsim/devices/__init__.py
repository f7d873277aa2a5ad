"""Devices: what acts, touches or talks, one file each."""

from .comms import AcousticCommsDeviceSpec, CustomCommsDeviceSpec
from .dredge_tool import DredgeToolSpec
from .echo import EchoSpec
from .force_sensor import ForceSensorSpec
from .led_array import LedArraySpec
from .object_picker import ObjectPickerSpec

DEVICES: dict[str, type] = {
    "AcousticCommsDevice": AcousticCommsDeviceSpec,
    "CustomCommsDevice": CustomCommsDeviceSpec,
    "DredgeTool": DredgeToolSpec,
    "ForceSensor": ForceSensorSpec,
    "LedArray": LedArraySpec,
    "echo": EchoSpec,
    "objectPicker": ObjectPickerSpec,
}
"""Element of a vehicle -> spec."""

__all__ = ["DEVICES"]
