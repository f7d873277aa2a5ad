"""The models that uwsim makes itself, by the names of UWSim's files without extension."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .mesh import Mesh


@dataclass(frozen=True)
class StandIn:
    """How a model is made, and what it is."""

    make: Callable[[], tuple[Mesh, ...]]
    """Makes the meshes."""
    source: str = "stand-in"
    """``"stand-in"`` (modelled) or ``"labelled box"`` (a placeholder of the right size)."""


def _made_by(module: str, maker: str) -> Callable[[], tuple[Mesh, ...]]:
    """A maker in ``procedural/``, imported when it is first called."""

    def make() -> tuple[Mesh, ...]:
        from importlib import import_module

        meshes: tuple[Mesh, ...] = getattr(
            import_module(f".procedural.{module}", __package__), maker
        )()
        return meshes

    return make


STAND_INS: dict[str, StandIn] = {
    "objects/blackbox": StandIn(_made_by("blackbox", "blackbox")),
    "objects/blackbox_standard": StandIn(_made_by("blackbox", "blackbox_standard")),
    "objects/blackbox_uib": StandIn(_made_by("blackbox", "blackbox_uib")),
    "objects/blackbox_uib_trimesh": StandIn(_made_by("blackbox", "blackbox_uib")),
    "robot/ARM5E/ARM5E_part0": StandIn(_made_by("arm5e", "part0")),
    "robot/ARM5E/ARM5E_part1": StandIn(_made_by("arm5e", "part1")),
    "robot/ARM5E/ARM5E_part2": StandIn(_made_by("arm5e", "part2")),
    "robot/ARM5E/ARM5E_part3": StandIn(_made_by("arm5e", "part3")),
    "robot/ARM5E/ARM5E_part4_base": StandIn(_made_by("arm5e", "part4_base")),
    "robot/ARM5E/ARM5E_part4_jaw1": StandIn(_made_by("arm5e", "jaw1")),
    "robot/ARM5E/ARM5E_part4_jaw2": StandIn(_made_by("arm5e", "jaw2")),
    "robot/GIRONA500/g500_March11": StandIn(_made_by("girona500", "girona500")),
    "terrain/CIRS/cirs": StandIn(_made_by("tank", "tank")),
    "terrain/CIRS/cirs_trident": StandIn(_made_by("tank", "tank")),
}
