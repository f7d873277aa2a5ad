"""Robots whose meshes are in millimetres or inches are warned of."""

from __future__ import annotations

from pathlib import Path

import pytest
import trimesh

from uwsim.runs.check import diagnostics_of


def said(folder: Path, mesh: str) -> list[str]:
    file = folder / "rov.urdf"
    file.write_text(
        '<robot name="rov"> <link name="base_link">\n<visual> <geometry>'
        f"<mesh {mesh}/> </geometry> </visual>\n</link> </robot>"
    )
    return [f"{each.severity} {each.line}: {each.message}" for each in diagnostics_of(file)]


def test_a_hull_in_millimetres_is_warned_of_until_it_is_scaled(tmp_path: Path) -> None:
    trimesh.creation.box((457.0, 338.0, 254.0)).export(tmp_path / "hull.stl")
    assert said(tmp_path, 'filename="hull.stl"') == [
        "warning 2: the mesh 'hull.stl' is 457 x 338 x 254 m; if it is in millimetres: "
        'scale="0.001 0.001 0.001"'
    ]
    assert said(tmp_path, 'filename="hull.stl" scale="0.001 -0.001 0.001"') == []


@pytest.mark.parametrize(("unit", "is_doubtful"), [("0.0254", True), ("1", False), ("1.0", False)])
def test_a_collada_file_in_inches_is_warned_of(
    unit: str, is_doubtful: bool, tmp_path: Path
) -> None:
    trimesh.creation.box((18.0, 13.0, 10.0)).export(tmp_path / "hull.dae")
    text = (tmp_path / "hull.dae").read_text()
    (tmp_path / "hull.dae").write_text(with_unit(text, unit))
    found = said(tmp_path, 'filename="hull.dae"')
    assert found == is_doubtful * [
        "warning 2: the mesh 'hull.dae' says that its unit is 0.0254 m; it is read in metres: "
        'scale="0.0254 0.0254 0.0254" if it is too large or too small'
    ]
    assert said(tmp_path, f'filename="hull.dae" scale="{unit} {unit} {unit}"') == []


def with_unit(collada: str, unit: str) -> str:
    """The text of a Collada file with another unit."""
    head, found, rest = collada.partition("<unit")
    if not found:
        return collada.replace("<asset>", f'<asset><unit name="u" meter="{unit}"/>', 1)
    return f'{head}<unit name="u" meter="{unit}"/>{rest.partition("/>")[2]}'
