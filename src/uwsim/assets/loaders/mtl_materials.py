"""The materials of .mtl files besides their colours: ``norm``, ``Pr``, ``Pm`` and ``Ke``.

``norm`` names a normal map, ``Pr`` is the roughness, ``Pm`` the share of metal, ``Ke`` the emitted
light. Not read: ``map_Bump``, which is a map of heights, and maps of roughness and metal.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from ...errors import AssetError
from .gltf_materials import MAX_EMISSION, GltfMaterial
from .references import References


def read_mtl_materials(materials: Iterable[Any], references: References) -> dict[str, GltfMaterial]:
    """Return the numbers of the materials of trimesh, by name, and attach their normal maps.

    Raises:
        AssetError: numbers are invalid; the message names all of them.
    """
    errors: list[str] = []
    numbers = {}
    for material in {id(material): material for material in materials}.values():
        entries = getattr(material, "kwargs", None) or {}
        if not any(entry in entries for entry in ("norm", "pr", "pm")):
            continue
        if "norm" in entries:
            material.normalTexture = references.image(" ".join(entries["norm"]))
        name = str(material.name)
        roughness, metallic = (
            _read_numbers(name, entry, entries.get(entry.lower()), default, 1.0, errors)[0]
            for entry, default in (("Pr", (1.0,)), ("Pm", (0.0,)))
        )
        black = (0.0, 0.0, 0.0)
        red, green, blue = _read_numbers(name, "Ke", entries.get("ke"), black, MAX_EMISSION, errors)
        numbers[name] = GltfMaterial(
            roughness=roughness, metallic=metallic, emission=(red, green, blue), two_sided=True
        )
    if errors:
        raise AssetError("; ".join(errors))
    return numbers


def _read_numbers(
    name: str,
    entry: str,
    words: list[str] | None,
    default: tuple[float, ...],
    high: float,
    errors: list[str],
) -> tuple[float, ...]:
    """Return as many numbers, from 0 to a limit, as the default has; collect an error."""
    if words is None:
        return default
    try:
        numbers = tuple(float(word) for word in words)
    except ValueError:
        numbers = ()
    is_valid = all(math.isfinite(number) and 0.0 <= number <= high for number in numbers)
    if len(numbers) == len(default) and is_valid:
        return numbers
    text = " ".join(words)[:60]
    expected = "a number" if len(default) == 1 else f"{len(default)} numbers"
    errors.append(
        f"its material {name[:60]!r} has {entry} {text!r}; expected {expected} from 0 to {high:g}"
    )
    return default
