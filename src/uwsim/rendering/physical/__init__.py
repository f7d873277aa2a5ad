"""Images through physical water: daylight, scattering, lamps, exposure."""
