"""What of a Collada file cannot be read is reported; no triangle is lost without a word."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

import pytest
import trimesh
from PIL import Image

from tests.support.opened import open_scene
from uwsim.assets import load_model, model_read_error
from uwsim.checks import check_file, model_warnings
from uwsim.errors import AssetError
from uwsim.scene.reader import read_scene

SOURCE = """<source id="{0}-p"><float_array id="{0}-a" count="9">0 0 0 2 0 0 0 3 0</float_array>
<technique_common>{1}</technique_common></source>
<vertices id="{0}-v"><input semantic="POSITION" source="#{0}-p"/></vertices>"""
ACCESSOR = """<accessor source="#{0}-a" count="3" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor>"""
TRIANGLES = """<triangles count="1" material="m"><input semantic="VERTEX" source="#{0}-v"
offset="0"/><p>{1}</p></triangles>"""
RED = "<diffuse><color>1 0 0 1</color></diffuse>"
GREY = (0.698, 0.698, 0.698)


def geometry(name: str, accessor: str = ACCESSOR, indices: str = "0 1 2", more: str = "") -> str:
    inside = SOURCE.format(name, accessor.format(name)) + TRIANGLES.format(name, indices) + more
    return f'<geometry id="{name}"><mesh>{inside}</mesh></geometry>'


def effect(name: str, look: str, before: str = "") -> str:
    technique = f'<technique sid="c"><phong>{look}</phong></technique>'
    return f'<effect id="e-{name}"><profile_COMMON>{before}{technique}</profile_COMMON></effect>'


def node(name: str, material: str, kind: str = "geometry") -> str:
    return f"""<node id="n-{name}"><instance_{kind} url="#{name}"><bind_material><technique_common>
<instance_material symbol="m" target="{material}"/></technique_common></bind_material>
</instance_{kind}></node>"""


def write(
    path: Path, geometries: str, nodes: str, effects: Iterable[str] = (), more: str = ""
) -> Path:
    effects = (effect("good", RED), *effects)
    names = [text.split('"')[1] for text in effects]
    materials = "".join(
        f'<material id="{name[2:]}"><instance_effect url="#{name}"/></material>' for name in names
    )
    path.write_text(
        '<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" '
        f'version="1.4.1"><library_effects>{"".join(effects)}</library_effects><library_materials>'
        f"{materials}</library_materials><library_geometries>{geometries}</library_geometries>"
        f'{more}<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene>'
        '</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>'
    )
    return path


SURFACE = (
    '<newparam sid="s"><surface type="2D"><init_from>gone_png</init_from></surface></newparam>'
)
LOST_IMAGE = '<diffuse><texture texture="nowhere" texcoord="UV"/></diffuse>'
BROKEN = {
    "specular": (
        effect("bad", f"{RED}<specular><color>0.0 0.01.0</color></specular>"),
        (1, 0, 0),
        "Corrupted color definition",
    ),
    "shininess": (effect("bad", f"{RED}<shininess><float>x</float></shininess>"), (1, 0, 0), ""),
    "diffuse": (effect("bad", "<diffuse><color>a b</color></diffuse>"), GREY, "Corrupted color"),
    "surface": (effect("bad", LOST_IMAGE, SURFACE), GREY, "Missing image 'gone_png'"),
    "surface of another": (effect("bad", RED, SURFACE), (1, 0, 0), "Missing image 'gone_png'"),
    "sampler": (effect("bad", LOST_IMAGE), GREY, "Missing image 'nowhere'"),
    "technique": ('<effect id="e-bad"><profile_COMMON/></effect>', GREY, "malformed"),
    "profile": ('<effect id="e-bad"><profile_GLSL/></effect>', GREY, "other than profile_COMMON"),
}


@pytest.mark.parametrize("first", [True, False])
@pytest.mark.parametrize("way", BROKEN)
def test_a_node_with_a_broken_material_keeps_its_triangles(
    way: str, first: bool, tmp_path: Path
) -> None:
    broken, colour, why = BROKEN[way]
    nodes = [node("a", "#good"), node("b", "#bad")]
    path = write(
        tmp_path / "x.dae",
        geometry("a") + geometry("b"),
        "".join(reversed(nodes) if first else nodes),
        [broken],
    )
    model = load_model(str(path))
    assert model.n_triangles == 2
    assert model.meshes[0 if first else 1].colour == pytest.approx(colour, abs=0.01)
    (remark,) = model.remarks
    assert remark.startswith(f"{path}: material 'bad' cannot be read (")
    assert why in remark
    alone = write(tmp_path / "y.dae", geometry("b"), node("b", "#bad"), [broken])
    assert load_model(str(alone)).n_triangles == 1


@pytest.mark.parametrize("target", ["#none", "good", ""])
def test_a_node_whose_material_is_nowhere_keeps_its_triangles(target: str, tmp_path: Path) -> None:
    path = write(tmp_path / "x.dae", geometry("a"), node("a", target))
    model = load_model(str(path))
    assert model.n_triangles == 1
    assert len(model.remarks) == (target != "good")


def test_a_broken_material_that_nothing_uses_is_not_reported(tmp_path: Path) -> None:
    path = write(tmp_path / "x.dae", geometry("a"), node("a", "#good"), [BROKEN["diffuse"][0]])
    assert load_model(str(path)).remarks == ()


LOST = {
    "accessor": (geometry("b", accessor=""), "geometry 'b' cannot be read (No accessor info"),
    "number of indices": (geometry("b", indices="0 1"), "geometry 'b' cannot be read (malformed"),
    "words": (geometry("b", indices="0 1 2 O 1 2"), "geometry 'b' cannot be read (Corrupted index"),
    "primitive": (geometry("b", more="<cubes/>"), "geometry 'b' cannot be read (Unknown geometry"),
    "not there": ("", "Geometry #b not found"),
}


@pytest.mark.parametrize("way", LOST)
def test_a_geometry_that_is_left_out_is_named(way: str, tmp_path: Path) -> None:
    broken, why = LOST[way]
    nodes = node("b", "#good") + node("a", "#good")
    model = load_model(str(write(tmp_path / "x.dae", broken + geometry("a"), nodes)))
    assert model.n_triangles == 1
    (remark,) = model.remarks
    assert why in remark
    assert "left out" in remark
    alone = write(tmp_path / "y.dae", broken, node("b", "#good"))
    with pytest.raises(AssetError, match=re.escape(why)):
        load_model(str(alone))


def test_lines_in_a_geometry_do_not_matter(tmp_path: Path) -> None:
    lines = geometry("a", more="<linestrips><p>0 1</p></linestrips>")
    model = load_model(str(write(tmp_path / "x.dae", lines, node("a", "#good"))))
    assert (model.n_triangles, model.remarks) == (1, ())


def test_the_geometry_of_a_skin_is_used_as_modelled(tmp_path: Path) -> None:
    skin = (
        '<library_controllers><controller id="c"><skin source="#a"/></controller>'
        "</library_controllers>"
    )
    nodes = node("c", "#good", "controller")
    model = load_model(str(write(tmp_path / "x.dae", geometry("a"), nodes, more=skin)))
    assert model.n_triangles == 1
    assert ["controller 'c' is not applied" in each for each in model.remarks] == [True]


@pytest.mark.parametrize("suffix", [".dae", ".obj"])
@pytest.mark.parametrize("cut", [True, False])
def test_an_image_that_cannot_be_read_is_named(suffix: str, cut: bool, tmp_path: Path) -> None:
    image = tmp_path / "paint_7.png"
    Image.effect_noise((64, 64), 80).convert("RGB").save(image)
    image.write_bytes(image.read_bytes()[:700] if cut else b"no image")
    path = tmp_path / f"m{suffix}"
    if suffix == ".obj":
        (tmp_path / "m.mtl").write_text("newmtl a\nKd 0 1 0\nmap_Kd paint_7.png\n")
        path.write_text(
            "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\n"
            "f 1/1 2/2 3/3\n"
        )
    else:
        images = '<library_images><image id="i"><init_from>paint_7.png</init_from></image>'
        look = effect("pic", '<diffuse><texture texture="i" texcoord="UV"/></diffuse>')
        write(path, geometry("a"), node("a", "#pic"), [look])
        text = path.read_text().replace("<library_eff", f"{images}</library_images><library_eff")
        path.write_text(text)
    assert model_read_error(str(path)) == ""
    model = load_model(str(path))
    assert model.meshes[0].texture is None
    (remark,) = model.remarks
    assert remark.startswith(f"{path}: its image 'paint_7.png' cannot be read")


def test_check_and_run_warn_of_a_broken_material(tmp_path: Path) -> None:
    nodes = node("a", "#good") + node("b", "#bad")
    write(tmp_path / "x.dae", geometry("a") + geometry("b"), nodes, [BROKEN["specular"][0]])
    robot = tmp_path / "r.urdf"
    robot.write_text(
        '<robot name="r"><link name="hull"><visual><geometry><mesh filename="x.dae"/></geometry>'
        "</visual></link></robot>"
    )
    scene = tmp_path / "scene.xml"
    scene.write_text(
        "<UWSimScene><vehicle><name>r</name><file>r.urdf</file><position><x>0</x><y>0</y>"
        "<z>-5</z></position></vehicle></UWSimScene>"
    )
    for file in (robot, scene):
        found = [each for each in check_file(file) if "material 'bad'" in each.message]
        assert [each.severity for each in found] == ["warning"]
    with open_scene(read_scene(scene)) as simulation:
        warnings = [str(each) for each in model_warnings(simulation.world.model)]
    assert len([each for each in warnings if "material 'bad'" in each]) == 1
    scene.write_text("<UWSimScene><object><name>o</name><file>x.dae</file></object></UWSimScene>")
    assert [each for each in check_file(scene) if "material 'bad'" in each.message]


def test_a_sound_file_has_no_remarks(tmp_path: Path) -> None:
    trimesh.creation.box((1.0, 2.0, 3.0)).export(tmp_path / "box.dae")
    model = load_model(str(tmp_path / "box.dae"))
    assert (model.n_triangles, model.remarks) == (12, ())
