"""Warnings about files that are not where the scene or its robots state, or are partly broken."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ... import assets
from ...errors import Diagnostic, UwsimError
from ...schema import Spec, diagnostic_at
from ..robot_search import FileSearch
from ..subjects import CheckedScene


def file_locations(scene: CheckedScene) -> list[Diagnostic]:
    """Warn of each file at another path, each missing package, and each partly broken model."""
    remarks: dict[str, Spec] = {}
    for vehicle in scene.spec.vehicles:
        try:
            path = assets.find(vehicle.file, **scene.file_search)
        except UwsimError:
            continue
        remark = assets.location_remark(vehicle.file, path, **scene.file_search)
        remarks.setdefault(remark, vehicle)
    for spec, name, file in _models(scene):
        file_search = FileSearch(named_by=file, data_path=scene.data_path)
        remark = assets.model_location_remark(name, **file_search)
        if not remark and not assets.has_model(name, **file_search):
            cause = assets.package_remark(name, **file_search) or "no model, nor a stand-in"
            remark = f"{cause}: a labelled box replaces {name!r}"
        for message in (remark, *assets.model_remarks(name, **file_search)):
            remarks.setdefault(message, spec)
    return [
        diagnostic_at(spec, remark, "file", severity="warning")
        for remark, spec in remarks.items()
        if remark
    ]


def _models(scene: CheckedScene) -> Iterator[tuple[Spec, str, Path | None]]:
    """Yield, for every model, the element that names it, its name, and the file of the element."""
    for spec in scene.spec.objects:
        if spec.bathymetry is None:
            yield spec, spec.file, scene.file_search["named_by"]
    for robot in scene.robots.values():
        for link in robot.links:
            for shape in (*link.visuals, *link.collisions):
                if shape.kind == "mesh":
                    yield shape, shape.file, Path(robot.path)
