"""Benchmark files: their specs, measures, triggers and scene updaters."""
