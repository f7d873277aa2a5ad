"""Metrics: the formulas of the measures, as functions of numbers, without a simulation."""
