"""Warnings about files that are not where the scene or its robots state, or broken in part."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TypedDict

from ...assets import (
    find,
    has_model,
    model_place_remark,
    model_remarks,
    package_remark,
    place_remark,
)
from ...errors import Diagnostic, UwsimError
from ...scene.spec import SceneSpec
from ...scene.urdf.robot import RobotSpec
from ...schema import Spec, diagnostic_at


class Where(TypedDict):
    """From where a file is looked for."""

    named_by: Path | None
    data_path: tuple[Path, ...]


def place_warnings(
    scene: SceneSpec, robots: Mapping[int, RobotSpec], data_path: tuple[Path, ...]
) -> list[Diagnostic]:
    """Report each file found elsewhere, each lost package, and each model that is broken in part.

    Args:
        scene: spec of the scene.
        robots: the robot of each vehicle, by its number.
        data_path: folders in which files are looked for.
    """
    named_by = Path(scene.path) if scene.path else None
    remarks: dict[str, Spec] = {}
    for vehicle in scene.vehicles:
        try:
            path = find(vehicle.file, named_by=named_by, data_path=data_path)
        except UwsimError:
            continue
        remark = place_remark(vehicle.file, path, named_by=named_by, data_path=data_path)
        remarks.setdefault(remark, vehicle)
    for spec, name, file in _models(scene, robots, named_by):
        where = Where(named_by=file, data_path=data_path)
        remark = model_place_remark(name, **where)
        if not remark and not has_model(name, **where):
            lost = package_remark(name, **where) or "there is no model, nor a stand-in"
            remark = f"{lost}: a labelled box in place of {name!r}"
        for said in (remark, *model_remarks(name, **where)):
            remarks.setdefault(said, spec)
    return [
        diagnostic_at(spec, remark, "file", severity="warning")
        for remark, spec in remarks.items()
        if remark
    ]


def _models(
    scene: SceneSpec, robots: Mapping[int, RobotSpec], named_by: Path | None
) -> Iterator[tuple[Spec, str, Path | None]]:
    """Give every model with the element and the file that name it."""
    for thing in scene.objects:
        yield thing, thing.file, named_by
    for robot in robots.values():
        for link in robot.links:
            for shape in (*link.visuals, *link.collisions):
                if shape.kind == "mesh":
                    yield shape, shape.file, Path(robot.path)
