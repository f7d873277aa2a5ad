"""Waters by name, with the sources of their numbers.

The effective wavelengths of the channels are 680 nm (red), 550 nm (green) and 440 nm (blue). The
types of N. G. Jerlov (*Marine Optics*, 1976) are classes of diffuse attenuation: I to III in the
open ocean, 1C to 9C at the coast. Their absorption and scattering here are those of M. G. Solonenko
and C. D. Mobley (*Appl. Opt.* 54, 5392 (2015)) as the simulator Stonefish ships them. Kirk's
diffuse attenuation of these agrees with Jerlov's at 550 nm within 25 %. The order of the types is
not that of beam attenuation: type III scatters more than 1C.

The red channel of type I at 680 nm has the absorption of pure water, 0.46 1/m; a camera's red
channel at 620 nm would have about 0.28 1/m. Give measured coefficients where they exist.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..errors import UnknownName
from .medium import Medium

Coefficients = tuple[float, float, float]

JERLOV_SOURCE = (
    "Solonenko and Mobley, Appl. Opt. 54, 5392 (2015), as decoded from the table of Stonefish"
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
    source: str
    """The source of the numbers."""


def _jerlov(description: str, absorption: Coefficients, scattering: Coefficients) -> NamedWater:
    return NamedWater(
        description=description,
        absorption=absorption,
        scattering=scattering,
        source=JERLOV_SOURCE,
    )


WATERS: dict[str, NamedWater] = {
    "jerlov-I": _jerlov("clearest ocean", (0.460, 0.062, 0.018), (0.001, 0.002, 0.004)),
    "jerlov-IA": _jerlov("ocean", (0.461, 0.062, 0.022), (0.002, 0.0035, 0.007)),
    "jerlov-IB": _jerlov("ocean", (0.461, 0.062, 0.024), (0.043, 0.054, 0.070)),
    "jerlov-II": _jerlov("ocean", (0.462, 0.062, 0.025), (0.250, 0.358, 0.524)),
    "jerlov-III": _jerlov("ocean, productive", (0.465, 0.065, 0.041), (0.683, 0.980, 1.433)),
    "jerlov-1C": _jerlov("clearest coast", (0.480, 0.076, 0.120), (0.254, 0.365, 0.534)),
    "jerlov-3C": _jerlov("coast", (0.484, 0.082, 0.182), (0.741, 1.060, 1.559)),
    "jerlov-5C": _jerlov("coast", (0.520, 0.117, 0.347), (0.929, 1.330, 1.942)),
    "jerlov-7C": _jerlov("turbid coast", (0.578, 0.195, 0.620), (1.639, 2.350, 3.427)),
    "jerlov-9C": _jerlov("harbour", (0.621, 0.348, 1.055), (2.172, 3.120, 4.561)),
    "clear": NamedWater(
        description="pure water, the reference of a calibration",
        absorption=(0.465, 0.0565, 0.00635),
        scattering=(0.0007, 0.0019, 0.0049),
        source=CLEAR_SOURCE,
    ),
    "pool": NamedWater(
        description="filtered swimming pool",
        absorption=(0.465, 0.0565, 0.00635),
        scattering=(0.040, 0.050, 0.0625),
        source=f"{POOL_SOURCE}, 0.05 1/m at 550 nm",
    ),
    "tank": NamedWater(
        description="test tank",
        absorption=(0.465, 0.0565, 0.00635),
        scattering=(0.116, 0.144, 0.180),
        source=f"{POOL_SOURCE}, which give c = 0.2 1/m at 550 nm; test tanks have 0.1 to 0.3 1/m",
    ),
}
"""The waters by name."""


def find_water(name: str) -> Medium:
    """Return the water of a name, with the default phase function and molecules of pure water.

    Raises:
        UnknownName: no water has this name; the error message gives the nearest one.
    """
    water = WATERS.get(name)
    if water is None:
        raise UnknownName("water", name, WATERS)
    return Medium(
        absorption=water.absorption,
        scattering=water.scattering,
        molecular_scattering=WATERS["clear"].scattering,
    )
