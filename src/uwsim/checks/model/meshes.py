"""Warnings about large fixed meshes: how far what is touched lies from them, and how much it is."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from ...errors import Diagnostic, UwsimError
from ...model.collision.fixed_mesh import DEFAULT_ERROR, MAX_EXACT_FACES, FixedMesh
from ...model.collision.polygon_cache import cached_faces
from ...model.collision.scene_shapes import contact_mesh, simulated_solids
from ..subjects import CheckedScene

MAX_PLATES = 5000
"""Plates of all fixed meshes of a scene; more are reported."""
MAX_NAMED = 4
"""Objects that one warning names."""
BY_HAND = 2.0
"""The error that is recommended, as a multiple of the present one."""


def fixed_meshes(scene: CheckedScene) -> Iterator[Diagnostic]:
    """Warn of meshes that are touched as others, and of too many plates."""
    meshes = dict(_fixed_meshes(scene))
    others = {
        index: mesh
        for index, mesh in meshes.items()
        if not mesh.is_exact and scene.spec.objects[index].contact_error is None
    }
    if others:
        errors = {index: f"{mesh.error:.2g} m" for index, mesh in others.items()}
        message = (
            f"contacts with {_named(scene, errors)} use a simpler surface, up to that far from the "
            f"mesh, which has more than {MAX_EXACT_FACES} flat faces. Set the greatest distance "
            "[m] with <u:contactError> in the object"
        )
        yield scene.warning(scene.spec.objects[next(iter(others))], message, "file")
    plates = {index: len(cached_faces(mesh.faces)) for index, mesh in meshes.items()}
    if sum(plates.values()) > MAX_PLATES:
        most = sorted(plates, key=lambda index: -plates[index])
        counts = {index: f"{plates[index]} plates" for index in most}
        error = BY_HAND * max(meshes[most[0]].error, DEFAULT_ERROR)
        message = (
            f"contacts with fixed meshes are with {sum(plates.values())} plates, most of "
            f"{_named(scene, counts)}; expected {MAX_PLATES} at most, or the scene opens and steps "
            f"slowly. <u:contactError>{error:.1g}</u:contactError> in the object leaves fewer; so "
            "does a simpler mesh in <collisionShape>, or <collisionShapeType> box"
        )
        yield scene.warning(scene.spec.objects[most[0]], message, "file")


def _fixed_meshes(scene: CheckedScene) -> Iterator[tuple[int, FixedMesh]]:
    for index, physics in simulated_solids(scene.spec, scene.dynamics).items():
        with suppress(UwsimError):  # reported where models are checked
            mesh = contact_mesh(scene.spec, index, physics, scene.data_path)
            if mesh is not None:
                yield index, mesh


def _named(scene: CheckedScene, facts: dict[int, str]) -> str:
    """Name the first objects, each with a fact."""
    objects = scene.spec.objects
    shown = [f"{objects[i].name!r} ({fact})" for i, fact in list(facts.items())[:MAX_NAMED]]
    return ", ".join([*shown, "..."] if len(facts) > MAX_NAMED else shown)
