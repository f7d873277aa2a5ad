r"""The waves near the camera on square grids, from fine to coarse.

Each grid has the elevation, the slopes along x and y, and the downward acceleration over that of
gravity, of the components :math:`a \cos(k \cdot x - \omega t + \varphi)` whose wave length is at
least four of its spacings. The variance of the slopes of shorter ones is the roughness of the
surface at that distance. The grids are fixed in the world while they follow the camera: their
points are multiples of the spacing. A component on a grid is a product of a function of x and one
of y, so a grid of n points takes a few operations per point and component.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import moderngl
import numpy as np
import numpy.typing as npt

from ...base.geometry import Array
from ...base.numerics.jit import njit
from ...waves import Waves
from ..physical.moving_surface import MovingSurface

N_POINTS = 128
"""The number of points along an edge of a grid."""
SPACINGS = (0.2, 0.8, 3.2, 12.8)
"""The spacing of each grid of a camera that sees far [m]."""
N_NEAR_POINTS = 192
"""The number of points along an edge of the grid of a camera under water."""
NEAR_SPACINGS = (0.2, 0.4, 0.8, 1.6)
"""The spacings from which the grid of a camera under water has the first that is enough [m]."""
POINTS_PER_WAVE = 4.0
"""The least number of points in a wave length."""
MAX_DEVIATIONS = 6.0
"""The greatest elevation of a sea, in standard deviations."""
FOAM_THRESHOLD = 0.22
"""The least downward acceleration of crests over gravity at which a pixel may have foam [1]."""
FOAM_DEVIATIONS = 4.5
"""The greatest acceleration of a sea in practice, in standard deviations."""
GRAVITY = 9.81
"""The acceleration of gravity [m/s2]."""

Grid = npt.NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class Components:
    """The components of waves in W."""

    amplitude: Array
    """The amplitudes, (n,) [m]."""
    omega: Array
    """The angular frequencies, (n,) [rad/s]."""
    kx: Array
    """The wave numbers along x, (n,) [rad/m]."""
    ky: Array
    """The wave numbers along y, (n,) [rad/m]."""
    phase: Array
    """The phases at the origin of W at time 0, (n,) [rad]."""

    @property
    def number(self) -> Array:
        """The wave numbers, (n,) [rad/m]."""
        number: Array = np.sqrt(self.kx * self.kx + self.ky * self.ky)
        return number

    def select(self, is_selected: npt.NDArray[np.bool_]) -> Components:
        """Return some of the components."""
        return Components(
            *(
                np.ascontiguousarray(column[is_selected])
                for column in (self.amplitude, self.omega, self.kx, self.ky, self.phase)
            )
        )

    def compute_slope_variance(self) -> float:
        """Compute the variance of the slope along one axis, on average over the axes [1]."""
        return float(0.25 * math.fsum(((self.amplitude * self.number) ** 2).tolist()))


@dataclass(frozen=True, eq=False, kw_only=True)
class GridFrame:
    """The place of a grid in the world."""

    origin: Array
    """The position of the first point in W, (2,) [m]."""
    spacing: float
    """The spacing of the points [m]."""
    n_points: int
    """The number of points along an edge."""
    roughness: float
    """The variance of the slopes along one axis of components that the grid leaves out [1]."""


class WaveGrids:
    """The grids of a scene's waves as textures.

    Args:
        context: the context of the renderer.
    """

    def __init__(self, context: moderngl.Context) -> None:
        self.texture: moderngl.TextureArray = context.texture_array(
            (N_POINTS, N_POINTS, len(SPACINGS)), 4, dtype="f4"
        )
        """The grids from fine to coarse: elevation [m], slopes [1], downward acceleration over
        gravity [1]."""
        self.near_texture: moderngl.Texture = context.texture(
            (N_NEAR_POINTS, N_NEAR_POINTS), 4, dtype="f4"
        )
        """The single grid of a camera under water."""
        for texture in (self.texture, self.near_texture):
            texture.filter = (moderngl.LINEAR, moderngl.LINEAR)
            texture.repeat_x = texture.repeat_y = False
        self.frames: list[GridFrame] = []
        """The places of the grids in use."""
        self.max_elevation = 0.0
        """The elevation that waves do not exceed, or once in 1e9 points [m]."""
        self.slope_variance = 0.0
        """The variance of the slopes of all components along one axis [1]."""
        self.has_foam = False
        """True if crests are steep enough for foam somewhere."""
        self._components: Components | None = None
        self._levels: dict[float, tuple[Components, float]] = {}
        self._waves: tuple[Waves | None, float] = None, 0.0
        self._keys: dict[object, object] = {}

    def set_surface(self, surface: MovingSurface | None) -> None:
        """Take the components of a surface; None: it is level."""
        waves = None if surface is None else surface.waves
        scale = 1.0 if surface is None else surface.wave_scale
        if self._waves != (waves, scale):
            self._set_waves(waves, scale)

    def update(self, time: float, centre: Array) -> None:
        """Compute and upload the grids, fine to coarse, unless they are those of the last image.

        Args:
            time: the simulation time [s].
            centre: the position of the camera in W, (2,) or longer [m].
        """
        self.frames = []
        for level, spacing in enumerate(SPACINGS):
            frame, grid = self._compute(level, time, centre, spacing, N_POINTS)
            self.frames.append(frame)
            if grid is not None:
                viewport = 0, 0, level, N_POINTS, N_POINTS, 1
                self.texture.write(grid.tobytes(), viewport=viewport)

    def update_near(self, time: float, centre: Array, max_radius: float) -> None:
        """Compute and upload the single grid, unless it is that of the last image.

        Args:
            time: the simulation time [s].
            centre: the position of the camera in W, (2,) or longer [m].
            max_radius: the greatest horizontal distance at which the surface is visible [m].
        """
        min_spacing = max_radius / (0.5 * N_NEAR_POINTS - 2.0)
        spacing = next((s for s in NEAR_SPACINGS if s >= min_spacing), NEAR_SPACINGS[-1])
        frame, grid = self._compute("near", time, centre, spacing, N_NEAR_POINTS)
        self.frames = [frame]
        if grid is not None:
            self.near_texture.write(grid.tobytes())

    def _compute(
        self, name: object, time: float, centre: Array, spacing: float, n_points: int
    ) -> tuple[GridFrame, Grid | None]:
        """Return the place of a grid, and its values unless they are in its texture."""
        first = np.floor(centre[:2] / spacing + 0.5) - n_points // 2
        c, roughness = self._select(spacing)
        frame = GridFrame(
            origin=first * spacing, spacing=spacing, n_points=n_points, roughness=roughness
        )
        key = time, spacing, *first.tolist()
        if self._keys.get(name) == key:
            return frame, None
        self._keys[name] = key
        columns = (c.amplitude, c.omega, c.kx, c.ky, c.phase)
        origin = float(frame.origin[0]), float(frame.origin[1])
        return frame, compute_grid(columns, origin, spacing, time, n_points)

    def _select(self, spacing: float) -> tuple[Components, float]:
        """Return the components that a grid resolves, and the variance of the others' slopes."""
        if spacing not in self._levels:
            components = self._components
            assert components is not None
            is_resolved = components.number * (POINTS_PER_WAVE * spacing) <= 2.0 * math.pi
            self._levels[spacing] = (
                components.select(is_resolved),
                components.select(~is_resolved).compute_slope_variance(),
            )
        return self._levels[spacing]

    def _set_waves(self, waves: Waves | None, scale: float) -> None:
        self._waves = waves, scale
        self._keys, self._levels, self.frames = {}, {}, []
        if waves is None:
            self._components = None
            self.max_elevation = self.slope_variance = 0.0
            self.has_foam = False
            return
        self._components = components = read_components(waves, scale)
        deviation = math.sqrt(0.5 * math.fsum((components.amplitude**2).tolist()))
        self.max_elevation = min(float(components.amplitude.sum()), MAX_DEVIATIONS * deviation)
        self.slope_variance = components.compute_slope_variance()
        fall = components.amplitude * components.omega**2 / GRAVITY
        deviation = math.sqrt(0.5 * math.fsum((fall * fall).tolist()))
        self.has_foam = min(float(fall.sum()), FOAM_DEVIATIONS * deviation) > FOAM_THRESHOLD


def read_components(waves: Waves, scale: float) -> Components:
    """Return the components of waves in W, with their amplitudes at a factor."""
    amplitude, omega, phase, kx, ky = waves.components
    return Components(amplitude * scale, omega, kx, ky, phase)


@njit
def compute_grid(
    columns: tuple[Array, Array, Array, Array, Array],
    origin: tuple[float, float],
    spacing: float,
    time: float,
    n_points: int,
) -> Grid:
    """Compute the elevation, the slopes and the acceleration over gravity on a grid.

    Args:
        columns: the columns of `Components`.
        origin: the position of the first point in W [m].
        spacing: the spacing of the points [m].
        time: the simulation time [s].
        n_points: the number of points along an edge.

    Returns:
        The values, (points along y, points along x, 4).
    """
    amplitude, omega, kx, ky, phase = columns
    n = len(amplitude)
    cosine_x, sine_x = np.empty((n, n_points), np.float32), np.empty((n, n_points), np.float32)
    for i in range(n):
        angle = kx[i] * origin[0] + ky[i] * origin[1] - omega[i] * time + phase[i]
        c, s = math.cos(angle), math.sin(angle)
        step_c, step_s = math.cos(kx[i] * spacing), math.sin(kx[i] * spacing)
        for column in range(n_points):
            cosine_x[i, column], sine_x[i, column] = c, s
            c, s = c * step_c - s * step_s, s * step_c + c * step_s
    grid = np.empty((n_points, n_points, 4), np.float32)
    rows = np.empty((4, n_points), np.float32)
    turn_c, turn_s = np.ones(n), np.zeros(n)
    row_c, row_s = np.empty(n), np.empty(n)
    for i in range(n):
        row_c[i], row_s[i] = math.cos(ky[i] * spacing), math.sin(ky[i] * spacing)
    for row in range(n_points):
        rows[:] = np.float32(0.0)
        for i in range(n):
            a = np.float32(amplitude[i] * turn_c[i])
            b = np.float32(amplitude[i] * turn_s[i])
            slope_x, slope_y = np.float32(kx[i]), np.float32(ky[i])
            curvature = np.float32(omega[i] * omega[i] / GRAVITY)
            _add_component(rows, cosine_x[i], sine_x[i], (a, b, slope_x, slope_y, curvature))
            c, s = row_c[i], row_s[i]
            turn_c[i], turn_s[i] = turn_c[i] * c - turn_s[i] * s, turn_s[i] * c + turn_c[i] * s
        for column in range(n_points):
            for k in range(4):
                grid[row, column, k] = rows[k, column]
    return grid


@njit
def _add_component(
    rows: Grid,
    cosine_x: Grid,
    sine_x: Grid,
    numbers: tuple[np.float32, np.float32, np.float32, np.float32, np.float32],
) -> None:
    a, b, slope_x, slope_y, curvature = numbers
    elevation, along_x, along_y, fall = rows[0], rows[1], rows[2], rows[3]
    for column in range(len(elevation)):
        height = a * cosine_x[column] - b * sine_x[column]
        steepness = a * sine_x[column] + b * cosine_x[column]
        elevation[column] += height
        along_x[column] -= slope_x * steepness
        along_y[column] -= slope_y * steepness
        fall[column] += curvature * height
