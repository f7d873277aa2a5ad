"""Robots whose meshes are in millimetres or inches are warned of."""

from __future__ import annotations

from pathlib import Path

import pytest
import trimesh

from uwsim.checks import check_file


def said(folder: Path, mesh: str) -> list[str]:
    file = folder / "rov.urdf"
    file.write_text(
        '<robot name="rov"> <link name="base_link">\n<visual> <geometry>'
        f"<mesh {mesh}/> </geometry> </visual>\n</link> </robot>"
    )
    return [f"{each.severity} {each.line}: {each.message}" for each in check_file(file)]


def test_a_hull_in_millimetres_is_warned_of_until_it_is_scaled(tmp_path: Path) -> None:
    trimesh.creation.box((457.0, 338.0, 254.0)).export(tmp_path / "hull.stl")
    assert said(tmp_path, 'filename="hull.stl"') == [
        "warning 2: the mesh 'hull.stl' is 457 x 338 x 254 m; if it is in millimetres: "
        'scale="0.001 0.001 0.001"'
    ]
    assert said(tmp_path, 'filename="hull.stl" scale="0.001 -0.001 0.001"') == []


@pytest.mark.parametrize("unit", ["0.0254", "1", "1.0"])
def test_the_unit_of_a_collada_file_is_applied_once(unit: str, tmp_path: Path) -> None:
    trimesh.creation.box((18.0, 13.0, 10.0)).export(tmp_path / "hull.dae")
    text = (tmp_path / "hull.dae").read_text()
    (tmp_path / "hull.dae").write_text(with_unit(text, unit))
    assert said(tmp_path, 'filename="hull.dae"') == []
    assert said(tmp_path, f'filename="hull.dae" scale="{unit} {unit} {unit}"') == [
        "warning 2: the mesh 'hull.dae' states the unit 0.0254 m, which is applied; "
        'its scale applies it again; expected scale="1 1 1"'
    ] * (unit == "0.0254")


def test_a_hull_that_is_too_long_in_its_unit_is_warned_of(tmp_path: Path) -> None:
    trimesh.creation.box((18.0, 13.0, 10.0)).export(tmp_path / "hull.dae")
    text = (tmp_path / "hull.dae").read_text()
    (tmp_path / "hull.dae").write_text(with_unit(text, "10"))
    (found,) = said(tmp_path, 'filename="hull.dae"')
    assert "is 180 x 130 x 100 m; if it is in millimetres" in found


def test_a_unit_that_is_no_length_is_warned_of(tmp_path: Path) -> None:
    trimesh.creation.box((1.0, 1.0, 1.0)).export(tmp_path / "hull.dae")
    text = (tmp_path / "hull.dae").read_text()
    (tmp_path / "hull.dae").write_text(with_unit(text, "inch"))
    assert said(tmp_path, 'filename="hull.dae"') == [
        "warning 2: the mesh 'hull.dae' states the unit inch; expected a length in metres: "
        "it is read in metres"
    ]


def with_unit(collada: str, unit: str) -> str:
    """The text of a Collada file with another unit."""
    head, found, rest = collada.partition("<unit")
    if not found:
        return collada.replace("<asset>", f'<asset><unit name="u" meter="{unit}"/>', 1)
    return f'{head}<unit name="u" meter="{unit}"/>{rest.partition("/>")[2]}'
