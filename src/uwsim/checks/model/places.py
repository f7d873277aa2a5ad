"""Warnings about files that are not where the scene or its robots state, or broken in part."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ... import assets
from ...errors import Diagnostic, UwsimError
from ...schema import Spec, diagnostic_at
from ..robot_search import Where
from ..subjects import CheckedScene


def places_of_files(scene: CheckedScene) -> list[Diagnostic]:
    """Warn of each file found elsewhere, each lost package, and each model broken in part."""
    remarks: dict[str, Spec] = {}
    for vehicle in scene.spec.vehicles:
        try:
            path = assets.find(vehicle.file, **scene.where)
        except UwsimError:
            continue
        remark = assets.location_remark(vehicle.file, path, **scene.where)
        remarks.setdefault(remark, vehicle)
    for spec, name, file in _models(scene):
        where = Where(named_by=file, data_path=scene.data_path)
        remark = assets.model_location_remark(name, **where)
        if not remark and not assets.has_model(name, **where):
            lost = assets.package_remark(name, **where) or "there is no model, nor a stand-in"
            remark = f"{lost}: a labelled box in place of {name!r}"
        for said in (remark, *assets.model_remarks(name, **where)):
            remarks.setdefault(said, spec)
    return [
        diagnostic_at(spec, remark, "file", severity="warning")
        for remark, spec in remarks.items()
        if remark
    ]


def _models(scene: CheckedScene) -> Iterator[tuple[Spec, str, Path | None]]:
    """Give every model with the element and the file that name it."""
    for thing in scene.spec.objects:
        yield thing, thing.file, scene.where["named_by"]
    for robot in scene.robots.values():
        for link in robot.links:
            for shape in (*link.visuals, *link.collisions):
                if shape.kind == "mesh":
                    yield shape, shape.file, Path(robot.path)
