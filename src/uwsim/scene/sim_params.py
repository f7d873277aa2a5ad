"""The specs of ``<simParams>``, the simulation parameters, and of the viewer's ``<camera>``."""

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
    """A ``<showTrajectory>``: the viewer draws the path of a body."""

    target: str
    """The route of the body, such as ``girona500/base_link``."""
    color: Triple = element(default=(1.0, 0.0, 0.0), parts="rgb")
    """The colour of the line [0..1]."""
    line_style: int = 1
    """The line style: 1 solid, 2 to 4 dashed."""
    time_window: float = -1.0
    """The time for which points are shown; 0 or less: without end [s]."""


@dataclass(frozen=True, kw_only=True)
class SimParamsSpec(Spec):
    """A ``<simParams>``: the frame of the file, the window, physics and light."""

    disable_shaders: bool = element(default=False, original=Original(is_window_setting=True))
    """True if water and sky are drawn without effects."""
    resw: int = element(default=800, minimum=1, maximum=7680, original=WINDOW_SIZE)
    """The width of the window [px]."""
    resh: int = element(default=600, minimum=1, maximum=4320, original=WINDOW_SIZE)
    """The height of the window [px]."""
    offsetp: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The origin of the file's frame L in the world frame W [m]."""
    offsetr: Triple = ZERO
    """The rotation of the file's frame L in the world frame W, about x, y, z: Rx Ry Rz [rad]."""
    enable_physics: bool = False
    """True if gravity and contacts move objects, as in the original UWSim, in a scene without
    ``u:dynamics``."""
    gravity: Triple = ZERO
    """The gravity of ``enablePhysics``, in W; all zero means (0, 0, -1) [m/s2]."""
    physics_frequency: float = element(
        default=60.0, exclusive_minimum=0, original=Original(is_window_setting=True)
    )
    """The rate of the steps of ``enablePhysics`` [Hz]."""
    physics_sub_steps: int = element(default=0, original=Original(is_window_setting=True))
    """The greatest number of physics steps per displayed frame; 0 is automatic."""
    physics_solver: Solver = element(default="Dantzig", original=Original(is_window_setting=True))
    """The contact solver of the original UWSim; read but not used."""
    show_trajectory: tuple[ShowTrajectorySpec, ...] = element(
        default=(), original=Original(is_window_setting=True)
    )
    """The trajectories that the viewer draws."""
    light_rate: float = element(default=1.0, minimum=0, maximum=1e6)
    """The factor on the light of the scene [1]."""
    sun_shadow: bool | None = element(namespaced=True, default=None)
    """True if vehicles and objects cast shadows of the sun. Without this element they do, except in
    a scene of the original UWSim, which had no shadows."""

    integrator: Integrator = element(namespaced=True, default="implicitfast")
    """The time integrator of vehicles with dynamics. ``implicitfast`` is stable with stiff servos,
    contacts and light bodies, and its errors fall with the square of the step. The errors of
    ``RK4`` fall with the fourth power for a vehicle without arms and contacts; servos and contacts
    would need very short steps."""

    contacts: ContactMode = element(namespaced=True, default="default")
    """The friction solver of scenes with vehicles that have dynamics. ``default``: an object in a
    gripper slips by some millimetres in 10 s. ``precise``: it slips by a tenth of that or less, and
    steps take 1.5 times as long."""

    @property
    def original_gravity(self) -> Triple:
        """The gravity of ``enablePhysics`` in W [m/s2]."""
        return self.gravity if any(self.gravity) else (0.0, 0.0, -1.0)


@dataclass(frozen=True, kw_only=True)
class ViewerCameraSpec(Spec):
    """A ``<camera>``: the camera of the viewer, in the world frame W (z up)."""

    free_motion: bool = element(default=True, original=Original(invalid_flag_value=True))
    """1: the mouse moves the camera; 0: the camera follows ``objectToTrack``."""
    object_to_track: str = ""
    """The route of the body that the camera follows."""
    fov: float = element(default=60.0, exclusive_minimum=0, exclusive_maximum=180)
    """The vertical field of view [deg]."""
    aspect_ratio: float = element(default=1.33, exclusive_minimum=0)
    """The ratio of width to height [1]."""
    near: float = -1.0
    """The near plane; automatic unless both planes are given [m]."""
    far: float = -1.0
    """The far plane; automatic unless both planes are given [m]."""
    position: Triple = element(
        default=(-5.0, -5.0, 8.0), minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE
    )
    """The position of the camera in W [m]."""
    look_at: Triple = element(default=ZERO, minimum=-MAX_DISTANCE, maximum=MAX_DISTANCE)
    """The point in W at which the camera looks [m]."""
