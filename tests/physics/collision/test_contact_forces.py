"""Forces of contacts by the name of what touches: those of MuJoCo, contact by contact."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import uwsim
from uwsim.base.geometry import Array
from uwsim.simulation import Simulation


def one_by_one(simulation: Simulation, name: str) -> dict[str, Array]:
    """The same from MuJoCo's own function."""
    state = simulation.world.engine
    model, data, contacts = state._model, state._data, state.contacts
    names = [contacts._names[owner] for owner in contacts._owner_numbers]
    found: dict[str, Array] = {}
    local = np.zeros(6)
    for i in range(data.ncon):
        contact = data.contact[i]
        first, second = (names[geom] for geom in contact.geom)
        if (first == name) == (second == name):
            continue
        mujoco.mj_contactForce(model, data, i, local)
        force = local[:3] @ contact.frame.reshape(3, 3) * (1.0 if second == name else -1.0)
        other = first if second == name else second
        found[other] = found.get(other, np.zeros(3)) + force
    return found


def test_what_lies_on_the_floor_is_carried_by_it_and_the_floor_feels_it() -> None:
    with uwsim.load("grasp-scene", timestep=0.005) as simulation:
        simulation.advance(0.5)
        assert simulation.world.engine._data.ncon > 1
        box = simulation.world.contacts.forces("blackbox")
        assert set(box) == {"terrain"}
        for name in ("blackbox", "girona500"):
            forces, expected = simulation.world.contacts.forces(name), one_by_one(simulation, name)
            assert forces.keys() == expected.keys()
            for other, force in forces.items():
                assert force == pytest.approx(expected[other], abs=1e-9)
        assert box["terrain"][2] == pytest.approx(52.0, abs=1.0)
