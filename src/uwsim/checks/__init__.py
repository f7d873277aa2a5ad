"""The errors and warnings about files: one table of rules, which `uwsim check` and every run read.

`uwsim.checks.table` names each rule with what it needs (`Need`). `check_file` applies those about a
file, `model_warnings` and `scene_warnings` those that a run reports before it begins.

What keeps a spec from being built is no rule and stays with its reader: an element, a number or an
expression that is wrong, sizes beyond a limit (`uwsim.scene.sizes`), variations, hydrodynamics
files, the elements of a benchmark. Readers also warn of what they alone see: junk behind a number,
old names, levels that never end. What a binding raises (`uwsim.benchmark.unknown_names`) and what
compiling a scene raises (`uwsim.model.dynamics`) stays there; rules report it for a whole file.
"""

from .check import check_file, model_warnings, scene_warnings
from .rule import Need, Rule

__all__ = ["Need", "Rule", "check_file", "model_warnings", "scene_warnings"]
