"""Consistency checks of the communication devices of a scene."""

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
    """Report formulas that cannot be read, and names and addresses that lead nowhere or twice."""
    channels: set[str] = set()
    given: tuple[CustomCommsChannelSpec | AcousticCommsChannelSpec, ...]
    given = (*scene.spec.custom_comms_channels, *scene.spec.acoustic_comms_channels)
    for each in given:
        if each.name in channels:
            yield scene.warning(each, f"several channels have the id {each.id}; the first is used")
        channels.add(each.name)
    names: dict[str, None] = {}
    addresses: dict[tuple[str, int], str] = {}
    for device in (one for vehicle in scene.spec.vehicles for one in comms_devices(vehicle)):
        if device.name in names:
            said = f"two devices are called {device.name!r}: they share their topics"
            yield scene.warning(device, said)
        names[device.name] = None
        for channel in _channels_of(device):
            if channel not in channels:
                kind, _, number = channel.partition("/")
                element = {"custom": "CustomCommsChannel", "acoustic": "AcousticCommsChannel"}[kind]
                said = f"{device.name!r}: no <{element}> has the id {number}"
                yield scene.warning(device, f"{said}; one with the defaults is used")
        key = (_channels_of(device)[-1], device.mac)
        if key in addresses:
            said = f"{device.name!r} has the address {device.mac} of {addresses[key]!r}"
            yield scene.warning(device, f"{said}: both receive what is sent to it")
        addresses.setdefault(key, device.name)
        protocol = device.mac_protocol
        if protocol is not None and mac_kind(protocol.name) is None:
            said = f"<macProtocol> is {protocol.name[:60]!r}; read as ALOHA; known: {PROTOCOLS}"
            yield scene.warning(protocol, said)
        model = device.rate_error_model if isinstance(device, CustomCommsDeviceSpec) else None
        if model is not None:
            try:
                model.parse()
            except ScoreError as error:
                yield scene.error(model, f"<errorRateExpr>: {error.message}")


def _channels_of(device: CommsDeviceSpec) -> tuple[str, ...]:
    if isinstance(device, AcousticCommsDeviceSpec):
        return (acoustic_channel_name(device.channel_id),)
    sends, listens = (
        custom_channel_name(device.tx_channel_id),
        custom_channel_name(device.rx_channel_id),
    )
    return (sends,) if sends == listens else (sends, listens)
