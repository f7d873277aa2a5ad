"""What many objects cost: nothing where they stand still, no more than each by itself else."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace

import mujoco
import numpy as np
import pytest

from tests.physics.water_models import FAR_BELOW, free_body, set_options
from tests.simulation.girona500 import SCENE, make, run
from uwsim.model import parts
from uwsim.physics.hydrodynamics import callback, prepare
from uwsim.physics.hydrodynamics.hydrodynamics import install
from uwsim.scene.hydrodynamics import BodyHydrodynamics
from uwsim.scene.object import PhysicsSpec
from uwsim.scene.reader import read_scene

WATER = BodyHydrodynamics(
    link="body", added_mass=(4.0, 6.0, 9.0, 0.05, 0.08, 0.05), volume=0.0142, implicitness=1.0
)
MASS, INERTIA = 14.2, (0.08, 0.15, 0.19)
BLACKBOX = replace(read_scene(SCENE).objects[1], is_solid=None)


def test_building_many_loose_bodies_takes_no_table_of_each_with_each() -> None:
    n = 200
    spec = mujoco.MjSpec()
    set_options(spec)
    for i in range(n):
        body = spec.worldbody.add_body(name=f"b{i}", pos=[float(i), 0, 0], mass=MASS)
        body.inertia, body.explicitinertial = list(INERTIA), True
        body.add_freejoint()
    prepare(spec, {f"b{i}": replace(WATER, link=f"b{i}") for i in range(n)}, {}, surface=FAR_BELOW)
    model = spec.compile()
    one = free_body(WATER, mass=MASS, inertia=INERTIA)
    install(one)
    tracemalloc.start()
    try:
        install(model)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
        callback.remove()
    assert peak < 0.2 * 8 * model.nv**2
    assert model.body_invweight0[1:] == pytest.approx(np.tile(one.body_invweight0[1], (n, 1)))
    assert model.dof_invweight0 == pytest.approx(np.tile(one.dof_invweight0, n))
    assert model.stat.meaninertia == pytest.approx(one.stat.meaninertia)


def test_a_mesh_that_many_objects_share_is_read_once(monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[str] = []
    load = parts.load_model

    def counted(name: str, **options: object) -> parts.Model:
        read.append(name)
        return load(name, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(parts, "load_model", counted)
    make(objects=tuple(replace(BLACKBOX, name=f"box {i}") for i in range(20)))
    assert read.count(BLACKBOX.file) <= 2  # to be seen, and to be touched


def test_what_stands_fixed_is_no_body_of_the_engine() -> None:
    fixed = replace(BLACKBOX, physics=PhysicsSpec(mass=0.0))
    some = make(objects=tuple(replace(fixed, name=f"box {i}") for i in range(20)))
    alone = make()
    assert some.world.engine._model.nbody == alone.world.engine._model.nbody


def test_a_box_at_rest_stays_awake() -> None:
    floor = replace(read_scene(SCENE).objects[0], physics=PhysicsSpec(mass=0.0))
    lying = replace(
        BLACKBOX,
        position=(3.0, 1.5, 4.73),
        orientation=(0.0, 0.0, 0.0),
        physics=PhysicsSpec(mass=10.0),
    )
    simulation = make(objects=(floor, lying))
    run(simulation, 1.0)
    assert simulation.world.engine._data.tree_awake.tolist() == [1, 1]
