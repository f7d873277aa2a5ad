"""The spec of physical water, whose images follow radiative transfer instead of the fog law.

.. code-block:: xml

    <oceanState>
      <u:water law="physical">
        <u:type>jerlov-1C</u:type>
        <u:sun> <u:elevation>0.9</u:elevation> <u:azimuth>0.5</u:azimuth> </u:sun>
      </u:water>
    </oceanState>
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from ..base.geometry import Triple
from ..errors import BadSetting, ErrorCollector
from ..optics import (
    FournierForand,
    HenyeyGreenstein,
    Medium,
    PhaseFunction,
    PhaseTable,
    find_water,
)
from ..optics.medium import MAX_COEFFICIENT
from ..optics.phase_table import MIN_VALUE
from ..optics.spectral import SpectralWater, read_spectrum_table
from ..optics.spectral.spectral_water import N_WAVELENGTHS
from ..optics.water_file import read_water
from ..particles import ParticlesSpec
from ..schema import NAMESPACE, Numbers, Spec, element

TransferCurve = Literal["srgb", "linear"]
MAX_MARGIN = 0.5
"""The greatest margin of images, with which they have four times the pixels [1]."""
RIGHT_ANGLE = 1.5708
"""The greatest elevation of the sun [rad]: pi/2, rounded up to what files have."""
HALF_TURN = 3.1416
"""The greatest scattering angle [rad]: pi, rounded up to what files have."""
REPLACED_ELEMENTS = ("fog", "color", "attenuation")
"""The elements of ``<oceanState>`` that physical water replaces in images."""


@dataclass(frozen=True, kw_only=True)
class SunSpec(Spec):
    """A ``<u:sun>``: the light above the water's surface."""

    elevation: float = element(namespaced=True, default=0.9, minimum=0.0, maximum=RIGHT_ANGLE)
    """The elevation of the sun above the horizon [rad]."""
    azimuth: float = element(namespaced=True, default=1.3)
    """The direction of the sun from W's x axis towards y [rad]."""
    irradiance: float = element(namespaced=True, default=1.0, minimum=0.0, maximum=1e6)
    """The irradiance of a level surface above the water by sun and sky, 0 at night [1]."""
    sky_share: float = element(namespaced=True, default=0.3, minimum=0.0, maximum=1.0)
    """The share of the sky in the irradiance: 0.3 in clear weather, 1 under clouds [1]."""


@dataclass(frozen=True, kw_only=True)
class RipplesSpec(Spec):
    """A ``<u:ripples>``: short waves, which focus sunlight and exert no force."""

    wind_speed: float = element(namespaced=True, default=2.0, minimum=0.0, maximum=20.0)
    """The speed of the wind; a pool in a hall has 0 [m/s]."""
    direction: float = element(namespaced=True, default=0.0)
    """The direction in which the wind blows, from x of L towards y [rad]."""


@dataclass(frozen=True, kw_only=True)
class SkySpec(Spec):
    """A ``<u:sky>``: the air above the water."""

    visibility: float = element(namespaced=True, default=30e3, minimum=10.0, maximum=1e6)
    """The distance at which 2 % of the contrast to the horizon are left [m]."""


@dataclass(frozen=True, kw_only=True)
class PhaseFunctionSpec(Spec, ABC):
    """The spec of a phase function."""

    @property
    @abstractmethod
    def phase_function(self) -> PhaseFunction:
        """The phase function."""


@dataclass(frozen=True, kw_only=True)
class HenyeyGreensteinSpec(PhaseFunctionSpec):
    """A ``<u:henyeyGreenstein>``: the phase function of one parameter."""

    asymmetry: float = element(namespaced=True, default=0.9, minimum=0.0, maximum=0.999)
    """The mean cosine of the scattering angle [1]."""

    @property
    def phase_function(self) -> PhaseFunction:
        """The phase function."""
        return HenyeyGreenstein(self.asymmetry)


@dataclass(frozen=True, kw_only=True)
class FournierForandSpec(PhaseFunctionSpec):
    """A ``<u:fournierForand>``: the phase function of particles in the sea."""

    refractive_index: float = element(namespaced=True, default=1.10, minimum=1.01, maximum=1.35)
    """The refractive index of the particles relative to water [1]."""
    slope: float = element(namespaced=True, default=3.5835, minimum=3.05, maximum=4.95)
    """The slope of the distribution of their sizes [1]."""

    @property
    def phase_function(self) -> PhaseFunction:
        """The phase function."""
        return FournierForand(self.refractive_index, self.slope)


@dataclass(frozen=True, kw_only=True)
class PhaseTableSpec(PhaseFunctionSpec):
    """A ``<u:phaseTable>``: a measured phase function."""

    angles: Numbers = element(namespaced=True, minimum=0.0, maximum=HALF_TURN)
    """The 5 to 200 scattering angles, rising, from at most 10 to at least 150 degrees [rad]."""
    values: Numbers = element(namespaced=True, minimum=MIN_VALUE)
    """The value at each angle, 5 to 200 numbers [1/sr]."""

    @property
    def phase_function(self) -> PhaseFunction:
        """The phase function."""
        return PhaseTable(tuple(self.angles), tuple(self.values))


PHASE_FUNCTIONS: dict[str, type[PhaseFunctionSpec]] = {
    "fournierForand": FournierForandSpec,
    "henyeyGreenstein": HenyeyGreensteinSpec,
    "phaseTable": PhaseTableSpec,
}
"""The spec of each element of ``<u:phaseFunction>``."""


@dataclass(frozen=True, kw_only=True)
class WaterSpectrumSpec(Spec):
    """A ``<u:spectrum>``: coefficients by wavelength, of which images have three channels.

    The numbers are here, or in a table. Two of absorption, beam attenuation and scattering follow.
    """

    file: str = element(namespaced=True, default="")
    """The name of a table: a CSV file with the columns ``wavelength`` [nm] and two of
    ``absorption``, ``beam_attenuation`` and ``scattering`` [1/m]."""
    wavelengths: Numbers = element(
        namespaced=True, default=(), minimum=300.0, maximum=1000.0, max_count=N_WAVELENGTHS[1]
    )
    """The 3 to 1000 wavelengths, rising, from at most 450 to at least 620 [nm]."""
    absorption: Numbers = element(
        namespaced=True, default=(), maximum=MAX_COEFFICIENT, max_count=N_WAVELENGTHS[1]
    )
    """The absorption at each wavelength [1/m]."""
    beam_attenuation: Numbers = element(
        namespaced=True, default=(), maximum=MAX_COEFFICIENT, max_count=N_WAVELENGTHS[1]
    )
    """The beam attenuation at each wavelength [1/m]."""
    scattering: Numbers = element(
        namespaced=True, default=(), maximum=MAX_COEFFICIENT, max_count=N_WAVELENGTHS[1]
    )
    """The scattering at each wavelength [1/m]."""
    excludes_water: bool = element(namespaced=True, default=False)
    """True if the numbers are those of what the water contains, such as from an ac-s that was set
    to zero in pure water; then absorption and scattering of pure sea water are added."""

    def read_medium(self, find: Callable[[str], Path]) -> Medium:
        """Return the water in three channels; its table is read.

        Args:
            find: finds the path of a file.

        Raises:
            UwsimError: the numbers are inconsistent, or the table is missing or invalid.
        """
        if bool(self.file) == bool(self.wavelengths):
            number = "both" if self.file else "none"
            raise BadSetting(
                f"The spectrum has {number} of <u:file> and <u:wavelengths>; expected one of them."
            )
        columns: dict[str, tuple[float, ...]] = {
            "wavelength": tuple(self.wavelengths),
            "absorption": tuple(self.absorption),
            "beam_attenuation": tuple(self.beam_attenuation),
            "scattering": tuple(self.scattering),
        }
        given_columns = [name for name in columns if columns[name] and name != "wavelength"]
        if len(given_columns) != (0 if self.file else 2):
            raise BadSetting(
                f"The spectrum has {' and '.join(given_columns) or 'no coefficients'}; expected "
                "two of <u:absorption>, <u:beamAttenuation> and <u:scattering> beside "
                "<u:wavelengths>, or a <u:file> alone."
            )
        if self.file:
            columns |= read_spectrum_table(find(self.file))
        return self._combine_columns(columns).reduce()

    def _combine_columns(self, columns: dict[str, tuple[float, ...]]) -> SpectralWater:
        absorption, attenuation, scattering = (
            columns[name] for name in ("absorption", "beam_attenuation", "scattering")
        )
        lengths = {len(values) for values in columns.values() if values}
        if len(lengths) > 1:
            raise BadSetting(
                f"The columns of the spectrum have {' and '.join(map(str, sorted(lengths)))} "
                "values; expected one of each for every wavelength."
            )
        if attenuation:
            column = absorption or scattering
            remainder = tuple(c - value for c, value in zip(attenuation, column, strict=True))
            absorption, scattering = absorption or remainder, scattering or remainder
        make = SpectralWater.from_contents if self.excludes_water else SpectralWater
        return make(wavelengths=columns["wavelength"], absorption=absorption, scattering=scattering)


@dataclass(frozen=True, kw_only=True)
class PhysicalWaterSpec(Spec):
    """A ``<u:water law="physical">``: the optical properties of the water, and its light.

    They replace fog, colour and attenuation of the ``<oceanState>`` in images. The water is one of
    a named water (``type``), a water file (``file``), a spectrum, and coefficients.
    """

    law: Literal["physical"] = element(attribute=True)
    """The law of the images."""
    type: str = element(namespaced=True, default="")
    """The name of a water, such as ``jerlov-1C``, ``tank`` or ``clear``."""
    file: str = element(namespaced=True, default="")
    """The name of a water file, such as `uwsim calibrate` writes."""
    spectrum: WaterSpectrumSpec | None = element(namespaced=True, default=None)
    """The coefficients by wavelength."""
    absorption: Triple | None = element(
        namespaced=True, default=None, parts="rgb", minimum=0.0, maximum=MAX_COEFFICIENT
    )
    """The absorption of red, green and blue [1/m]."""
    beam_attenuation: Triple | None = element(
        namespaced=True, default=None, parts="rgb", minimum=0.0, maximum=MAX_COEFFICIENT
    )
    """The beam attenuation of red, green and blue instead of the absorption [1/m]."""
    scattering: Triple | None = element(
        namespaced=True, default=None, parts="rgb", minimum=0.0, maximum=MAX_COEFFICIENT
    )
    """The scattering of red, green and blue [1/m]."""
    phase_function: tuple[PhaseFunctionSpec, ...] = element(
        namespaced=True, default=(),
        choice={f"{{{NAMESPACE}}}{name}": spec for name, spec in PHASE_FUNCTIONS.items()},
    )  # fmt: skip
    """The phase function instead of that of the water; by default Fournier and Forand's for sea
    water."""
    sun: SunSpec = element(namespaced=True, default=SunSpec())
    """The light above the surface."""
    sky: SkySpec = element(namespaced=True, default=SkySpec())
    """The air above the water."""
    surface: bool = element(namespaced=True, default=True)
    """True if images show the water's surface, and the sky and the air above it; without it the
    water fills them."""
    mirror: bool = element(namespaced=True, default=True)
    """True if the surface mirrors bodies on the side of the camera; without it, it mirrors open
    water, and those bodies above it that are in the picture."""
    exposure: float | None = element(
        namespaced=True, default=None, exclusive_minimum=0.0, maximum=1e9
    )
    """The ratio of linear full scale to light [1]; a white surface in the irradiance 1 has the
    light 1. Without it, the brightest of these has 0.7 of linear full scale: a white board that
    faces up at the depth of the first vehicle's start, open water there, and a board 4 m from the
    strongest lamp or projector, with the veil of the lamp. Without any light it is 1."""
    transfer: TransferCurve = element(namespaced=True, default="srgb")
    """The curve of stored values: sRGB, or linear."""
    blur: bool = element(namespaced=True, default=True)
    """True if light that is scattered forward blurs images."""
    blur_margin: float = element(namespaced=True, default=0.0, minimum=0.0, maximum=MAX_MARGIN)
    """The share of the image that is drawn beyond each of its edges, so that scattered light of
    what is outside reaches it [1]."""
    lamp_veil: bool = element(namespaced=True, default=True)
    """True if the water scatters the light of lamps into cameras."""
    particles: ParticlesSpec | None = element(namespaced=True, default=None)
    """The particles that cameras see; when absent there are none."""
    ripples: RipplesSpec | None = element(namespaced=True, default=None)
    """The ripples of the surface. Without it, a scene with waves has those of a wind of 2 m/s, and
    a scene without waves has none."""
    caustics: bool = element(namespaced=True, default=True)
    """True if waves and ripples focus sunlight on surfaces."""
    light_shafts: bool = element(namespaced=True, default=True)
    """True if waves and ripples focus the sunlight that the water scatters into cameras."""

    def read_medium(self, find: Callable[[str], Path]) -> Medium:
        """Return the water; its file is read.

        Args:
            find: finds the path of a file.

        Raises:
            UwsimError: the numbers are inconsistent, a name is unknown, or the file is missing or
                invalid.
        """
        errors = ErrorCollector()
        medium = phase_function = None
        with errors.collect():
            medium = self.read_source(find)
        with errors.collect():
            phase_function = self.read_phase_function()
        errors.raise_errors()
        assert medium is not None
        return medium if phase_function is None else replace(medium, phase_function=phase_function)

    def read_source(self, find: Callable[[str], Path]) -> Medium:
        """Return the water of the type, the file or the coefficients, with its phase function.

        Args:
            find: finds the path of a file.

        Raises:
            UwsimError: the numbers are inconsistent, a name is unknown, or the file is missing or
                invalid; also those of a source beside another.
        """
        errors = ErrorCollector()
        medium = None
        with errors.collect():
            self._check_sources()
        readers: tuple[tuple[bool, Callable[[], Medium]], ...] = (
            (bool(self.type), lambda: find_water(self.type)),
            (bool(self.file), lambda: read_water(find(self.file)).medium),
            (self.spectrum is not None, lambda: self._read_spectrum(find)),
            (self._has_coefficients, self._combine_coefficients),
        )
        for is_given, read in readers:
            if is_given:
                with errors.collect():
                    medium = read()
        errors.raise_errors()
        assert medium is not None
        return medium

    @property
    def _has_coefficients(self) -> bool:
        values = (self.absorption, self.beam_attenuation, self.scattering)
        return any(value is not None for value in values)

    def _check_sources(self) -> None:
        """Raise BadSetting unless the numbers have one source."""
        sources = {
            "<u:type>": bool(self.type),
            "<u:file>": bool(self.file),
            "<u:spectrum>": self.spectrum is not None,
            "coefficients": self._has_coefficients,
        }
        names = [name for name, is_given in sources.items() if is_given]
        if len(names) != 1:
            raise BadSetting(
                f"The water has {' and '.join(names) or 'no numbers'}; expected one of <u:type>, "
                "<u:file>, <u:spectrum>, and coefficients (<u:absorption> or <u:beamAttenuation>, "
                "and <u:scattering>)."
            )

    def read_phase_function(self) -> PhaseFunction | None:
        """Return the phase function of the element; None if there is no element.

        Raises:
            BadSetting: the element has none or several.
            UwsimError: its numbers are invalid.
        """
        source = self.source_line
        is_given = source is not None and f"{{{NAMESPACE}}}phaseFunction" in source.elements
        if not self.phase_function and not is_given:
            return None
        if len(self.phase_function) != 1:
            raise BadSetting(
                f"<u:phaseFunction> has {len(self.phase_function)} phase functions; expected one "
                f"of {', '.join(f'<u:{name}>' for name in PHASE_FUNCTIONS)}.",
                name="phaseFunction",
            )
        return self.phase_function[0].phase_function

    def _read_spectrum(self, find: Callable[[str], Path]) -> Medium:
        assert self.spectrum is not None
        return self.spectrum.read_medium(find)

    def _combine_coefficients(self) -> Medium:
        attenuations = (self.absorption, self.beam_attenuation)
        if self.scattering is None or sum(value is not None for value in attenuations) != 1:
            raise BadSetting(
                "Coefficients of water are <u:scattering> and one of <u:absorption> and "
                "<u:beamAttenuation>."
            )
        if self.absorption is not None:
            return Medium(absorption=self.absorption, scattering=self.scattering)
        assert self.beam_attenuation is not None
        return Medium.from_beam_attenuation(self.beam_attenuation, self.scattering)
