"""Generated replacements of UWSim's model files, by file name without extension."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .mesh import Mesh


@dataclass(frozen=True)
class StandIn:
    """A generated model: its factory and its description."""

    make: Callable[[], tuple[Mesh, ...]]
    """The function that makes the meshes."""
    source: str = "stand-in"
    """The kind: ``"stand-in"`` (modelled) or ``"labelled box"`` (a placeholder of the right
    size)."""


def _model(module: str, maker: str) -> StandIn:
    def make() -> tuple[Mesh, ...]:
        from importlib import import_module

        meshes: tuple[Mesh, ...] = getattr(
            import_module(f".procedural.{module}", __package__), maker
        )()
        return meshes

    return StandIn(make)


def _box(label: str, x: float, y: float, z: float) -> StandIn:
    def make() -> tuple[Mesh, ...]:
        from .procedural.placeholder import labelled_box

        return labelled_box(label, (x, y, z))

    return StandIn(make, "labelled box")


STAND_INS: dict[str, StandIn] = {
    "objects/amphora": _model("amphora", "amphora"),
    "objects/blackbox": _model("blackbox", "blackbox"),
    "objects/blackbox_standard": _model("blackbox", "blackbox_standard"),
    "objects/blackbox_uib": _model("blackbox", "blackbox_uib"),
    "objects/blackbox_uib_trimesh": _model("blackbox", "blackbox_uib"),
    "objects/boat": _model("ships", "boat"),
    "objects/box": _model("solids", "box"),
    "objects/capsule": _model("solids", "rod"),
    "objects/cone": _model("solids", "cone"),
    "objects/cylinder": _model("solids", "upright_cylinder"),
    "objects/full_amphora": _model("amphora", "amphora"),
    "objects/gun": _model("cannon", "cannon"),
    "objects/hook": _model("fittings", "hook"),
    "objects/pipe_green": _model("pipe", "pipe"),
    "objects/ring": _model("solids", "wide_ring"),
    "objects/ship": _model("ships", "ship"),
    "objects/sphere": _model("solids", "ball"),
    "objects/torus": _model("fittings", "ring_object"),
    "robot/ARM5E/ARM5E_part0": _model("arm5e", "part0"),
    "robot/ARM5E/ARM5E_part1": _model("arm5e", "part1"),
    "robot/ARM5E/ARM5E_part2": _model("arm5e", "part2"),
    "robot/ARM5E/ARM5E_part3": _model("arm5e", "part3"),
    "robot/ARM5E/ARM5E_part4": _model("arm5e", "part4"),
    "robot/ARM5E/ARM5E_part4_base": _model("arm5e", "part4_base"),
    "robot/ARM5E/ARM5E_part4_jaw1": _model("arm5e", "jaw1"),
    "robot/ARM5E/ARM5E_part4_jaw1long": _model("arm5e", "jaw1_long"),
    "robot/ARM5E/ARM5E_part4_jaw2": _model("arm5e", "jaw2"),
    "robot/ARM5E/ARM5E_part4_jaw2long": _model("arm5e", "jaw2_long"),
    "robot/GIRONA500/g500_March11": _model("girona500", "girona500"),
    "robot/PA10/barrett": _box("BARRETT HAND", 0.13, 0.20, 0.16),
    "robot/PA10/pa10link0": _box("PA-10 LINK 0", 0.23, 0.26, 0.20),
    "robot/PA10/pa10link1": _box("PA-10 LINK 1", 0.20, 0.20, 0.20),
    "robot/PA10/pa10link2": _box("PA-10 LINK 2", 0.18, 0.18, 0.28),
    "robot/PA10/pa10link3": _box("PA-10 LINK 3", 0.16, 0.16, 0.20),
    "robot/PA10/pa10link4": _box("PA-10 LINK 4", 0.14, 0.14, 0.28),
    "robot/PA10/pa10link5": _box("PA-10 LINK 5", 0.12, 0.12, 0.20),
    "robot/PA10/pa10link6": _box("PA-10 LINK 6", 0.10, 0.10, 0.08),
    "robot/PA10/pa10link7": _box("PA-10 LINK 7", 0.08, 0.08, 0.05),
    "robot/UJIOne/ujione_base": _model("ujione", "gripper_base"),
    "robot/UJIOne/ujione_jaw_inner": _model("ujione", "inner_jaw"),
    "robot/UJIOne/ujione_jaw_outer": _model("ujione", "outer_jaw"),
    "terrain/CIRS/cirs": _model("tank", "higher_tank"),
    "terrain/CIRS/cirs_trident": _model("tank", "tank"),
    "terrain/desert/desert2": _model("seafloor", "desert"),
    "terrain/floor/floor": _model("solids", "floor"),
    "terrain/islands/islands": _box("ISLANDS", 40.0, 40.0, 8.0),
    "terrain/sand/sand": _model("seafloor", "flat_sand"),
    "terrain/seafloor/terrain_noship": _model("seafloor", "seafloor"),
    "terrain/shipwreck/terrain": _model("seafloor", "shipwreck"),
}
"""The stand-ins in alphabetical order, one line each."""
