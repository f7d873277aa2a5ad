"""Simulate underwater robots, and benchmark the algorithms that control them.

The names in `__all__` are stable, as `docs/python.md` explains; for example::

    import uwsim

    with uwsim.load("currents-scene") as simulation:
        simulation.advance(1.0)
        print(simulation.pose("girona500").position)
        image = simulation.image("bowtech1").colour
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from .version import __version__

if TYPE_CHECKING:
    from . import messages
    from .api import bench, check, compare, gap, load, read_result
    from .base.geometry import Pose
    from .bus import Algorithm, Node
    from .editing import Benchmark, Scene, read_benchmark, read_scene
    from .envs.make import make_env, make_parallel_env
    from .errors import UwsimError
    from .rendering.rendered_image import PixelBox, RenderedImage
    from .results.result import Result
    from .simulation import Simulation
    from .simulation.access.boxes import OrientedBox
    from .simulation.state.state import State
    from .viewer.replay import Replay

__all__ = [
    "Algorithm",
    "Benchmark",
    "Node",
    "OrientedBox",
    "PixelBox",
    "Pose",
    "RenderedImage",
    "Replay",
    "Result",
    "Scene",
    "Simulation",
    "State",
    "UwsimError",
    "__version__",
    "bench",
    "check",
    "compare",
    "gap",
    "load",
    "make_env",
    "make_parallel_env",
    "messages",
    "read_benchmark",
    "read_result",
    "read_scene",
]

_MODULES = {
    "Algorithm": "bus",
    "Benchmark": "editing",
    "Node": "bus",
    "OrientedBox": "simulation.access.boxes",
    "PixelBox": "rendering.rendered_image",
    "RenderedImage": "rendering.rendered_image",
    "Pose": "base.geometry",
    "Replay": "viewer.replay",
    "Result": "results.result",
    "Scene": "editing",
    "Simulation": "simulation",
    "State": "simulation.state.state",
    "UwsimError": "errors",
    "bench": "api",
    "check": "api",
    "compare": "api",
    "gap": "api",
    "load": "api",
    "make_env": "envs.make",
    "make_parallel_env": "envs.make",
    "read_benchmark": "editing",
    "read_result": "api",
    "read_scene": "editing",
}
"""The module that defines each public name."""


if not TYPE_CHECKING:  # with a `__getattr__`, a type checker would accept every name

    def __getattr__(name: str) -> Any:
        """Import a public name when it is first used."""
        if name == "messages":
            return importlib.import_module(".messages", __name__)
        if name not in _MODULES:
            import difflib

            near = difflib.get_close_matches(name, __all__, n=1)
            hint = f" Did you mean {near[0]!r}?" if near else ""
            raise AttributeError(f"module 'uwsim' has no attribute {name!r}.{hint}")
        module = importlib.import_module(f".{_MODULES[name]}", __name__)
        return globals().setdefault(name, getattr(module, name))


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
