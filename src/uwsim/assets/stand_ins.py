"""The bundled models by name, which is the file name in a scene without its extension."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class BundledModel:
    """A model in a GLB file of the package."""

    file: str
    """The file in ``data/models``, without ``.glb``."""
    scene: str = ""
    """The scene of the file that has the model; by default the one with the model's name."""
    source: str = "stand-in"
    """The origin that `Model.source` states."""


@dataclass(frozen=True)
class LabelledBox:
    """A box with its name on every face, in place of a model of UWSim that is not bundled."""

    label: str
    """The text on its faces."""
    size: tuple[float, float, float]
    """The edges x, y, z [m]."""


StandIn = BundledModel | LabelledBox


def _scenery(file: str) -> BundledModel:
    return BundledModel(file, source="bundled")


STAND_INS: dict[str, StandIn] = {
    "objects/amphora": BundledModel("objects/amphora"),
    "objects/blackbox": BundledModel("objects/blackbox"),
    "objects/blackbox_standard": BundledModel("objects/blackbox"),
    "objects/blackbox_uib": BundledModel("objects/blackbox"),
    "objects/blackbox_uib_trimesh": BundledModel("objects/blackbox", scene="objects/blackbox_uib"),
    "objects/boat": BundledModel("objects/ships"),
    "objects/box": BundledModel("objects/solids"),
    "objects/capsule": BundledModel("objects/solids"),
    "objects/cone": BundledModel("objects/solids"),
    "objects/cylinder": BundledModel("objects/solids"),
    "objects/full_amphora": BundledModel("objects/amphora", scene="objects/amphora"),
    "objects/gun": BundledModel("objects/gun"),
    "objects/hook": BundledModel("objects/fittings"),
    "objects/pipe_green": BundledModel("objects/pipe_green"),
    "objects/ring": BundledModel("objects/solids"),
    "objects/ship": BundledModel("objects/ships"),
    "objects/sphere": BundledModel("objects/solids"),
    "objects/torus": BundledModel("objects/fittings"),
    "robot/ARM5E/ARM5E_part0": BundledModel("robot/ARM5E"),
    "robot/ARM5E/ARM5E_part1": BundledModel("robot/ARM5E"),
    "robot/ARM5E/ARM5E_part2": BundledModel("robot/ARM5E"),
    "robot/ARM5E/ARM5E_part3": BundledModel("robot/ARM5E"),
    "robot/ARM5E/ARM5E_part4": BundledModel("robot/ARM5E"),
    "robot/ARM5E/ARM5E_part4_base": BundledModel("robot/ARM5E"),
    "robot/ARM5E/ARM5E_part4_jaw1": BundledModel("robot/ARM5E"),
    "robot/ARM5E/ARM5E_part4_jaw1long": BundledModel("robot/ARM5E"),
    "robot/ARM5E/ARM5E_part4_jaw2": BundledModel("robot/ARM5E"),
    "robot/ARM5E/ARM5E_part4_jaw2long": BundledModel("robot/ARM5E"),
    "robot/GIRONA500/g500_March11": BundledModel("robot/GIRONA500"),
    "robot/PA10/barrett": LabelledBox("BARRETT HAND", (0.13, 0.20, 0.16)),
    "robot/PA10/pa10link0": LabelledBox("PA-10 LINK 0", (0.23, 0.26, 0.20)),
    "robot/PA10/pa10link1": LabelledBox("PA-10 LINK 1", (0.20, 0.20, 0.20)),
    "robot/PA10/pa10link2": LabelledBox("PA-10 LINK 2", (0.18, 0.18, 0.28)),
    "robot/PA10/pa10link3": LabelledBox("PA-10 LINK 3", (0.16, 0.16, 0.20)),
    "robot/PA10/pa10link4": LabelledBox("PA-10 LINK 4", (0.14, 0.14, 0.28)),
    "robot/PA10/pa10link5": LabelledBox("PA-10 LINK 5", (0.12, 0.12, 0.20)),
    "robot/PA10/pa10link6": LabelledBox("PA-10 LINK 6", (0.10, 0.10, 0.08)),
    "robot/PA10/pa10link7": LabelledBox("PA-10 LINK 7", (0.08, 0.08, 0.05)),
    "robot/UJIOne/ujione_base": BundledModel("robot/UJIOne"),
    "robot/UJIOne/ujione_jaw_inner": BundledModel("robot/UJIOne"),
    "robot/UJIOne/ujione_jaw_outer": BundledModel("robot/UJIOne"),
    "terrain/CIRS/cirs": BundledModel("terrain/CIRS"),
    "terrain/CIRS/cirs_trident": BundledModel("terrain/CIRS"),
    "terrain/desert/desert2": BundledModel("terrain/sand"),
    "terrain/floor/floor": BundledModel("terrain/floor"),
    "terrain/islands/islands": LabelledBox("ISLANDS", (40.0, 40.0, 8.0)),
    "terrain/sand/sand": BundledModel("terrain/sand"),
    "terrain/seafloor/terrain_noship": BundledModel("terrain/sand"),
    "terrain/shipwreck/terrain": BundledModel("terrain/sand"),
}
"""The replacements of UWSim's models in alphabetical order, one line each."""

SCENERY: dict[str, StandIn] = {
    "objects/cable": _scenery("objects/cable"),
    "objects/cage_panel": _scenery("objects/nets"),
    "objects/chain": _scenery("objects/chain"),
    "objects/dock_round": _scenery("objects/docks"),
    "objects/dock_square": _scenery("objects/docks"),
    "objects/net": _scenery("objects/nets"),
    "objects/pier": _scenery("objects/pier"),
    "objects/pipe_elbow": _scenery("objects/pipes"),
    "objects/pipe_flanged": _scenery("objects/pipes"),
    "objects/plug": _scenery("objects/fixtures"),
    "objects/rock1": _scenery("objects/rocks"),
    "objects/rock2": _scenery("objects/rocks"),
    "objects/rock3": _scenery("objects/rocks"),
    "objects/rock4": _scenery("objects/rocks"),
    "objects/rock5": _scenery("objects/rocks"),
    "objects/socket": _scenery("objects/fixtures"),
    "objects/socket_panel": _scenery("objects/fixtures"),
    "objects/twine": _scenery("objects/twine"),
    "objects/valve_handle": _scenery("objects/fixtures"),
    "objects/valve_panel": _scenery("objects/fixtures"),
    "objects/wreck": _scenery("objects/wreck"),
    "robot/ARM5E/arm5e_base": _scenery("robot/arm5e_smooth"),
    "robot/ARM5E/arm5e_forearm": _scenery("robot/arm5e_smooth"),
    "robot/ARM5E/arm5e_jaw1": _scenery("robot/arm5e_smooth"),
    "robot/ARM5E/arm5e_jaw2": _scenery("robot/arm5e_smooth"),
    "robot/ARM5E/arm5e_shoulder": _scenery("robot/arm5e_smooth"),
    "robot/ARM5E/arm5e_upper_arm": _scenery("robot/arm5e_smooth"),
    "robot/ARM5E/arm5e_wrist": _scenery("robot/arm5e_smooth"),
    "robot/BLUEROV2/bluerov2_heavy": _scenery("robot/BLUEROV2"),
    "robot/GIRONA500/girona500": _scenery("robot/girona500_smooth"),
    "terrain/pool/pool": _scenery("terrain/pool"),
    "terrain/seabed/gravel": _scenery("terrain/seabed"),
    "terrain/seabed/sand": _scenery("terrain/seabed"),
}
"""The models that UWSim does not have, in alphabetical order."""

BUNDLED_MODELS = {**STAND_INS, **SCENERY}
"""All models of the package."""
