"""The rule that the bodies that a force names exist, and that forces move one of them."""

from __future__ import annotations

from collections.abc import Iterator

from ...errors import Diagnostic, UnknownName
from ...forces import FORCES
from ...scene.attachable import attachable_bodies, is_moved_by_forces
from ...schema import Spec, fields_of, line_of
from ..subjects import CheckedScene


def forces_on_bodies(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Report unknown bodies of forces; warn of forces without an effect."""
    if len(scene.robots) < len(scene.spec.vehicles):  # reported where robots are read
        return
    bodies = attachable_bodies(scene.spec, scene.robots)
    elements = {spec: element for element, spec in FORCES.items()}
    for force in scene.spec.forces:
        element = elements.get(type(force), type(force).__name__)
        label = f"<u:{element}> {force.name!r}"
        body_names = [*_body_names(force)]
        unknown_names = [(line, name) for line, name in body_names if name not in bodies]
        for line, name in unknown_names:
            message = str(UnknownName("vehicle, link or object", name, bodies))
            yield scene.error(line, f"{label}: {message}")
        if unknown_names or not body_names:
            continue
        if not any(is_moved_by_forces(scene.spec, bodies[name]) for _, name in body_names):
            fixed = " and ".join(repr(name) for _, name in body_names)
            yield scene.warning(
                force,
                f"{label} has no effect: forces do not move {fixed}. Expected a vehicle with "
                "<u:dynamics>, or a loose object with <physics>, in a scene that is simulated",
            )


def _body_names(spec: Spec) -> Iterator[tuple[int | None, str]]:
    for field in fields_of(type(spec)):
        value = field.value_in(spec)
        if field.xml.refers_to == "body" and isinstance(value, str):
            yield line_of(spec, field.tag), value
        for part in value if isinstance(value, tuple) else (value,):
            if isinstance(part, Spec):
                yield from _body_names(part)
