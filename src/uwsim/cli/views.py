"""The images of ``uwsim render``: from a camera of the scene, or from elsewhere."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from ..base.files.image_record import ImageRecord
from ..errors import BadSetting, did_you_mean

if TYPE_CHECKING:
    from ..base.geometry import Array
    from ..rendering.renderer import RenderedImage
    from ..scene.spec import SceneSpec
    from ..simulation import Simulation
    from ..simulation.views import View

ViewName = Literal["orbit", "top", "viewer"]
VIEW_NAMES: tuple[ViewName, ...] = ("orbit", "top", "viewer")
MAX_SIDE = 16384
"""The greatest width or height of an image [px]."""
FOG_PREFIX = "oceanState.fog"
"""The prefix of the settings of fog."""


@dataclass(frozen=True, eq=False)
class RenderedView:
    """A rendered image, and a function that draws it without noise."""

    title: str
    """The description for the user."""
    pixels: npt.NDArray[np.uint8] | npt.NDArray[np.uint16]
    """The pixels, (h, w, 3) or (h, w)."""
    record: ImageRecord
    """The record of the image, in its file."""
    render_clean: Callable[[], RenderedImage]
    """A function that draws the image without noise, with depth and segmentation IDs."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ViewRequest:
    """The camera or view that the options choose; without such options, the scene's default."""

    camera: str | None = None
    """The name of a virtual camera."""
    view: ViewName | None = None
    """The named view."""
    sight_line: tuple[Array, Array] | None = None
    """The viewpoint and the target, in L, (3,) each [m]."""
    size: tuple[int, int] | None = None
    """The width and height [px]."""
    samples: int = 2
    """The number of samples of a pixel in width and in height, for smooth edges."""
    has_fog: bool = False
    """True if fog is set, so views show it."""

    @staticmethod
    def from_options(
        camera: str | None,
        view: str | None,
        viewpoint: str | None,
        target: str | None,
        size: str | None,
        settings: Sequence[str],
    ) -> ViewRequest:
        """Read the options; raise BadSetting for invalid ones."""
        values = {"--camera": camera, "--view": view, "--from": viewpoint or target}
        chosen_options = [option for option, value in values.items() if value is not None]
        if len(chosen_options) > 1:
            raise BadSetting(f"{' and '.join(chosen_options)}: only one image at a time.")
        if (viewpoint is None) != (target is None):
            raise BadSetting("--from needs --at, and --at needs --from: viewpoint and target.")
        return ViewRequest(
            camera=camera,
            view=None if view is None else _read_view_name(view),
            sight_line=None
            if viewpoint is None or target is None
            else (_read_point("--from", viewpoint), _read_point("--at", target)),
            size=None if size is None else read_size(size),
            has_fog=any(setting.strip().startswith(FOG_PREFIX) for setting in settings),
        )

    def render(self, simulation: Simulation, scene: SceneSpec) -> RenderedView:
        """Draw the image; raise UnknownName for a camera, BadSetting for an impossible view."""
        from ..scene.sizes import find_size_error
        from ..simulation import views

        is_view = self.sight_line is not None or self.view is not None
        cameras = simulation.world.sensors.cameras if self.camera is None else (self.camera,)
        if len(cameras) > 1 and not is_view:
            raise BadSetting(
                f"The scene has {len(cameras)} virtual cameras; choose one with --camera: "
                f"{', '.join(cameras)}; or a --view: {', '.join(VIEW_NAMES)}."
            )
        water = scene.ocean_state.water
        if self.size is not None and (error := find_size_error(*self.size, water)):
            raise BadSetting(f"--size: {error}.")
        if cameras and not is_view:
            return self._render_camera(simulation, cameras[0])
        params = scene.sim_params
        size = self.size or (params.resw, params.resh)
        if self.sight_line is not None:
            view, title = views.view_from(simulation, *self.sight_line, size), "view from there"
        elif self.view == "top":
            view, title = views.top_view(simulation, size), "view from above"
        elif self.view == "viewer" and scene.camera is None:
            raise BadSetting("--view viewer: the scene has no <camera>; orbit and top need none.")
        elif self.view != "orbit" and scene.camera is not None:
            view, title = views.viewer_view(simulation, scene.camera, size), "view of its <camera>"
        else:
            view, title = views.orbit_view(simulation, size), "orbit view"
        return self._render_view(simulation, view, title)

    def _render_view(self, simulation: Simulation, view: View, title: str) -> RenderedView:
        from ..simulation.scenery.image_origin import describe_image

        fog = 0.0 if view.is_clear and not self.has_fog else None

        def draw(samples: int = 1) -> RenderedImage:
            return simulation.world.scenery.render_view(
                view.world_from_camera, view.intrinsics, fog=fog, samples=samples
            )

        pixels = draw(self.samples).colour
        assert pixels is not None
        record = describe_image(simulation, title, fog)
        return RenderedView(title, pixels.view(np.uint8), record, draw)

    def _render_camera(self, simulation: Simulation, name: str) -> RenderedView:
        from ..simulation.scenery.image_origin import describe_image

        camera = simulation.world.sensors.camera(name)
        if self.size is not None:
            camera.resize(camera.intrinsics.with_size(*self.size))
        pixels = camera.capture()
        record = describe_image(simulation, name, is_linear=pixels.dtype == np.uint16)
        return RenderedView(
            f"camera {name!r}",
            pixels,
            record,
            lambda: simulation.world.scenery.render_clean(
                camera.world_from_camera, camera.intrinsics, is_polished=camera.is_polished
            ),
        )


def _read_view_name(view: str) -> ViewName:
    for name in VIEW_NAMES:
        if name == view:
            return name
    suggestion = did_you_mean(view, VIEW_NAMES)
    raise BadSetting(f"--view is {view!r}; expected one of {', '.join(VIEW_NAMES)}.{suggestion}")


def _read_point(option: str, text: str) -> Array:
    words = text.replace(",", " ").split()
    try:
        numbers = np.array([float(word) for word in words])
    except ValueError:
        numbers = np.zeros(0)
    if len(numbers) != 3 or not np.isfinite(numbers).all() or np.abs(numbers).max() > 1e6:
        raise BadSetting(f"{option} is {text!r}; expected three numbers [m], as in 1,-2,3.5.")
    return numbers


def read_size(text: str) -> tuple[int, int]:
    """Return width and height [px] from a text such as ``800x600``; raise BadSetting."""
    from ..scene.sizes import MAX_PIXELS

    match = re.fullmatch(r"(\d{1,6})[xX](\d{1,6})", text.strip())
    edges = (int(match[1]), int(match[2])) if match else (0, 0)
    if not all(1 <= edge <= MAX_SIDE for edge in edges):
        raise BadSetting(
            f"--size is {text!r}; expected WxH [px] such as 800x600, {MAX_SIDE} at most."
        )
    if edges[0] * edges[1] > MAX_PIXELS:
        raise BadSetting(
            f"--size is {text!r}: {edges[0] * edges[1] / 1e6:.0f} million pixels; at most "
            f"{MAX_PIXELS / 1e6:.0f} million are rendered, as in 7680x4320."
        )
    return edges
