"""Waters by name, with the sources of their numbers.

The numbers are those of spectra, reduced to the three channels of an image and rounded to four
digits; `spectral.spectral_water` has the method and its errors. The types of N. G. Jerlov (*Marine
Optics*, 1976) are classes of diffuse attenuation: I to III in the open ocean, 1C to 9C at the
coast (`spectral.jerlov`). The order of the types is not that of beam attenuation: type III
scatters more than 1C. Give measured coefficients where they exist.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..errors import UnknownName
from .medium import Medium

Coefficients = tuple[float, float, float]

JERLOV_SOURCE = (
    "diffuse attenuation of Jerlov, Marine Optics (1976), and scattering of Solonenko and Mobley, "
    "Appl. Opt. 54, 5392 (2015)"
)
CLEAR_SOURCE = (
    "pure water: absorption of Pope and Fry, Appl. Opt. 36, 8710 (1997), scattering of sea water "
    "of Smith and Baker, Appl. Opt. 20, 177 (1981)"
)
POOL_SOURCE = "estimate: the absorption of pure water, and particles that scatter as 1/wavelength"


@dataclass(frozen=True, kw_only=True)
class NamedWater:
    """The numbers of a water, in red, green and blue."""

    description: str
    """A phrase for lists and error messages."""
    absorption: Coefficients
    """The absorption coefficients a [1/m]."""
    scattering: Coefficients
    """The scattering coefficients b [1/m]."""
    molecular_scattering: Coefficients
    """The part of the scattering that the molecules of the water cause [1/m]."""
    source: str
    """The source of the numbers."""


WATERS: dict[str, NamedWater] = {
    "jerlov-I": NamedWater(
        description="clearest ocean",
        absorption=(0.3423, 0.05388, 0.01718),
        scattering=(0.0006568, 0.002, 0.004613),
        molecular_scattering=(0.0005935, 0.001899, 0.004473),
        source=JERLOV_SOURCE,
    ),
    "jerlov-IA": NamedWater(
        description="ocean",
        absorption=(0.3476, 0.05821, 0.0239),
        scattering=(0.001606, 0.003553, 0.006706),
        molecular_scattering=(0.0005935, 0.001923, 0.004473),
        source=JERLOV_SOURCE,
    ),
    "jerlov-IB": NamedWater(
        description="ocean",
        absorption=(0.3462, 0.05811, 0.02575),
        scattering=(0.03492, 0.05502, 0.07724),
        molecular_scattering=(0.0005935, 0.001928, 0.004475),
        source=JERLOV_SOURCE,
    ),
    "jerlov-II": NamedWater(
        description="ocean",
        absorption=(0.3284, 0.05092, 0.02809),
        scattering=(0.236, 0.3659, 0.5023),
        molecular_scattering=(0.0005935, 0.001955, 0.00448),
        source=JERLOV_SOURCE,
    ),
    "jerlov-III": NamedWater(
        description="ocean, productive",
        absorption=(0.32, 0.05094, 0.0434),
        scattering=(0.6457, 1.011, 1.378),
        molecular_scattering=(0.0005935, 0.002028, 0.004512),
        source=JERLOV_SOURCE,
    ),
    "jerlov-1C": NamedWater(
        description="clearest coast",
        absorption=(0.3646, 0.08623, 0.193),
        scattering=(0.2379, 0.3795, 0.5224),
        molecular_scattering=(0.0005935, 0.002111, 0.004612),
        source=JERLOV_SOURCE,
    ),
    "jerlov-3C": NamedWater(
        description="coast",
        absorption=(0.3202, 0.09841, 0.2516),
        scattering=(0.7021, 1.099, 1.524),
        molecular_scattering=(0.0005935, 0.002101, 0.004673),
        source=JERLOV_SOURCE,
    ),
    "jerlov-5C": NamedWater(
        description="coast",
        absorption=(0.368, 0.1751, 0.3903),
        scattering=(0.9151, 1.376, 1.916),
        molecular_scattering=(0.0005935, 0.002083, 0.004698),
        source=JERLOV_SOURCE,
    ),
    "jerlov-7C": NamedWater(
        description="turbid coast",
        absorption=(0.3382, 0.2496, 0.6047),
        scattering=(1.716, 2.421, 3.41),
        molecular_scattering=(0.0007092, 0.002062, 0.004773),
        source=JERLOV_SOURCE,
    ),
    "jerlov-9C": NamedWater(
        description="harbour",
        absorption=(0.3411, 0.3851, 1.179),
        scattering=(2.466, 3.187, 4.583),
        molecular_scattering=(0.0009851, 0.002017, 0.004898),
        source=JERLOV_SOURCE,
    ),
    "clear": NamedWater(
        description="pure water, the reference of a calibration",
        absorption=(0.3201, 0.05037, 0.007591),
        scattering=(0.0005935, 0.001794, 0.0048),
        molecular_scattering=(0.0005935, 0.001794, 0.0048),
        source=CLEAR_SOURCE,
    ),
    "pool": NamedWater(
        description="filtered swimming pool",
        absorption=(0.3201, 0.05037, 0.007591),
        scattering=(0.0397, 0.05016, 0.06178),
        molecular_scattering=(0.0005935, 0.001794, 0.0048),
        source=f"{POOL_SOURCE}, 0.05 1/m at 550 nm",
    ),
    "tank": NamedWater(
        description="test tank",
        absorption=(0.3201, 0.05037, 0.007591),
        scattering=(0.1139, 0.144, 0.1773),
        molecular_scattering=(0.0005935, 0.001794, 0.0048),
        source=f"{POOL_SOURCE}, which give c = 0.2 1/m at 550 nm; test tanks have 0.1 to 0.3 1/m",
    ),
}
"""The waters by name."""


def find_water(name: str) -> Medium:
    """Return the water of a name, with the default phase function.

    Raises:
        UnknownName: no water has this name; the error message gives the nearest one.
    """
    water = WATERS.get(name)
    if water is None:
        raise UnknownName("water", name, WATERS)
    return Medium(
        absorption=water.absorption,
        scattering=water.scattering,
        molecular_scattering=water.molecular_scattering,
    )
