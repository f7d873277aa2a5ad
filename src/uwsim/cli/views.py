"""The views of ``uwsim render``: a camera of the scene, or a free view."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from ..errors import BadSetting, did_you_mean

if TYPE_CHECKING:
    from ..base.geometry import Array
    from ..rendering.renderer import RenderedImage
    from ..scene.spec import SceneSpec
    from ..simulation import Simulation
    from ..simulation.views import View

Named = Literal["orbit", "top", "viewer"]
NAMED: tuple[Named, ...] = ("orbit", "top", "viewer")
MAX_SIDE = 16384
"""Edge of an image [px]."""
FOG = "oceanState.fog"
"""Prefix of the ``--set`` that concern fog."""


@dataclass(frozen=True, eq=False)
class RenderedView:
    """What was drawn."""

    what: str
    """What it shows, for the user."""
    pixels: npt.NDArray[np.uint8]
    """(h, w, 3) or (h, w)."""
    render_clean: Callable[[], RenderedImage]
    """Draws it again without noise, with range and ids."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Wanted:
    """The camera or view given by the options; without them, the scene's default."""

    camera: str | None = None
    """Name of a virtual camera."""
    view: Named | None = None
    """Which view."""
    line: tuple[Array, Array] | None = None
    """From where to where, in L, (3,) each [m]."""
    size: tuple[int, int] | None = None
    """Width and height [px]."""
    samples: int = 2
    """Of a pixel of a view, in width and in height: smooth edges."""
    has_fog: bool = False
    """Whether fog is set, so that views show it."""

    @staticmethod
    def of(
        camera: str | None,
        view: str | None,
        eye: str | None,
        at: str | None,
        size: str | None,
        settings: Sequence[str],
    ) -> Wanted:
        """Read the options; raises BadSetting."""
        given = {"--camera": camera, "--view": view, "--from": eye or at}
        asked = [option for option, value in given.items() if value is not None]
        if len(asked) > 1:
            raise BadSetting(f"{' and '.join(asked)}: only one image at a time.")
        if (eye is None) != (at is None):
            raise BadSetting("--from and --at belong together: where to look from, and at what.")
        return Wanted(
            camera=camera,
            view=None if view is None else _named(view),
            line=None if eye is None or at is None else (_point("--from", eye), _point("--at", at)),
            size=None if size is None else size_of(size),
            has_fog=any(setting.strip().startswith(FOG) for setting in settings),
        )

    def render(self, simulation: Simulation, scene: SceneSpec) -> RenderedView:
        """Draw it; raises UnknownName for a camera, BadSetting for a view that cannot be."""
        from ..simulation import views

        is_view = self.line is not None or self.view is not None
        cameras = simulation.world.sensors.cameras if self.camera is None else (self.camera,)
        if len(cameras) > 1 and not is_view:
            raise BadSetting(
                f"The scene has {len(cameras)} virtual cameras; choose one with --camera: "
                f"{', '.join(cameras)}; or a --view: {', '.join(NAMED)}."
            )
        if cameras and not is_view:
            return self._seen(simulation, cameras[0])
        params = scene.sim_params
        size = self.size or (params.resw, params.resh)
        if self.line is not None:
            view, what = views.view_from(simulation, *self.line, size), "view from there"
        elif self.view == "top":
            view, what = views.top_view(simulation, size), "view from above"
        elif self.view == "viewer" and scene.camera is None:
            raise BadSetting("--view viewer: the scene has no <camera>; orbit and top need none.")
        elif self.view != "orbit" and scene.camera is not None:
            view, what = views.viewer_view(simulation, scene.camera, size), "view of its <camera>"
        else:
            view, what = views.orbit_view(simulation, size), "orbit view"
        return self._viewed(simulation, view, what)

    def _viewed(self, simulation: Simulation, view: View, what: str) -> RenderedView:
        fog = 0.0 if view.is_clear and not self.has_fog else None

        def draw(samples: int = 1) -> RenderedImage:
            return simulation.world.scenery.render_view(
                view.world_from_camera, view.intrinsics, fog=fog, samples=samples
            )

        pixels = draw(self.samples).colour
        assert pixels is not None
        return RenderedView(what, pixels.view(np.uint8), draw)

    def _seen(self, simulation: Simulation, name: str) -> RenderedView:
        camera = simulation.world.sensors.camera(name)
        if self.size is not None:
            camera.resize(camera.intrinsics.with_size(*self.size))
        return RenderedView(
            f"camera {name!r}",
            camera.capture(),
            lambda: simulation.world.scenery.render_clean(
                camera.world_from_camera, camera.intrinsics, is_polished=camera.is_polished
            ),
        )


def _named(view: str) -> Named:
    for name in NAMED:
        if name == view:
            return name
    near = did_you_mean(view, NAMED)
    raise BadSetting(f"--view is {view!r}; expected one of {', '.join(NAMED)}.{near}")


def _point(option: str, text: str) -> Array:
    words = text.replace(",", " ").split()
    try:
        numbers = np.array([float(word) for word in words])
    except ValueError:
        numbers = np.zeros(0)
    if len(numbers) != 3 or not np.isfinite(numbers).all() or np.abs(numbers).max() > 1e6:
        raise BadSetting(f"{option} is {text!r}; expected three numbers [m], as in 1,-2,3.5.")
    return numbers


def size_of(text: str) -> tuple[int, int]:
    """Return width and height [px] as they are typed: ``800x600``; raises BadSetting."""
    from ..scene.sizes import MAX_PIXELS

    match = re.fullmatch(r"(\d{1,6})[xX](\d{1,6})", text.strip())
    edges = (int(match[1]), int(match[2])) if match else (0, 0)
    if not all(1 <= edge <= MAX_SIDE for edge in edges):
        raise BadSetting(
            f"--size is {text!r}; expected WxH [px], as in 800x600, {MAX_SIDE} at most."
        )
    if edges[0] * edges[1] > MAX_PIXELS:
        raise BadSetting(
            f"--size is {text!r}: {edges[0] * edges[1] / 1e6:.0f} million pixels; at most "
            f"{MAX_PIXELS / 1e6:.0f} million are drawn, as in 7680x4320."
        )
    return edges
