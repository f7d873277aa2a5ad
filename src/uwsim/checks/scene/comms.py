"""Rules about the communication devices and channels of a scene."""

from __future__ import annotations

from collections.abc import Iterator

from ...base.expression import ScoreError
from ...devices.comms.acoustic_comms_device import AcousticCommsDeviceSpec
from ...devices.comms.comms_channels import (
    AcousticCommsChannelSpec,
    CustomCommsChannelSpec,
    acoustic_channel_name,
    custom_channel_name,
)
from ...devices.comms.custom_comms_device import CustomCommsDeviceSpec
from ...errors import Diagnostic
from ...model.parts import CommsDeviceSpec, comms_devices
from ...network import mac_kind
from ..subjects import CheckedScene

PROTOCOLS = "ALOHA, slottedALOHA, CSMA"


def communication(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report invalid formulas, and names and addresses that are unknown or used twice."""
    channels: set[str] = set()
    channel_specs: tuple[CustomCommsChannelSpec | AcousticCommsChannelSpec, ...]
    channel_specs = (*scene.spec.custom_comms_channels, *scene.spec.acoustic_comms_channels)
    for spec in channel_specs:
        if spec.name in channels:
            yield scene.warning(spec, f"several channels have the id {spec.id}; the first is used")
        channels.add(spec.name)
    names: dict[str, None] = {}
    addresses: dict[tuple[str, int], str] = {}
    for device in (unit for vehicle in scene.spec.vehicles for unit in comms_devices(vehicle)):
        if device.name in names:
            message = f"two devices are called {device.name!r}: they share their topics"
            yield scene.warning(device, message)
        names[device.name] = None
        for channel in _channels_of(device):
            if channel not in channels:
                kind, _, number = channel.partition("/")
                element = {"custom": "CustomCommsChannel", "acoustic": "AcousticCommsChannel"}[kind]
                message = f"{device.name!r}: no <{element}> has the id {number}"
                yield scene.warning(device, f"{message}; one with the defaults is used")
        key = (_channels_of(device)[-1], device.mac)
        if key in addresses:
            message = f"{device.name!r} has the address {device.mac} of {addresses[key]!r}"
            yield scene.warning(device, f"{message}: both receive packets that are sent to it")
        addresses.setdefault(key, device.name)
        protocol = device.mac_protocol
        if protocol is not None and mac_kind(protocol.name) is None:
            message = f"<macProtocol> is {protocol.name[:60]!r}; read as ALOHA; known: {PROTOCOLS}"
            yield scene.warning(protocol, message)
        model = device.rate_error_model if isinstance(device, CustomCommsDeviceSpec) else None
        if model is not None:
            try:
                model.parse()
            except ScoreError as error:
                yield scene.error(model, f"<errorRateExpr>: {error.message}")


def _channels_of(device: CommsDeviceSpec) -> tuple[str, ...]:
    if isinstance(device, AcousticCommsDeviceSpec):
        return (acoustic_channel_name(device.channel_id),)
    ids = device.tx_channel_id, device.rx_channel_id
    return tuple(dict.fromkeys(map(custom_channel_name, ids)))
