"""The materials of glTF files: numbers, maps, and what is wrong with them."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from tests.assets.gltf_plates import Plates, colour_image, encode
from uwsim.assets import load_model
from uwsim.assets.mesh import Material, Mesh
from uwsim.errors import AssetError


def read(plates: Plates, folder: Path, suffix: str = ".glb") -> tuple[Mesh, ...]:
    return load_model(str(plates.write(folder / f"plates{suffix}"))).meshes


def read_material(material: dict[str, Any], folder: Path, plates: Plates | None = None) -> Mesh:
    plates = plates or Plates()
    plates.plate(material)
    (mesh,) = read(plates, folder)
    return mesh


def material_of(mesh: Mesh) -> Material:
    assert mesh.material is not None
    return mesh.material


@pytest.mark.parametrize("suffix", [".gltf", ".glb"])
def test_all_maps_and_factors_are_read(tmp_path: Path, suffix: str) -> None:
    plates = Plates()
    surface = plates.texture(colour_image(99, 120, 30))
    plates.plate(
        {
            "pbrMetallicRoughness": {
                "baseColorTexture": plates.texture(colour_image(200, 100, 50)),
                "baseColorFactor": [0.5, 0.5, 0.5, 1.0],
                "metallicRoughnessTexture": surface,
                "metallicFactor": 0.25,
                "roughnessFactor": 0.75,
            },
            "normalTexture": plates.texture(colour_image(128, 128, 255), scale=0.5),
            "occlusionTexture": plates.texture(colour_image(55, 0, 0), strength=0.5),
            "emissiveTexture": plates.texture(colour_image(255, 255, 0)),
            "emissiveFactor": [0.1, 0.2, 0.3],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2.0}},
        }
    )
    (mesh,) = read(plates, tmp_path, suffix)
    material = material_of(mesh)
    assert (material.roughness, material.metallic, material.normal_scale) == (0.75, 0.25, 0.5)
    assert material.emission == pytest.approx((0.2, 0.4, 0.6))
    assert material.finish_map is not None
    assert material.normal_map is not None
    assert material.emission_map is not None
    assert material.finish_map.pixels[0, 0].tolist() == [155, 120, 30]  # 255 + (55 - 255) / 2
    assert material.normal_map.pixels[0, 0].tolist() == [128, 128, 255]
    assert mesh.texture is not None
    assert mesh.texture.pixels[0, 0].tolist() == [200, 100, 50]
    np.testing.assert_allclose(mesh.normals, np.tile([0, 0.6, 0.8], (4, 1)), atol=1e-6)
    assert mesh.two_sided is False


def test_a_material_without_roughness_and_metal_is_matte(tmp_path: Path) -> None:
    assert read_material({"pbrMetallicRoughness": {}}, tmp_path).material is None
    plates = Plates()
    normal = plates.texture(colour_image(128, 128, 255))
    material = material_of(read_material({"normalTexture": normal}, tmp_path, plates))
    assert (material.roughness, material.metallic) == (1.0, 0.0)


def test_a_material_with_a_factor_has_the_default_of_the_other(tmp_path: Path) -> None:
    mesh = read_material({"pbrMetallicRoughness": {"roughnessFactor": 0.3}}, tmp_path)
    assert (material_of(mesh).roughness, material_of(mesh).metallic) == (0.3, 1.0)
    assert mesh.two_sided is True  # as all meshes of files without maps


def test_the_red_of_a_roughness_map_is_no_occlusion(tmp_path: Path) -> None:
    plates = Plates()
    surface = plates.texture(colour_image(10, 120, 30))
    mesh = read_material(
        {"pbrMetallicRoughness": {"metallicRoughnessTexture": surface}}, tmp_path, plates
    )
    finish_map = material_of(mesh).finish_map
    assert finish_map is not None
    assert finish_map.pixels[0, 0].tolist() == [255, 120, 30]


def test_maps_of_different_sizes_are_packed_at_the_larger_size(tmp_path: Path) -> None:
    plates = Plates()
    material = {
        "pbrMetallicRoughness": {
            "metallicRoughnessTexture": plates.texture(colour_image(0, 120, 30, size=(8, 8)))
        },
        "occlusionTexture": plates.texture(colour_image(77, 0, 0, size=(2, 16))),
    }
    finish_map = material_of(read_material(material, tmp_path, plates)).finish_map
    assert finish_map is not None
    assert finish_map.pixels.shape == (16, 8, 3)
    assert np.unique(finish_map.pixels.reshape(-1, 3), axis=0).tolist() == [[77, 120, 30]]


def grey_of_16_bits() -> bytes:
    return encode(Image.fromarray(np.full((4, 4), 200 * 257, np.uint16)))


def paletted() -> bytes:
    return encode(colour_image(200, 200, 200).quantize(4))


def with_srgb_chunk() -> bytes:
    data = encode(colour_image(200, 200, 200))
    end = data.index(b"IDAT") - 4
    return data[:end] + b"\0\0\0\1sRGB\0\xae\xce\x1c\xe9" + data[end:]


@pytest.mark.parametrize(
    "image",
    [
        encode(colour_image(200)), grey_of_16_bits(), paletted(), with_srgb_chunk(),
        encode(colour_image(200, 200, 200, 255)), encode(colour_image(200, 200, 200), "BMP"),
    ],
    ids=["grey", "grey of 16 bits", "palette", "sRGB", "RGBA", "BMP"],
)  # fmt: skip
def test_images_of_all_kinds_give_their_values(tmp_path: Path, image: bytes) -> None:
    plates = Plates()
    normal = plates.texture(image)
    normal_map = material_of(read_material({"normalTexture": normal}, tmp_path, plates)).normal_map
    assert normal_map is not None
    assert normal_map.pixels.shape == (4, 4, 3)
    assert np.unique(normal_map.pixels).tolist() == [200]


@pytest.mark.parametrize("has_alpha", [False, True])
def test_a_mask_makes_holes_where_the_image_has_alpha(tmp_path: Path, has_alpha: bool) -> None:
    plates = Plates()
    image = colour_image(200, 100, 50, 90) if has_alpha else colour_image(200, 100, 50)
    material = {
        "pbrMetallicRoughness": {"baseColorTexture": plates.texture(image)},
        "alphaMode": "MASK",
        "alphaCutoff": 0.25,
    }
    mesh = read_material(material, tmp_path, plates)
    assert mesh.texture is not None
    assert mesh.texture.pixels.shape[2] == (4 if has_alpha else 3)
    assert material_of(mesh).alpha_cutoff == (0.25 if has_alpha else None)


def test_a_blended_material_has_the_opacity_of_its_factor(tmp_path: Path) -> None:
    base = {"baseColorFactor": [1.0, 1.0, 1.0, 0.4]}
    assert read_material({"pbrMetallicRoughness": base}, tmp_path).opacity == 1.0
    blended = {"pbrMetallicRoughness": base, "alphaMode": "BLEND"}
    assert read_material(blended, tmp_path / "..", Plates()).opacity == pytest.approx(0.4)


def test_parts_share_accessors_and_images(tmp_path: Path) -> None:
    plates = Plates()
    normal = plates.texture(colour_image(128, 128, 255))
    for roughness in (0.2, 0.4):
        base = {"roughnessFactor": roughness, "metallicFactor": 0.0}
        plates.plate({"normalTexture": normal, "pbrMetallicRoughness": base})
    first, second = read(plates, tmp_path)
    assert (material_of(first).roughness, material_of(second).roughness) == (0.2, 0.4)
    assert material_of(first).normal_map is material_of(second).normal_map


def test_tangents_of_the_file_are_turned_with_its_node(tmp_path: Path) -> None:
    plates = Plates()
    normal = plates.texture(colour_image(128, 128, 255))
    tangents = plates.add(np.tile(np.array([1, 0, 0, -1], np.float32), (4, 1)))
    plates.plate({"normalTexture": normal}, TANGENT=tangents)
    plates.tree["nodes"] = [{"mesh": 0, "rotation": [0, 0, 0.5**0.5, 0.5**0.5]}]
    (mesh,) = read(plates, tmp_path)
    assert mesh.tangents is not None
    np.testing.assert_allclose(mesh.tangents, np.tile([0, 1, 0, -1], (4, 1)), atol=1e-6)
    np.testing.assert_allclose(mesh.normals, np.tile([-0.6, 0, 0.8], (4, 1)), atol=1e-6)


def test_a_mirrored_node_mirrors_normals_and_tangents(tmp_path: Path) -> None:
    plates = Plates()
    normal = plates.texture(colour_image(128, 128, 255))
    tangents = plates.add(np.tile(np.array([1, 0, 0, 1], np.float32), (4, 1)))
    plates.plate({"normalTexture": normal}, TANGENT=tangents)
    plates.tree["nodes"] = [{"mesh": 0, "scale": [-2, 1, 1]}]
    (mesh,) = read(plates, tmp_path)
    assert mesh.tangents is not None
    np.testing.assert_allclose(mesh.tangents, np.tile([-1, 0, 0, -1], (4, 1)), atol=1e-6)
    np.testing.assert_allclose(mesh.normals, np.tile([0, 0.6, 0.8], (4, 1)), atol=1e-6)
    corners = mesh.vertices[mesh.triangles[0]].astype(np.float64)
    assert np.cross(corners[1] - corners[0], corners[2] - corners[0])[2] > 0.0


def test_quantized_normals_are_read(tmp_path: Path) -> None:
    plates = Plates()
    quantized = np.tile(np.array([0, 0, 127, 0], np.int8), (4, 1))[:, :3]
    plates.normals = plates.add(np.ascontiguousarray(quantized), normalized=True)
    plates.tree["extensionsRequired"] = ["KHR_mesh_quantization"]
    normal = plates.texture(colour_image(128, 128, 255))
    mesh = read_material({"normalTexture": normal}, tmp_path, plates)
    np.testing.assert_allclose(mesh.normals, np.tile([0, 0, 1], (4, 1)), atol=1e-6)


def test_normals_without_a_direction_are_computed_from_the_faces(tmp_path: Path) -> None:
    plates = Plates()
    plates.normals = plates.add(np.zeros((4, 3), np.float32))
    normal = plates.texture(colour_image(128, 128, 255))
    mesh = read_material({"normalTexture": normal}, tmp_path, plates)
    np.testing.assert_allclose(mesh.normals, np.tile([0, 0, 1], (4, 1)), atol=1e-6)


def test_a_sparse_accessor_beyond_its_buffer_is_one_error(tmp_path: Path) -> None:
    plates = Plates()
    normal = plates.texture(colour_image(128, 128, 255))
    indices = plates.add(np.array([9000], np.uint16))
    view = plates.tree["accessors"][indices]["bufferView"]
    plates.tree["accessors"][plates.normals]["sparse"] = {
        "count": 1,
        "indices": {"bufferView": view, "componentType": 5123},
        "values": {"bufferView": view},
    }
    with pytest.raises(AssetError, match=r"plates\.glb: its accessors\[1\]\.sparse is invalid"):
        read_material({"normalTexture": normal}, tmp_path, plates)


def test_all_invalid_numbers_are_reported_at_once(tmp_path: Path) -> None:
    plates = Plates()
    plates.plate({"pbrMetallicRoughness": {"roughnessFactor": "rough", "metallicFactor": 1.5}})
    plates.plate({"emissiveFactor": [1.0, 2.0], "alphaMode": "MISC"})
    with pytest.raises(AssetError) as error:
        read(plates, tmp_path)
    for text in (
        "materials[0].roughnessFactor is 'rough'; expected a number from 0 to 1",
        "materials[0].metallicFactor is 1.5; expected a number from 0 to 1",
        "materials[1].emissiveFactor is [1.0, 2.0]; expected 3 numbers",
        "materials[1].alphaMode is 'MISC'; expected one of OPAQUE, MASK, BLEND",
    ):
        assert text in str(error.value)


def test_unknown_extensions_are_a_remark_or_an_error(tmp_path: Path) -> None:
    plates = Plates()
    plates.plate({"pbrMetallicRoughness": {"roughnessFactor": 0.5}})
    plates.tree["extensionsUsed"] = ["VENDOR_glitter", "KHR_texture_transform"]
    (remark,) = load_model(str(plates.write(tmp_path / "used.glb"))).remarks
    assert remark.endswith("its extensions are not drawn: VENDOR_glitter")
    plates.tree["extensionsRequired"] = ["VENDOR_glitter"]
    with pytest.raises(AssetError, match="requires the unsupported extension 'VENDOR_glitter'"):
        load_model(str(plates.write(tmp_path / "required.glb")))


def test_maps_with_other_coordinates_are_a_remark(tmp_path: Path) -> None:
    plates = Plates()
    plates.plate(
        {
            "pbrMetallicRoughness": {"baseColorTexture": plates.texture(colour_image(9, 9, 9))},
            "normalTexture": plates.texture(colour_image(128, 128, 255), texCoord=1),
        }
    )
    (remark,) = load_model(str(plates.write(tmp_path / "plates.glb"))).remarks
    assert "materials[0].normalTexture has other texture coordinates" in remark


def test_a_broken_map_is_left_out_with_a_remark(tmp_path: Path) -> None:
    plates = Plates()
    data = encode(colour_image(128, 128, 255, size=(64, 64)))
    plates.plate({"normalTexture": plates.texture(data[: len(data) // 2])})
    model = load_model(str(plates.write(tmp_path / "plates.glb")))
    assert material_of(model.meshes[0]).normal_map is None
    assert len(model.remarks) == 1


def test_a_file_of_trimesh_with_all_maps_is_read(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import trimesh

    box = trimesh.creation.box()
    uv = np.zeros((len(box.vertices), 2))
    uv[:, 0] = np.linspace(0.0, 1.0, len(uv))
    material = trimesh.visual.material.PBRMaterial(
        baseColorTexture=colour_image(200, 100, 50),
        metallicRoughnessTexture=colour_image(0, 90, 10),
        normalTexture=colour_image(128, 128, 255),
        occlusionTexture=colour_image(200, 0, 0),
        emissiveTexture=colour_image(255, 0, 0),
        emissiveFactor=[0.5, 0.5, 0.5],
        metallicFactor=0.5,
        roughnessFactor=0.5,
    )
    box.visual = trimesh.visual.TextureVisuals(uv=uv, material=material)
    path = tmp_path / "box.glb"
    box.export(path)
    (mesh,) = load_model(str(path)).meshes
    properties = material_of(mesh)
    assert properties.finish_map is not None
    assert properties.finish_map.pixels[0, 0].tolist() == [200, 90, 10]
    assert properties.normal_map is not None
    assert properties.emission == (0.5, 0.5, 0.5)
    assert (properties.roughness, properties.metallic) == (0.5, 0.5)
