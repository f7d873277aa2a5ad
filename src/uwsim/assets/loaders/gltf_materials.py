"""The materials of glTF files: roughness, metal, normals, occlusion, emission and holes.

trimesh passes on the images of a material, but not the strength of its maps. `read_materials` reads
these from the JSON of the file; `mark_material` names each material in the JSON by its number, so
that the material that trimesh returns can be found again.

A material that states neither roughness nor metal nor a texture of them is matte: glTF's default is
metal, and files without these entries are seldom meant so. ``KHR_materials_unlit`` is matte, too.
The alpha of a base colour counts where ``alphaMode`` is ``MASK`` (holes) or ``BLEND`` (one opacity
for the whole surface; what is more transparent than half of that in the texture is a hole).
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import Any

from ...errors import AssetError
from .gltf_limits import GLB_JSON_START

Tree = dict[str, Any]

NAME_PREFIX = "uwsim-material-"
"""The beginning of the name of a material in the JSON that trimesh reads; its number follows."""
FINISH_ENTRIES = ("metallicFactor", "roughnessFactor", "metallicRoughnessTexture")
"""The entries of ``pbrMetallicRoughness`` that state the finish of a surface."""
MAP_ENTRIES = ("normalTexture", "occlusionTexture", "emissiveTexture")
"""The entries of a material that name a texture besides base colour and finish."""
ALPHA_MODES = ("OPAQUE", "MASK", "BLEND")
DEFAULT_CUTOFF = 0.5
"""The alpha below which a surface has a hole, if the material states none."""
MAX_EMISSION = 1e4
"""The greatest emission of a material [1]."""
UNLIT, STRENGTH = "KHR_materials_unlit", "KHR_materials_emissive_strength"
APPLIED_EXTENSIONS = (
    UNLIT,
    STRENGTH,
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
)
"""The extensions that are applied, or that do not change surfaces."""


@dataclass(frozen=True, kw_only=True)
class GltfMaterial:
    """The numbers of a glTF material besides its base colour."""

    roughness: float = 1.0
    """The factor on the roughness."""
    metallic: float = 0.0
    """The factor on the share of metal."""
    normal_scale: float = 1.0
    """The factor on the first two components of the normal map."""
    occlusion_strength: float = 1.0
    """The strength of the occlusion map, 0 to 1."""
    emission: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """The emitted radiance, in linear light."""
    alpha_cutoff: float | None = None
    """The alpha of holes; None: the surface has none."""
    opacity: float = 1.0
    """The opacity of the whole surface."""
    two_sided: bool = False
    """True if back faces are drawn."""
    has_maps: bool = False
    """True if the material has a texture besides the base colour, or holes."""


def read_materials(data: bytes, suffix: str) -> tuple[dict[str, GltfMaterial], list[str]]:
    """Return the materials of a file by their marked names, and remarks on what is not drawn.

    Args:
        data: the file.
        suffix: ``.gltf`` or ``.glb``.

    Raises:
        AssetError: numbers are invalid; the message names all of them.
    """
    if suffix == ".glb":
        data = data[GLB_JSON_START : GLB_JSON_START + int.from_bytes(data[12:16], "little")]
    try:
        tree = json.loads(data)
    except (ValueError, RecursionError):
        return {}, []  # trimesh reports the error
    if not isinstance(tree, dict):
        return {}, []
    errors: list[str] = []
    materials = {}
    for number, material in enumerate(_list(tree, "materials")):
        if isinstance(material, dict) and has_finish(material):
            reader = _Reader(f"materials[{number}]", errors)
            materials[f"{NAME_PREFIX}{number}"] = _read_material(material, reader)
    if errors:
        raise AssetError("; ".join(errors))
    return materials, [*_remark_extensions(tree), *_remark_coordinates(tree)]


def has_finish(material: Tree) -> bool:
    """Return whether a material states more than its base colour."""
    base = _dict(material, "pbrMetallicRoughness")
    if UNLIT in _dict(material, "extensions"):
        return bool(material.get("alphaMode", "OPAQUE") != "OPAQUE")
    return (
        any(entry in base for entry in FINISH_ENTRIES)
        or any(entry in material for entry in (*MAP_ENTRIES, "emissiveFactor"))
        or material.get("alphaMode", "OPAQUE") != "OPAQUE"
    )


def has_maps(material: Tree) -> bool:
    """Return whether a material has a texture besides its base colour, or holes."""
    base = _dict(material, "pbrMetallicRoughness")
    if UNLIT in _dict(material, "extensions"):
        return bool(material.get("alphaMode") == "MASK")
    return (
        "metallicRoughnessTexture" in base
        or any(entry in material for entry in MAP_ENTRIES)
        or material.get("alphaMode") == "MASK"
    )


def mark_material(material: Tree, number: int) -> bool:
    """Name a material by its number, if it has a finish; return whether it does."""
    if not has_finish(material):
        return False
    material["name"] = f"{NAME_PREFIX}{number}"
    return True


class _Reader:
    """A reader of the numbers of a material, which collects errors.

    Args:
        place: the place of the material in the JSON.
        errors: the list of errors.
    """

    def __init__(self, place: str, errors: list[str]) -> None:
        self._place, self._errors = place, errors

    def read_number(
        self, tree: Tree, entry: str, default: float, low: float = 0.0, high: float = 1.0
    ) -> float:
        """Return a number between two limits; the default, if it is absent or invalid."""
        return self._check(tree.get(entry, default), entry, default, low, high)

    def read_numbers(self, tree: Tree, entry: str, default: tuple[float, ...]) -> list[float]:
        """Return as many numbers from 0 to 1 as the default has."""
        values = tree.get(entry, list(default))
        if not isinstance(values, list) or len(values) != len(default):
            self.report(entry, values, f"{len(default)} numbers")
            return list(default)
        return [self._check(v, entry, d, 0.0, 1.0) for v, d in zip(values, default, strict=True)]

    def report(self, entry: str, value: object, expected: str) -> None:
        """Collect an error about an entry."""
        text = repr(value)[:60]
        self._errors.append(f"its {self._place}.{entry} is {text}; expected {expected}")

    def _check(self, value: Any, entry: str, default: float, low: float, high: float) -> float:
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        if is_number and math.isfinite(value) and low <= value <= high:
            return float(value)
        self.report(entry, value, f"a number from {low:g} to {high:g}")
        return default


def _read_material(material: Tree, reader: _Reader) -> GltfMaterial:
    base, extensions = _dict(material, "pbrMetallicRoughness"), _dict(material, "extensions")
    is_stated = UNLIT not in extensions and any(entry in base for entry in FINISH_ENTRIES)
    mode = material.get("alphaMode", "OPAQUE")
    if mode not in ALPHA_MODES:
        reader.report("alphaMode", mode, f"one of {', '.join(ALPHA_MODES)}")
    alpha = reader.read_numbers(base, "baseColorFactor", (1.0, 1.0, 1.0, 1.0))[3]
    cutoff = reader.read_number(material, "alphaCutoff", DEFAULT_CUTOFF, high=1e6)
    emission = reader.read_numbers(material, "emissiveFactor", (0.0, 0.0, 0.0))
    strength = reader.read_number(
        _dict(extensions, STRENGTH), "emissiveStrength", 1.0, high=MAX_EMISSION
    )
    red, green, blue = (0.0 if UNLIT in extensions else strength * e for e in emission)
    return GltfMaterial(
        roughness=reader.read_number(base, "roughnessFactor", 1.0) if is_stated else 1.0,
        metallic=reader.read_number(base, "metallicFactor", 1.0) if is_stated else 0.0,
        normal_scale=reader.read_number(
            _dict(material, "normalTexture"), "scale", 1.0, low=-100.0, high=100.0
        ),
        occlusion_strength=reader.read_number(_dict(material, "occlusionTexture"), "strength", 1.0),
        emission=(red, green, blue),
        alpha_cutoff=cutoff / max(alpha, 1e-6) if mode == "MASK" else None,
        opacity=alpha if mode == "BLEND" else 1.0,
        two_sided=material.get("doubleSided") is True,
        has_maps=has_maps(material),
    )


def _remark_extensions(tree: Tree) -> list[str]:
    names = [str(name) for name in _list(tree, "extensionsUsed")]
    unknown_names = [name[:60] for name in names if name not in APPLIED_EXTENSIONS]
    if not unknown_names:
        return []
    return [f"its extensions are not drawn: {', '.join(sorted(set(unknown_names))[:8])}"]


def _remark_coordinates(tree: Tree) -> list[str]:
    """Remark on maps whose texture coordinates are not those of the base colour."""
    remarks = []
    for number, material in enumerate(_list(tree, "materials")):
        if not isinstance(material, dict):
            continue
        references = list(_references(material).items())
        keys = [_coordinate_key(reference) for _, reference in references]
        for (entry, _), key in zip(references[1:], keys[1:], strict=True):
            if key != keys[0]:
                remarks.append(
                    f"its materials[{number}].{entry} has other texture coordinates than "
                    f"{references[0][0]}, whose coordinates are used"
                )
    return remarks


def coordinate_reference(material: Tree) -> Tree:
    """Return the reference to a texture whose coordinates all maps of a material use."""
    return next(iter(_references(material).values()), {})


def _references(material: Tree) -> dict[str, Tree]:
    """Return the references of a material to textures, the base colour first."""
    base = _dict(material, "pbrMetallicRoughness")
    entries: list[tuple[Tree, str]] = [(base, "baseColorTexture")]
    entries += [(material, "normalTexture"), (base, "metallicRoughnessTexture")]
    entries += [(material, "occlusionTexture"), (material, "emissiveTexture")]
    return {entry: tree[entry] for tree, entry in entries if isinstance(tree.get(entry), dict)}


def _coordinate_key(reference: Tree) -> str:
    transform = _dict(_dict(reference, "extensions"), "KHR_texture_transform")
    texcoord = transform.get("texCoord", reference.get("texCoord", 0))
    numbers = {k: transform[k] for k in ("offset", "rotation", "scale") if k in transform}
    return json.dumps([texcoord, numbers], sort_keys=True)


def _dict(tree: Tree, entry: str) -> Tree:
    value = tree.get(entry)
    return value if isinstance(value, dict) else {}


def _list(tree: Tree, entry: str) -> list[Any]:
    value = tree.get(entry)
    return value if isinstance(value, list) else []
