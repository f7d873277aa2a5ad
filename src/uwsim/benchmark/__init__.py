"""Benchmark files: their specs, measures, triggers and scene updaters.

`reader` reads a file into a `spec`; `measures`, `triggers` and `updaters` have one module for each
element; `metrics` has the computations of measures; `plugin` and `plugin_tables` add a user's own.
Benchmarks are executed by `uwsim.runs`.
"""
