"""The files that are written, and the functions that make the models in each."""

from __future__ import annotations

from collections.abc import Callable

from uwsim.assets.mesh import Mesh

from .parts import Part
from .scenery import arm5e as smooth_arm5e
from .scenery import (
    cable,
    chain,
    dock,
    fixtures,
    nets,
    pier,
    pipes,
    pool,
    rocks,
    seabed,
    vehicles,
    wreck,
)
from .stand_ins import (
    amphora,
    arm5e,
    blackbox,
    cannon,
    fittings,
    girona500,
    pipe,
    seafloor,
    ships,
    solids,
    tank,
    ujione,
)

STAND_INS: dict[str, dict[str, Callable[[], tuple[Mesh, ...]]]] = {
    "objects/amphora": {
        "objects/amphora": amphora.amphora,
    },
    "objects/blackbox": {
        "objects/blackbox": blackbox.blackbox,
        "objects/blackbox_standard": blackbox.blackbox_standard,
        "objects/blackbox_uib": blackbox.blackbox_uib,
    },
    "objects/ships": {
        "objects/boat": ships.boat,
        "objects/ship": ships.ship,
    },
    "objects/solids": {
        "objects/box": solids.box,
        "objects/capsule": solids.rod,
        "objects/cone": solids.cone,
        "objects/cylinder": solids.upright_cylinder,
        "objects/ring": solids.wide_ring,
        "objects/sphere": solids.ball,
    },
    "objects/gun": {
        "objects/gun": cannon.cannon,
    },
    "objects/fittings": {
        "objects/hook": fittings.hook,
        "objects/torus": fittings.ring_object,
    },
    "objects/pipe_green": {
        "objects/pipe_green": pipe.pipe,
    },
    "robot/ARM5E": {
        "robot/ARM5E/ARM5E_part0": arm5e.part0,
        "robot/ARM5E/ARM5E_part1": arm5e.part1,
        "robot/ARM5E/ARM5E_part2": arm5e.part2,
        "robot/ARM5E/ARM5E_part3": arm5e.part3,
        "robot/ARM5E/ARM5E_part4": arm5e.part4,
        "robot/ARM5E/ARM5E_part4_base": arm5e.part4_base,
        "robot/ARM5E/ARM5E_part4_jaw1": arm5e.jaw1,
        "robot/ARM5E/ARM5E_part4_jaw1long": arm5e.jaw1_long,
        "robot/ARM5E/ARM5E_part4_jaw2": arm5e.jaw2,
        "robot/ARM5E/ARM5E_part4_jaw2long": arm5e.jaw2_long,
    },
    "robot/GIRONA500": {
        "robot/GIRONA500/g500_March11": girona500.girona500,
    },
    "robot/UJIOne": {
        "robot/UJIOne/ujione_base": ujione.gripper_base,
        "robot/UJIOne/ujione_jaw_inner": ujione.inner_jaw,
        "robot/UJIOne/ujione_jaw_outer": ujione.outer_jaw,
    },
    "terrain/CIRS": {
        "terrain/CIRS/cirs": tank.higher_tank,
        "terrain/CIRS/cirs_trident": tank.tank,
    },
    "terrain/sand": {
        "terrain/desert/desert2": seafloor.desert,
        "terrain/sand/sand": seafloor.flat_sand,
        "terrain/seafloor/terrain_noship": seafloor.seafloor,
        "terrain/shipwreck/terrain": seafloor.shipwreck,
    },
    "terrain/floor": {
        "terrain/floor/floor": solids.floor,
    },
}
"""The stand-ins for UWSim's models, by file and name; their arrays never change.

Results of benchmarks record the hashes of these models.
"""

SCENERY: dict[str, dict[str, Callable[[], tuple[Part, ...]]]] = {
    "objects/rocks": {
        "objects/rock1": rocks.rock1,
        "objects/rock2": rocks.rock2,
        "objects/rock3": rocks.rock3,
        "objects/rock4": rocks.rock4,
        "objects/rock5": rocks.rock5,
    },
    "objects/cable": {"objects/cable": cable.cable},
    "objects/twine": {"objects/twine": cable.twine},
    "objects/chain": {"objects/chain": chain.chain},
    "objects/docks": {"objects/dock_round": dock.round_, "objects/dock_square": dock.square},
    "objects/fixtures": {
        "objects/plug": fixtures.plug,
        "objects/socket": fixtures.socket,
        "objects/socket_panel": fixtures.socket_panel,
        "objects/valve_handle": fixtures.valve_handle,
        "objects/valve_panel": fixtures.valve_panel,
    },
    "objects/nets": {"objects/net": nets.net, "objects/cage_panel": nets.cage_panel},
    "objects/pier": {"objects/pier": pier.pier},
    "objects/pipes": {"objects/pipe_flanged": pipes.pipe, "objects/pipe_elbow": pipes.elbow},
    "objects/wreck": {"objects/wreck": wreck.wreck},
    "robot/BLUEROV2": {"robot/BLUEROV2/bluerov2_heavy": vehicles.bluerov2_heavy},
    "robot/arm5e_smooth": {
        "robot/ARM5E/arm5e_base": smooth_arm5e.base,
        "robot/ARM5E/arm5e_shoulder": smooth_arm5e.shoulder,
        "robot/ARM5E/arm5e_upper_arm": smooth_arm5e.upper_arm,
        "robot/ARM5E/arm5e_forearm": smooth_arm5e.forearm,
        "robot/ARM5E/arm5e_wrist": smooth_arm5e.wrist,
        "robot/ARM5E/arm5e_jaw1": smooth_arm5e.jaw1,
        "robot/ARM5E/arm5e_jaw2": smooth_arm5e.jaw2,
    },
    "robot/girona500_smooth": {"robot/GIRONA500/girona500": vehicles.girona500},
    "terrain/pool": {"terrain/pool/pool": pool.pool},
    "terrain/seabed": {
        "terrain/seabed/sand": seabed.sand,
        "terrain/seabed/gravel": seabed.gravel,
    },
}
"""The other models, with maps, by file and name."""
