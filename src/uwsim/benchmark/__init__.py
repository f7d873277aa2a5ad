"""Benchmark files: reading and checking them, and their measures, triggers and scene updaters.

`reader` reads a file into a `spec`; `measures`, `triggers` and `updaters` have one module for each
XML element; `metrics` has the formulas of the measures; `plugin` and `plugin_tables` add the
measures, triggers and updaters of a user. `uwsim.runs` executes benchmarks.
"""
