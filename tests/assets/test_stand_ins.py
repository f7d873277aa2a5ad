"""Laws that every model we make obeys, and the sizes of compatibility section 6."""

import hashlib

import numpy as np
import pytest

from uwsim.assets import BUNDLED_MODELS, STAND_INS, load_model
from uwsim.assets.mesh import Mesh
from uwsim.assets.procedural.shapes import Shape

BOXES = {
    "terrain/CIRS/cirs_trident": (-15, -15, -4.85, 15, 15, 5.93),
    "objects/blackbox_uib_trimesh": (-0.065, -0.233, -0.075, 0.065, 0.200, 0.075),
    "objects/blackbox_uib": (-0.065, -0.233, -0.075, 0.065, 0.200, 0.075),
    "objects/blackbox": (-0.10, -0.175, -0.075, 0.10, 0.175, 0.075),
    "objects/amphora": (-0.115, -0.115, 0.003, 0.115, 0.115, 0.753),
    "objects/torus": (-0.10, -0.10, -0.02, 0.10, 0.10, 0.02),
    "objects/hook": (-0.005, -0.0245, -0.10, 0.005, 0.0245, 0.10),
    "robot/ARM5E/ARM5E_part0": (-0.336, -0.029, -0.054, 0.031, 0.090, 0.061),
    "robot/ARM5E/ARM5E_part1": (-0.034, -0.043, -0.152, 0.161, 0.047, 0.044),
    "robot/ARM5E/ARM5E_part2": (-0.078, -0.088, -0.122, 0.559, 0.094, 0.022),
    "robot/ARM5E/ARM5E_part3": (-0.022, -0.065, -0.022, 0.320, 0.064, 0.227),
    "robot/ARM5E/ARM5E_part4_base": (0, -0.055, -0.052, 0.105, 0.055, 0.052),
    "robot/ARM5E/ARM5E_part4_jaw1": (0.014, -0.046, -0.035, 0.106, 0.046, 0.007),
    "robot/ARM5E/ARM5E_part4_jaw2": (0.014, -0.046, -0.007, 0.106, 0.046, 0.035),
}
"""x, y, z, smallest then largest [m]."""

NETS = ("objects/net", "objects/cage_panel", "objects/pipe_flanged", "objects/pipe_elbow")
OPEN = ("terrain/", "objects/blackbox", "objects/pier", "objects/wreck", "objects/chain", *NETS)
"""Models made of faces that are not closed part by part."""


def as_shape(mesh: Mesh) -> Shape:
    return Shape(mesh.vertices[mesh.triangles].astype(np.float64), mesh.uvs[mesh.triangles])


@pytest.mark.parametrize("name", BOXES)
def test_stand_ins_fill_the_box_of_the_original(name: str) -> None:
    box = load_model(name + ".osg").box
    assert (*box.lower, *box.upper) == pytest.approx(BOXES[name], abs=2e-3)


@pytest.mark.parametrize("name", BUNDLED_MODELS)
def test_arrays_are_sound(name: str) -> None:
    for mesh in load_model(name).meshes:
        assert mesh.vertices.dtype == mesh.normals.dtype == mesh.uvs.dtype == np.float32
        assert mesh.triangles.dtype == np.uint32
        assert mesh.triangles.max() < len(mesh.vertices)
        assert np.isfinite(mesh.uvs).all()
        assert np.allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, atol=1e-4)


@pytest.mark.parametrize("name", BUNDLED_MODELS)
def test_normals_are_on_the_outer_side_of_the_triangles(name: str) -> None:
    for mesh in load_model(name).meshes:
        a, b, c = (mesh.vertices[mesh.triangles[:, k]].astype(np.float64) for k in range(3))
        face = np.cross(b - a, c - a)
        assert np.einsum("ij,ij->i", face, mesh.normals[mesh.triangles].sum(axis=1)).min() > 0.0


@pytest.mark.parametrize("name", [n for n in STAND_INS if not n.startswith(OPEN)])
def test_parts_are_wound_outward(name: str) -> None:
    for mesh in load_model(name).meshes:
        assert as_shape(mesh).volume > 0.0


@pytest.mark.parametrize("name", BUNDLED_MODELS)
def test_textures_show_detail(name: str) -> None:
    textured = [mesh for mesh in load_model(name).meshes if mesh.texture is not None]
    assert textured
    for mesh in textured:
        assert mesh.texture is not None
        pixels = mesh.texture.pixels
        assert pixels.dtype == np.uint8
        assert pixels.shape[2] == 3
        assert pixels.std(axis=(0, 1)).min() > 1.5


def test_equal_texture_names_mean_equal_pixels() -> None:
    seen: dict[str, bytes] = {}
    for name in BUNDLED_MODELS:
        for mesh in load_model(name).meshes:
            if mesh.texture is not None:
                digest = hashlib.sha256(mesh.texture.pixels.tobytes()).digest()
                assert seen.setdefault(mesh.texture.name, digest) == digest


def test_a_vehicle_has_about_five_thousand_triangles() -> None:
    arm = ["part0", "part1", "part2", "part3", "part4_base", "part4_jaw1", "part4_jaw2"]
    names = ["robot/GIRONA500/g500_March11", *(f"robot/ARM5E/ARM5E_{part}" for part in arm)]
    assert sum(load_model(name).n_triangles for name in names) < 5500
    assert load_model("terrain/CIRS/cirs_trident").n_triangles < 4000
