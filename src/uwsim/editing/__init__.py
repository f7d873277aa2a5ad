"""Scenes and benchmarks that a program reads, changes, checks and writes.

`Scene` and `Benchmark` are trees of `Element`; each element has the fields of its spec as
attributes. `grammar` states what an element may contain, `values` checks what is set.
"""

from .benchmark import Benchmark, read_benchmark
from .element import Element, ElementList
from .scene import Scene, read_scene

__all__ = ["Benchmark", "Element", "ElementList", "Scene", "read_benchmark", "read_scene"]
