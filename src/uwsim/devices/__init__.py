"""Devices of vehicles, such as lamps, batteries, faults, object pickers, modems; one file each."""

from ..schema import NAMESPACE
from .ardupilot import ArduPilotSpec
from .battery import BatterySpec
from .comms.acoustic_comms_device import AcousticCommsDeviceSpec
from .comms.custom_comms_device import CustomCommsDeviceSpec
from .dredge_tool import DredgeToolSpec
from .echo import EchoSpec
from .fault import FaultSpec
from .force_sensor import ForceSensorSpec
from .lamp import LampSpec
from .led_array import LedArraySpec
from .mavlink import MavlinkSpec
from .motion.follow_pose import FollowPoseSpec
from .motion.scripted_motion import ScriptedMotionSpec
from .motor_currents import MotorCurrentsSpec
from .object_picker import ObjectPickerSpec
from .px4 import Px4Spec
from .streams.actuator_stream import ActuatorStreamSpec
from .streams.instrument_stream import InstrumentStreamSpec
from .structured_light_projector import StructuredLightProjectorSpec
from .sway import SwaySpec
from .topic_link import TopicLinkSpec

DEVICES: dict[str, type] = {
    "AcousticCommsDevice": AcousticCommsDeviceSpec,
    "CustomCommsDevice": CustomCommsDeviceSpec,
    "DredgeTool": DredgeToolSpec,
    "ForceSensor": ForceSensorSpec,
    "LedArray": LedArraySpec,
    "echo": EchoSpec,
    "objectPicker": ObjectPickerSpec,
    "structuredLightProjector": StructuredLightProjectorSpec,
    f"{{{NAMESPACE}}}lamp": LampSpec,
    f"{{{NAMESPACE}}}sway": SwaySpec,
    f"{{{NAMESPACE}}}scriptedMotion": ScriptedMotionSpec,
    f"{{{NAMESPACE}}}followPose": FollowPoseSpec,
    f"{{{NAMESPACE}}}fault": FaultSpec,
    f"{{{NAMESPACE}}}battery": BatterySpec,
    f"{{{NAMESPACE}}}motorCurrents": MotorCurrentsSpec,
    f"{{{NAMESPACE}}}ardupilot": ArduPilotSpec,
    f"{{{NAMESPACE}}}px4": Px4Spec,
    f"{{{NAMESPACE}}}mavlink": MavlinkSpec,
    f"{{{NAMESPACE}}}instrumentStream": InstrumentStreamSpec,
    f"{{{NAMESPACE}}}actuatorStream": ActuatorStreamSpec,
    f"{{{NAMESPACE}}}topicLink": TopicLinkSpec,
}
"""The spec of each device element of a vehicle; extensions of UWSim's dialect are last."""

__all__ = ["DEVICES"]
