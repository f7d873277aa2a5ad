"""The inputs of an image, through physical water or by the fog law."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ...base.geometry import Intrinsics
from ..lights.lamp import Lamp
from ..lights.projector import Projector
from ..materials.maps import Switches
from ..water import Light, Water
from .moving_surface import MovingSurface
from .visible_particles import VisibleParticles


@dataclass(frozen=True, kw_only=True)
class ViewContents:
    """The contents of an image besides bodies, water and daylight."""

    lamps: Sequence[Lamp] = ()
    """The lamps, at most four."""
    projector: Projector | None = None
    """The projector of a pattern, if there is one."""
    surface: MovingSurface | None = None
    """The moving surface of physical water, if there is one."""
    particles: VisibleParticles | None = None
    """The particles in view, which only physical water shows."""


NO_CONTENTS = ViewContents()
"""A view of bodies and level water in daylight."""


@dataclass(frozen=True, kw_only=True)
class View:
    """All inputs of an image: equal views give equal images."""

    pose: bytes
    """The bytes of the matrix ``world_from_camera``."""
    intrinsics: Intrinsics
    """The pinhole of the camera."""
    water: Water
    """The water between surfaces and camera."""
    light: Light
    """The light of the scene."""
    targets: frozenset[str]
    """The requested targets."""
    hidden_ids: frozenset[int]
    """The ids of instances that are not drawn."""
    colour_format: str
    """The format of colours (`targets.COLOUR_FORMATS`)."""
    version: int
    """The version of the instances and their poses."""
    lamps: tuple[Lamp, ...]
    """The lamps."""
    projector: Projector | None
    """The projector of a pattern, if there is one."""
    surface: MovingSurface | None = None
    """The moving surface, if images depend on it."""
    particles: VisibleParticles | None = None
    """The particles in physical water, if there are any."""
    switches: Switches = ()
    """The switches of the shaders of surfaces for focused sunlight."""

    @property
    def is_physical(self) -> bool:
        """True if the image has colours through physical water."""
        return self.water.physical_water is not None and "colour" in self.targets

    @property
    def margin(self) -> tuple[int, int]:
        """The columns and rows that are drawn beyond each edge of the image [px]."""
        water, lens = self.water.physical_water, self.intrinsics
        if water is None or not water.has_blur:
            return 0, 0
        return round(water.blur_margin * lens.width), round(water.blur_margin * lens.height)

    @property
    def has_surface(self) -> bool:
        """True if the water's surface is drawn."""
        water = self.water.physical_water
        return water is not None and self.is_physical and water.has_surface
