"""Identification of hydrodynamic coefficients from logs, with intervals and provenance."""
