"""The scene of a recorded trial, which can be set to its recorded state at any time."""

from __future__ import annotations

import math

import numpy as np

from ...base.geometry import Array
from ...devices.lamp import MountedLamp
from ...physics.compile_scene import compile_scene
from ...rendering.physical.moving_surface import MovingSurface
from ...results.motion import DrawnMarker, MotionTrack, markers_at
from ...simulation import Simulation
from ...simulation.scenery.recorded_water import restore_water
from ...simulation.tracked_bodies import TrackedBodies
from ...simulation.tracked_state import (
    BEAM_ATTENUATION,
    DRIFT_SIGNALS,
    EXPOSURE_LEVEL,
    LAMP_PREFIX,
    WAVE_SCALE,
)
from ..recorded import RecordedTrial
from .recorded_puffs import RecordedPuffs

VELOCITY_SIGNAL = "particle_velocity"
"""The name of the signals of the velocity of the water."""


class TrialScene:
    """The open scene of a trial, and the trial's recorded motion.

    Args:
        trial: the trial.
        simulation: an open simulation of the trial's scene, which the caller closes; None: this
            object opens one, and `close` closes it.
    """

    def __init__(self, trial: RecordedTrial, simulation: Simulation | None = None) -> None:
        self.simulation = simulation or open_scene(trial)
        """The simulation with the scene; it does not run."""
        self.track = trial.track
        """The recorded motion."""
        self._bodies = TrackedBodies(self.simulation.world)
        indices = {name: index for index, name in enumerate(self.track.bodies)}
        self._track_indices = [indices.get(name) for name in self._bodies.names]
        self._initial_rows = self._bodies.rows()
        self._owns_simulation = simulation is None
        self._time = 0.0  # that the scene shows [s]
        particles, self._puffs = self.simulation.world.scenery.particles, None
        if particles is not None and particles.sediment is not None:
            self._puffs = RecordedPuffs(
                particles.sediment, self.track.sediment, self._find_water_velocity
            )

    def show_time(self, time: float) -> None:
        """Set the scene to its state at a simulation time [s]; poses are interpolated."""
        self._time = time
        self._set_clocks()
        frame, fraction = frame_at(self.track, time)
        next_frame = min(frame + 1, self.track.n_frames - 1)
        poses = interpolate_poses(self.track.poses[frame], self.track.poses[next_frame], fraction)
        rows = self._initial_rows.copy()
        for row, index in enumerate(self._track_indices):
            if index is not None:
                rows[row] = poses[index]
        self._bodies.show(rows)
        world = self.simulation.world
        fog, light = self.signal("fog", frame), self.signal("light_rate", frame)
        if fog is not None and world.scenery.state.water.physical_water is None:
            world.scenery.set_fog(fog)
        if light is not None:
            world.scenery.set_light_rate(light)
        self._show_physical_water(frame)
        self._show_drift(frame)
        for lamp in world.devices:
            if isinstance(lamp, MountedLamp):
                brightness = self.signal(f"{LAMP_PREFIX}{lamp.spec.name}", frame)
                lamp.state.brightness = 1.0 if brightness is None else brightness
        for number, heap in enumerate(world.scenery.heaps):
            heap.restore(self.track.sand.spots(number, frame))

    def _show_physical_water(self, frame: int) -> None:
        """Set physical water, if the scene has it, to its state in a frame of the track."""
        attenuation = self.signal(BEAM_ATTENUATION, frame)
        exposure = self.signal(EXPOSURE_LEVEL, frame)
        scenery, medium = self.simulation.world.scenery, self.simulation.world.model.optical_water
        if medium is None or attenuation is None or exposure is None:
            return
        water = restore_water(scenery.state.water, medium, attenuation, exposure)
        if water != scenery.state.water:
            scenery.state.water = water

    def _set_clocks(self) -> None:
        """Let surface and particles show the time of this trial; several may share a scene."""
        world = self.simulation.world
        scenery, water = world.scenery, world.scenery.state.water.physical_water
        if water is not None and (water.ripples is not None or world.water.waves is not None):
            scenery.set_surface(self._find_surface)
        if scenery.particles is not None:
            scenery.particles.set_clock(lambda: self._time)

    def _find_surface(self) -> MovingSurface:
        """Return the surface at the time that the scene shows, which may be between frames."""
        world = self.simulation.world
        scale = self.signal(WAVE_SCALE, frame_at(self.track, self._time)[0])
        return MovingSurface(
            time=self._time,
            waves=world.water.waves,
            wave_scale=1.0 if scale is None else scale,
            seed=world.model.seed,
        )

    def _show_drift(self, frame: int) -> None:
        """Set the displacement of the water that carries particles to that of a frame."""
        particles = self.simulation.world.scenery.particles
        if particles is None:
            return
        displacement, velocity = (self._read_vector(name, frame) for name in DRIFT_SIGNALS)
        particles.state.displacement[:], particles.state.velocity[:] = displacement, velocity
        particles.state.time = frame / self.track.rate
        if self._puffs is not None:
            self._puffs.show(self._time)

    def _find_water_velocity(self, time: float) -> Array:
        """Return the velocity of the water that carries particles, in W, (3,) [m/s]."""
        return self._read_vector(VELOCITY_SIGNAL, frame_at(self.track, time)[0])

    def _read_vector(self, name: str, frame: int) -> Array:
        """Return three signals of a frame, which are 0 where there is no value, (3,)."""
        return np.array([self.signal(f"{name}/{axis}", frame) or 0.0 for axis in "xyz"])

    def signal(self, name: str, frame: int) -> float | None:
        """Return the value of a signal in a frame of the track; None if there is no value."""
        values = self.track.signal(name)
        return None if values is None or math.isnan(values[frame]) else float(values[frame])

    def markers(self, time: float) -> dict[str, DrawnMarker]:
        """Return the markers at a simulation time [s]."""
        return markers_at(self.track.markers, frame_at(self.track, time)[0])

    def corners(self, kind: str, camera: str, time: float) -> Array | None:
        """Return the image coordinates of a target's four corners, (4, 2) [px]; None without them.

        Args:
            kind: ``truth`` or ``estimate``.
            camera: the name of the camera.
            time: the simulation time [s].
        """
        frame, _ = frame_at(self.track, time)
        names = [f"{kind}/{camera}/{k}/{axis}" for k in range(4) for axis in "uv"]
        values = [self.signal(name, frame) for name in names]
        if any(value is None for value in values):
            return None
        return np.array(values, dtype=np.float64).reshape(4, 2)

    def close(self) -> None:
        """Close the scene, if it was opened here."""
        if self._owns_simulation:
            self.simulation.close()


def open_scene(trial: RecordedTrial) -> Simulation:
    """Open the scene of a trial; Python code that it names is not run."""
    model = compile_scene(
        trial.scene,
        seed=trial.seed,
        timestep=trial.timestep,
        data_path=trial.data_path,
        compatibility=trial.compatibility,
    )
    return Simulation(model, runs_code=False)


def frame_at(track: MotionTrack, time: float) -> tuple[int, float]:
    """Return the frame at or before a time [s], and the fraction of the way to the next, 0..1."""
    frame_number = min(max(time * track.rate, 0.0), track.n_frames - 1.0)  # between two frames
    frame = min(int(frame_number + 1e-6), track.n_frames - 1)
    return frame, min(max(frame_number - frame, 0.0), 1.0)


def interpolate_poses(start: Array, end: Array, fraction: float) -> Array:
    """Interpolate linearly between poses, (n, 7), of two frames; quaternions are normalised."""
    rows: Array = (1.0 - fraction) * start + fraction * end
    rows[:, 3:] /= np.maximum(np.linalg.norm(rows[:, 3:], axis=1, keepdims=True), 1e-9)
    return rows
