"""The errors and warnings about files: one table of rules for `uwsim check` and every run.

`uwsim.checks.table` lists each rule with its input (`Need`). `check_file` applies the rules about a
file, `model_warnings` and `scene_warnings` the rules whose warnings a run reports before it begins.

Errors that prevent the building of a spec belong to its reader: invalid elements, numbers,
expressions, sizes beyond a limit (`uwsim.scene.sizes`), variations, hydrodynamics files, elements
of a benchmark. Readers also warn of details that specs do not keep: text after a number, old
names, levels that never end. Errors of a binding (`uwsim.benchmark.unknown_names`) and of a
compilation (`uwsim.model.dynamics`) are raised there; rules report them for a whole file.
"""

from .check import ArduPilotCheck, check_file, model_warnings, scene_warnings
from .rule import Need, Rule

__all__ = ["ArduPilotCheck", "Need", "Rule", "check_file", "model_warnings", "scene_warnings"]
