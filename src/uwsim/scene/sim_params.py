"""The specs of the simulation and its window: ``<simParams>``, ``<camera>``."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..base.geometry import ZERO, Triple
from ..schema import MAX_DISTANCE, Original, Spec, element

Integrator = Literal["implicitfast", "RK4"]
ContactMode = Literal["default", "precise"]
Solver = Literal["Dantzig", "SolveProjectedGauss", "SequentialImpulse"]
WINDOW_SIZE = Original(is_clamped=True, is_window_setting=True)


@dataclass(frozen=True, kw_only=True)
class ShowTrajectorySpec(Spec):
    """A ``<showTrajectory>``: the viewer draws where something went."""

    target: str
    """Route of the node to follow."""
    color: Triple = element(default=(1.0, 0.0, 0.0), parts="rgb")
    """Of the line [0..1]."""
    line_style: int = 1
    """1 solid, 2 to 4 dashed."""
    time_window: float = -1.0
    """How long points stay; not above 0: for ever [s]."""


@dataclass(frozen=True, kw_only=True)
class SimParamsSpec(Spec):
    """A ``<simParams>``: frames, window, physics, light."""

    disable_shaders: bool = element(default=False, original=Original(is_window_setting=True))
    """Whether water and sky are drawn without effects."""
    resw: int = element(default=800, minimum=1, maximum=7680, original=WINDOW_SIZE)
    """Width of the window [px]."""
    resh: int = element(default=600, minimum=1, maximum=4320, original=WINDOW_SIZE)
    """Height of the window [px]."""
    offsetp: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """Origin of the file's frame in the world [m]."""
    offsetr: Triple = ZERO
    """Turn of the file's frame in the world, about x, y, z: Rx Ry Rz [rad]."""
    enable_physics: bool = False
    """Whether contacts and gravity act on objects."""
    gravity: Triple = ZERO
    """In the world; all zero means (0, 0, -1) [m/s2]."""
    physics_frequency: float = element(
        default=60.0, above=0, original=Original(is_window_setting=True)
    )
    """Steps of the original's physics [Hz]."""
    physics_sub_steps: int = element(default=0, original=Original(is_window_setting=True))
    """Most steps per frame; 0 is automatic."""
    physics_solver: Solver = element(default="Dantzig", original=Original(is_window_setting=True))
    """Of the original's contacts; read and not used."""
    show_trajectory: tuple[ShowTrajectorySpec, ...] = element(
        default=(), original=Original(is_window_setting=True)
    )
    """Trails to draw in the viewer."""
    light_rate: float = element(default=1.0, minimum=0, maximum=1e6)
    """Factor on the light of the scene [1]."""
    sun_shadow: bool | None = element(namespaced=True, default=None)
    """Whether vehicles and objects cast the sun's shadow; when absent they do, but not in a scene
    of the original's, which had no shadows."""

    integrator: Integrator = element(namespaced=True, default="implicitfast")
    """How simulated vehicles step in time. ``implicitfast`` bears stiff servos, contacts and light
    things, its errors fall with the square of the step; ``RK4`` with the fourth power, for a
    vehicle alone: servos of arms and contacts need steps so short that it is of no use there."""

    contacts: ContactMode = element(namespaced=True, default="default")
    """How friction is solved where vehicles are simulated. ``default``: what is held creeps by
    some millimetres in 10 s; ``precise``: by a tenth of that or less, with steps that take
    half as long again."""

    @property
    def original_gravity(self) -> Triple:
        """What things fall with by the original's physics, in the world [m/s2]."""
        return self.gravity if any(self.gravity) else (0.0, 0.0, -1.0)


@dataclass(frozen=True, kw_only=True)
class ViewerCameraSpec(Spec):
    """A ``<camera>``: the viewer's, in the world (z up)."""

    free_motion: bool = element(default=True, original=Original(invalid_flag_value=True))
    """1: the mouse moves it; 0: it follows ``objectToTrack``."""
    object_to_track: str = ""
    """Route of the node to follow."""
    fov: float = element(default=60.0, above=0, below=180)
    """Vertical field of view [deg]."""
    aspect_ratio: float = element(default=1.33, above=0)
    """Width over height [1]."""
    near: float = -1.0
    """Near plane; automatic unless both planes are given [m]."""
    far: float = -1.0
    """Far plane; automatic unless both planes are given [m]."""
    position: Triple = element(
        default=(-5.0, -5.0, 8.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """Position of the viewer in the world [m]."""
    look_at: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """Where it looks, in the world [m]."""
