"""The types of simulation_interfaces are those of the ROS 2 package."""

from __future__ import annotations

import dataclasses

import pytest

from uwsim.messages.simulation_control import MESSAGES, SIMULATION_SERVICES
from uwsim.middleware.encodings import from_cdr, to_cdr
from uwsim.middleware.types import ros2_store, service, wire_service

HASHES = {
    "GetEntities": "cb90004c48cd50f37732fb008e22c34c261dd680a723bf0f85d8437ea4498bf7",
    "ResetSimulation": "4ce285d7ff9b8ac70dcc95161f32bf54c05a6f4b13427990e41ab40c36c39646",
    "GetSimulationState": "3362dcebee4b1afebbf9c4beee5c79c1455385aded62092a892d61fde8644f30",
    "StepSimulation": "913fe0653690ce6bf8f09f316e6a626747012e9fca31e26719910d417aa8565c",
    "SpawnEntity": "66860313e11009faddbfc8568e5d410d1a11607fe75eeb1308671dc0406fe3a7",
}
"""As the code generators of ROS 2 compute them."""


@pytest.mark.parametrize("name", HASHES)
def test_services_have_the_type_hash_that_ros_2_computes(name: str) -> None:
    kind = wire_service(service(f"simulation_interfaces/{name}"))
    assert kind.type_hash == f"RIHS01_{HASHES[name]}"


HALVES = [h for each in SIMULATION_SERVICES.values() for h in (each.request, each.response)]


@pytest.mark.parametrize("kind", [*MESSAGES, *HALVES])
def test_classes_and_texts_have_the_same_fields_and_what_is_sent_arrives(kind: type) -> None:
    _, definitions = ros2_store().fielddefs[kind.__msgtype__]
    names = [entry.name for entry in dataclasses.fields(kind) if entry.name[0] != "_"]
    expected = [name for name, _ in definitions if name != "structure_needs_at_least_one_member"]
    assert names == expected
    assert bytes(to_cdr(from_cdr(kind, to_cdr(kind())))) == bytes(to_cdr(kind()))
