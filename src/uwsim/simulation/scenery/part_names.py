"""The names of the visible parts of a scene, and the hashes of generated models."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...model.parts import Part
from ..unique_names import make_unique


def name_parts(
    parts: Sequence[Part], vehicle_names: Sequence[str], heap_names: Mapping[int, str]
) -> dict[int, str]:
    """Return the unique names of parts, ``vehicle/link`` or object, by segmentation ID.

    Args:
        parts: the visible parts.
        vehicle_names: the name of each vehicle.
        heap_names: the name of the object in each heap of sand, by segmentation ID.
    """
    labels = make_unique(vehicle_names)
    names = {}
    for part in parts:
        names[part.id] = part.name
        if part.vehicle is not None:
            suffix = part.name.removeprefix(vehicle_names[part.vehicle])
            names[part.id] = labels[part.vehicle] + suffix
    names |= {number: f"sand/{name}" for number, name in heap_names.items()}
    return dict(zip(names, make_unique(names.values()), strict=True))


def find_generated_hashes(parts: Sequence[Part]) -> dict[str, str]:
    """Return the sha256 of each generated model, by name, sorted by name."""
    models = {
        part.model.name: part.model.sha256
        for part in parts
        if part.model.sha256 and not part.model.files
    }
    return {name: models[name] for name in sorted(models)}
