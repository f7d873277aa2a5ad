r"""The water between a surface and the camera: attenuation, in-scattering, fog.

For a point whose lit colour without water is :math:`L_c`, at range :math:`r` along the ray and at
depth :math:`h`, in each channel and on stored values (no gamma):

.. math::
    E_c = e^{-2 a_c r}, \quad
    C_c = L_c E_c + w_c (1 - E_c e^{-0.001 h}), \quad
    t = e^{-(f s)^2}, \quad
    F_c = t C_c + (1 - t) g_c

with attenuation :math:`a`, water colour :math:`w`, fog density :math:`f` and fog colour :math:`g`
(the image model of UWSim, the C++ simulator whose scene files this program reads). Water and fog
scatter the light of the scene: :math:`w` and :math:`g` are the colours in the scene file times the
light rate (`Water.scale_by_light`). The distance :math:`s` in the fog is the range, as in UWSim's
paper. Not modelled: the path of the light from the water's surface down, absorption apart from
scattering, light of lamps that is scattered into the camera, caustics.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
import numpy.typing as npt

from ..base.geometry import Intrinsics, Triple
from ..base.numerics.elementwise import exp
from ..base.numerics.linear import length
from ..scene.ocean_state import OceanStateSpec
from .physical.daylight_field import compute_light_field
from .physical.physical_water import PhysicalWater

Colour = tuple[float, float, float]
"""The values of red, green and blue, 0..1; or a coefficient for each of these channels."""
Sun = Literal["clear", "dusk", "cloudy"]
"""A state of the sky, which determines the direction and the colour of the sun."""

SUN_DIRECTIONS: dict[Sun, Triple] = {
    "clear": (326.573, 1212.99, 1275.19),
    "dusk": (520.0, 1900.0, 550.0),
    "cloudy": (-1056.89, -771.886, 1221.18),
}
"""The vectors in W towards the sun, not normalised."""

_UNIT_DIRECTIONS: dict[Sun, npt.NDArray[np.float64]] = {
    sun: np.array(direction) / length(direction) for sun, direction in SUN_DIRECTIONS.items()
}

SUN_COLOURS: dict[Sun, Colour] = {
    "clear": (191 / 255, 191 / 255, 191 / 255),
    "dusk": (251 / 255, 251 / 255, 161 / 255),
    "cloudy": (191 / 255, 191 / 255, 191 / 255),
}
"""The colours of the sun's light, 0..1."""

AMBIENT_SHARE = 0.3
"""The brightness of ambient light, as a fraction of a surface's colour [1]."""

SPECULAR_BRIGHTNESS = 0.1
"""The brightness of the sun's specular reflection, added to all channels [1]."""


@dataclass(frozen=True, kw_only=True)
class Water:
    """The water between surfaces and cameras; the defaults are UWSim's."""

    fog: float = 0.1
    """The density of the fog [1/m]."""
    fog_colour: Colour = (0.0, 0.05, 0.3)
    """The colour of thick fog, 0..1."""
    colour: Colour = (0.0, 0.05, 0.3)
    """The colour of the light that the water scatters into a long ray, 0..1."""
    attenuation: Colour = (0.015, 0.0075, 0.005)
    """The attenuation of red, green and blue [1/m]."""
    surface_height: float = 0.0
    """The height z of the water's surface in W [m]."""
    fog_distance: Literal["ray", "clip"] = "ray"
    """The distance in the fog law: along the ray, or clip-space z as in UWSim (C++)."""
    follows_light: bool = True
    """True if the light rate scales the colours of water and fog; UWSim does not scale them."""
    has_air: bool = False
    """True if only the part of a ray below the water's surface is in water; in UWSim the whole ray
    is."""
    physical_water: PhysicalWater | None = None
    """The physical image model, which replaces attenuation, scattering and fog; None: they hold."""

    @classmethod
    def from_ocean_state(
        cls, ocean: OceanStateSpec, compatibility: frozenset[str] = frozenset()
    ) -> Water:
        """Return the water of a scene file's ocean state."""
        return cls(
            fog=ocean.fog.density,
            fog_colour=ocean.fog.color,
            colour=ocean.color,
            attenuation=ocean.attenuation,
            surface_height=ocean.ocean_surface_height,
            fog_distance="clip" if "fog-distance" in compatibility else "ray",
            follows_light="fog-light" not in compatibility,
        )

    def scale_by_light(self, light: Light) -> Water:
        """Return the water with its colours scaled by the light rate."""
        if not self.follows_light or light.rate == 1.0:
            return self
        fog_colour, colour = (
            (light.rate * red, light.rate * green, light.rate * blue)
            for red, green, blue in (self.fog_colour, self.colour)
        )
        return replace(self, fog_colour=fog_colour, colour=colour)

    @property
    def switches(self) -> tuple[tuple[str, int], ...]:
        """The preprocessor switches of the shaders for this water, with their values."""
        if self.physical_water is not None:
            if self.physical_water.has_surface:
                return (("PHYSICAL", 1), ("SKY", 1))
            return (("PHYSICAL", 1), ("AIR", 1)) if self.has_air else (("PHYSICAL", 1),)
        is_set = {
            "NO_FOG": self.fog == 0.0,
            "FOG_CLIP": self.fog > 0.0 and self.fog_distance == "clip",
            "AIR": self.has_air,
        }
        return tuple((name, 1) for name, value in is_set.items() if value)

    @property
    def far_colour(self) -> Colour:
        """The colour of pixels without a surface: water or fog at infinite distance."""
        return self.fog_colour if self.fog > 0.0 else self.colour


@dataclass(frozen=True, kw_only=True)
class Light:
    """The light of the scene: the sun."""

    rate: float = 1.0
    """The light rate: the brightness of all light, 1 is nominal [1]."""
    sun: Sun = "clear"
    """The state of the sky, which determines the direction and the colour of the sun."""
    shadows: bool = True
    """True if vehicles and objects cast shadows of the sun."""
    is_polished: bool = False
    """True if images are for presentation: surfaces are glossy, shadows are soft and have the
    water's hue."""

    @property
    def switches(self) -> tuple[tuple[str, int], ...]:
        """The preprocessor switches of the shaders for this light, with their values."""
        return (("POLISHED", 1), ("SOFT", 1)) if self.is_polished else ()


def find_sun_direction(water: Water, light: Light) -> npt.NDArray[np.float64]:
    """Return the unit vector towards the sun in W, (3,); under physical water the refracted one."""
    if water.physical_water is not None:
        optics = water.physical_water
        return compute_light_field(optics.medium, optics.daylight).towards_sun.copy()
    return sun_direction(light.sun)


def sun_direction(sun: Sun) -> npt.NDArray[np.float64]:
    """Return the unit vector towards the sun in W, (3,)."""
    return _UNIT_DIRECTIONS[sun].copy()


def clip_distance(
    depth: npt.NDArray[np.float64], intrinsics: Intrinsics
) -> npt.NDArray[np.float64]:
    """Compute the distance in UWSim's fog: clip-space z of planar depths, any shape [m].

    ``((far + near) d - 2 far near) / (far - near)``, which is about ``d - 2 near``.
    """
    near, far = intrinsics.near, intrinsics.far
    return ((far + near) * depth - 2.0 * far * near) / (far - near)


def submerged_path_share(
    world_z: npt.NDArray[np.float64], eye_z: float, water: Water
) -> npt.NDArray[np.float64]:
    """Compute the fraction of the path from the camera to points that is under water, 0..1.

    The result has the shape of ``world_z``.

    Args:
        world_z: the z coordinates of the points in W [m].
        eye_z: the z coordinate of the camera in W [m].
        water: the water; its surface is flat and does not refract light.
    """
    depth, eye_depth = water.surface_height - world_z, water.surface_height - eye_z
    max_depth, min_depth = np.maximum(depth, eye_depth), np.minimum(depth, eye_depth)
    share: npt.NDArray[np.float64] = max_depth / np.maximum(max_depth - min_depth, 1e-6)
    return share.clip(0.0, 1.0)


def apply_water(
    dry_colours: npt.NDArray[np.float64],
    range: npt.NDArray[np.float64],
    world_z: npt.NDArray[np.float64],
    water: Water,
    *,
    fog_range: npt.NDArray[np.float64] | None = None,
) -> npt.NDArray[np.float64]:
    """Apply the water's image model in numpy: the reference for the shader, and for recordings.

    Where a ray is partly in air, pass both distances times `submerged_path_share`.

    Args:
        dry_colours: the colours of the lit surfaces without water, (..., 3), 0..1.
        range: the distance along the ray, (...) [m]; inf gives the far colour.
        world_z: the z coordinates of the points in W, (...) [m].
        water: the water.
        fog_range: the distance in the fog, (...) [m], if it is not the range (`clip_distance`).

    Returns:
        The colours at the camera, (..., 3).
    """
    is_empty = np.isinf(range)
    distance = np.where(is_empty, 0.0, range)[..., None]
    s = distance if fog_range is None else np.where(is_empty, 0.0, fog_range)[..., None]
    depth = np.maximum(water.surface_height - np.where(is_empty, 0.0, world_z), 0.0)[..., None]
    transmission = exp(-2.0 * np.asarray(water.attenuation) * distance)
    direct_colours = dry_colours * transmission + np.asarray(water.colour) * (
        1.0 - transmission * exp(-0.001 * depth)
    )
    fog_transmission = exp(-((water.fog * s) ** 2))
    fogged_colours = fog_transmission * direct_colours + (1.0 - fog_transmission) * np.asarray(
        water.fog_colour
    )
    colours: npt.NDArray[np.float64] = np.where(
        is_empty[..., None], np.asarray(water.far_colour), fogged_colours
    )
    return colours
