"""What a calibration is computed from: channels with their reference water, and readings."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from .estimate import Accuracy
from .forward_model import WaterNumbers
from .pure_water import compute_pure_absorption, compute_pure_scattering
from .readings import Reading
from .setup import ChannelSpec, SetupSpec


@dataclass(frozen=True, kw_only=True)
class OpenWaterReading:
    """The veil of the lamp in open water, in one channel."""

    channel: str
    """The name of the channel."""
    ratio: float
    """The radiance at the centre, over that of a white surface that 1 W/m^2 lights."""
    lamp_position: tuple[float, float, float]
    """The position of the lamp in the camera's frame [m]."""
    lamp_half_angle: float
    """The angle between the axis of the lamp and the edge of its cone [rad]."""


@dataclass(frozen=True, kw_only=True)
class WaterReadings:
    """The readings of one water."""

    name: str
    """The name of the water."""
    dose: float | None = None
    """The amount of dye or powder; None if unknown."""
    readings: tuple[Reading, ...] = ()
    """The readings of all channels."""
    open_water: tuple[OpenWaterReading, ...] = ()
    """The readings of the lamp's veil."""
    remarks: tuple[str, ...] = ()
    """The readings that were left out, and why."""


@dataclass(frozen=True, kw_only=True)
class Measurements:
    """The readings of a calibration, with the reference water of each channel."""

    references: dict[str, WaterNumbers]
    """The reference water by channel."""
    waters: tuple[WaterReadings, ...]
    """The waters."""
    accuracy: Accuracy = field(default_factory=Accuracy)
    """The standard deviations of what readings do not show."""


def make_measurements(setup: SetupSpec, waters: Sequence[WaterReadings]) -> Measurements:
    """Combine readings with the reference waters of a set-up."""
    accuracy = setup.accuracy
    return Measurements(
        references={channel.name: find_reference(channel) for channel in setup.channels},
        waters=tuple(waters),
        accuracy=Accuracy(
            reference=accuracy.reference, distance=accuracy.distance, drift=accuracy.drift
        ),
    )


def find_reference(channel: ChannelSpec) -> WaterNumbers:
    """Return the reference water of a channel: as given, else pure water at its wavelength."""
    absorption, scattering = channel.reference_absorption, channel.reference_scattering
    return WaterNumbers(
        compute_pure_absorption(channel.wavelength) if absorption is None else absorption,
        compute_pure_scattering(channel.wavelength) if scattering is None else scattering,
        1.0,
    )
