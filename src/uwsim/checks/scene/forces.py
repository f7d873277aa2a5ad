"""The rule that the bodies that a force names exist, and that forces move one of them."""

from __future__ import annotations

from collections.abc import Iterator

from ...errors import Diagnostic, UnknownName
from ...forces import FORCES
from ...scene.attachable import attachable_bodies, is_moved_by_forces
from ..subjects import CheckedScene
from .named_bodies import body_names


def forces_on_bodies(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report unknown bodies of forces; warn of forces without an effect."""
    if len(scene.robots) < len(scene.spec.vehicles):  # reported where robots are read
        return
    bodies = attachable_bodies(scene.spec, scene.robots)
    elements = {spec: element for element, spec in FORCES.items()}
    for force in scene.spec.forces:
        element = elements.get(type(force), type(force).__name__)
        label = f"<u:{element}> {force.name!r}"
        names = [*body_names(force)]
        unknown_names = [(line, name) for line, name in names if name not in bodies]
        for line, name in unknown_names:
            message = str(UnknownName("vehicle, link or object", name, bodies))
            yield scene.error(line, f"{label}: {message}")
        if unknown_names or not names:
            continue
        if not any(is_moved_by_forces(scene.spec, bodies[name]) for _, name in names):
            fixed = " and ".join(repr(name) for _, name in names)
            yield scene.warning(
                force,
                f"{label} has no effect: forces do not move {fixed}. Expected a vehicle with "
                "<u:dynamics>, or a loose object with <physics>, in a scene that is simulated",
            )
