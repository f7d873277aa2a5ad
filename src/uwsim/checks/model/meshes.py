"""Warnings about large fixed meshes: simplified contact surfaces, and too many plates.

Contacts with a fixed mesh use a thin plate behind each of its flat faces.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from ...errors import Diagnostic, UwsimError
from ...model.collision.fixed_mesh import DEFAULT_ERROR, MAX_EXACT_FACES, FixedMesh
from ...model.collision.polygon_cache import cached_faces
from ...model.collision.scene_shapes import contact_mesh, solid_objects_in_water
from ..subjects import CheckedScene

MAX_PLATES = 5000
"""The number of plates of all fixed meshes of a scene above which a warning is reported."""
MAX_LISTED_OBJECTS = 4
"""The greatest number of objects that one warning names."""
ERROR_FACTOR = 2.0
"""The recommended contact error, as a multiple of the present error [1]."""


def fixed_meshes(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of meshes with a simplified contact surface, and of too many plates."""
    meshes = dict(_fixed_meshes(scene))
    inexact_meshes = {
        index: mesh
        for index, mesh in meshes.items()
        if not mesh.is_exact and scene.spec.objects[index].contact_error is None
    }
    if inexact_meshes:
        errors = {index: f"{mesh.error:.2g} m" for index, mesh in inexact_meshes.items()}
        message = (
            f"contacts with {_list_objects(scene, errors)} use a simpler surface, up to that far "
            f"from the mesh of more than {MAX_EXACT_FACES} flat faces. Set the greatest distance "
            "with <u:contactError> in the object [m]"
        )
        yield scene.warning(scene.spec.objects[next(iter(inexact_meshes))], message, "file")
    plates = {index: len(cached_faces(mesh.faces)) for index, mesh in meshes.items()}
    if sum(plates.values()) > MAX_PLATES:
        sorted_objects = sorted(plates, key=lambda index: -plates[index])
        counts = {index: f"{plates[index]} plates" for index in sorted_objects}
        error = ERROR_FACTOR * max(meshes[sorted_objects[0]].error, DEFAULT_ERROR)
        message = (
            f"fixed meshes have {sum(plates.values())} plates for contacts, mostly of "
            f"{_list_objects(scene, counts)}; expected {MAX_PLATES} at most, or the scene opens "
            f"and steps slowly. Set <u:contactError>{error:.1g}</u:contactError> in the object, "
            "a simpler mesh in <collisionShape>, or <collisionShapeType> box"
        )
        yield scene.warning(scene.spec.objects[sorted_objects[0]], message, "file")


def _fixed_meshes(scene: CheckedScene) -> Iterator[tuple[int, FixedMesh]]:
    for index, physics in solid_objects_in_water(scene.spec, scene.dynamics).items():
        with suppress(UwsimError):  # reported where models are checked
            mesh = contact_mesh(scene.spec, index, physics, scene.data_path)
            if mesh is not None:
                yield index, mesh


def _list_objects(scene: CheckedScene, facts: dict[int, str]) -> str:
    objects = scene.spec.objects
    names = [f"{objects[i].name!r} ({fact})" for i, fact in facts.items()]
    is_long = len(names) > MAX_LISTED_OBJECTS
    return ", ".join([*names[:MAX_LISTED_OBJECTS], *(["..."] if is_long else [])])
