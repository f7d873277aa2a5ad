"""Metrics: the computations of measures, on numbers alone."""
