"""The textures of a surface and the switches of the shaders for them."""

from __future__ import annotations

from dataclasses import dataclass

from ...assets.mesh import Material, Texture

Switches = tuple[tuple[str, int], ...]
"""The preprocessor switches of a shader and their values."""


@dataclass(frozen=True, eq=False)
class Mask:
    """The holes of a surface."""

    texture: Texture
    """The texture whose alpha has the holes."""
    cutoff: int
    """The alpha below which the surface has a hole, 1..255 of 255."""


def find_mask(texture: Texture | None, material: Material | None) -> Mask | None:
    """Return the holes of a surface; None if it has none."""
    if texture is None or material is None or material.alpha_cutoff is None:
        return None
    return Mask(texture, max(1, min(255, round(255.0 * material.alpha_cutoff))))


def find_maps(material: Material | None) -> dict[str, Texture]:
    """Return the maps of a material besides the base colour, by their names in the shaders."""
    if material is None:
        return {}
    maps = {
        "normal_map": material.normal_map,
        "finish_map": material.finish_map,
        "emission_map": material.emission_map,
    }
    return {name: texture for name, texture in maps.items() if texture is not None}


def find_map_key(material: Material | None) -> object:
    """Return a key that is equal for materials that one draw call can draw."""
    if material is None:
        return None
    maps = {name: id(texture) for name, texture in find_maps(material).items()}
    return tuple(maps.items()), material.alpha_cutoff, any(material.emission)


def find_switches(
    texture: Texture | None, material: Material | None, *, has_colour: bool, is_physical: bool
) -> Switches:
    """Return the switches for a surface: those that the requested image needs.

    Args:
        texture: the texture of the base colour.
        material: the properties besides the base colour.
        has_colour: True if the image has colours.
        is_physical: True if they are those of physical water.
    """
    names = [] if texture is None else ["TEXTURED"]
    if material is None:
        return tuple((name, 1) for name in names)
    if has_colour and material.normal_map is not None:
        names.append("NORMAL_MAP")
    if has_colour and is_physical:
        names.append("MICROFACET")
        if material.finish_map is not None:
            names.append("FINISH_MAP")
        if any(material.emission):
            names.append("EMISSION")
            if material.emission_map is not None:
                names.append("EMISSION_MAP")
    switches: Switches = tuple((name, 1) for name in names)
    if (mask := find_mask(texture, material)) is not None:
        switches += (("ALPHA_TEST", mask.cutoff),)
    return switches


def find_used_maps(
    texture: Texture | None, material: Material | None, switches: Switches
) -> dict[str, Texture]:
    """Return the textures that a program with some switches reads, by their names in it."""
    names = {name for name, _ in switches}
    maps = {name: image for name, image in find_maps(material).items() if name.upper() in names}
    return maps if texture is None else {"base_map": texture, **maps}
