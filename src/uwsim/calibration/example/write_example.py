"""The files of the example: a set-up and its synthetic pictures.

Two waters, of one and of two drops of dye, are drawn with the formulas of `optics`. So the example
shows how the tool is used, and not how exact it is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...base.rng import stream
from ...optics import Lamp, Medium, compute_lamp_veil
from ...optics.lamp_light import compute_lamp_attenuation
from ...optics.phase_function import FloatArray
from ...optics.transmission import compute_direct, compute_led_signal, compute_modulation_transfer
from ..forward_model import make_phase_function
from ..pure_water import compute_pure_absorption, compute_pure_scattering
from .synthetic_pictures import (
    LAYOUT,
    SyntheticCamera,
    compute_board_irradiance,
    draw_board,
    draw_led,
)

SETUP_NAME = "setup.xml"
WAVELENGTHS = {"red": 620.0, "green": 540.0, "blue": 460.0}
"""The effective wavelength of each channel [nm]."""
DYE_ABSORPTION = {"red": 0.05, "green": 0.06, "blue": 0.09}
"""The absorption that one dose adds [1/m]."""
DYE_SCATTERING = {"red": 0.42, "green": 0.44, "blue": 0.45}
"""The scattering that one dose adds [1/m]."""
SHAPE = 0.8
DOSES = {"one drop": 1.0, "two drops": 2.0}
LED_LIGHT = 20.0
"""The light of the LED's picture in all pixels, as a share of full scale in the exposure time 1."""
LED_EXPOSURES = (0.25, 4.0)
BOARD_LIGHT = 1.6
"""The light of a white surface at 1 m in clear water, as a share of full scale."""
BOARD_EXPOSURE = 0.5
VEIL_EXPOSURE = 8.0
N_FRAMES = 2
N_DARK_FRAMES = 2
LAMP_POSITION = (0.15, 0.0, 0.0)
DISTANCE = 1.0
SEED = 1


@dataclass(frozen=True)
class ExampleWater:
    """A water of the example."""

    name: str
    folder: str
    dose: float

    def make_medium(self, channel: str) -> Medium:
        """Return the water in a channel."""
        wavelength = WAVELENGTHS[channel]
        phase = make_phase_function(SHAPE)
        return Medium(
            absorption=(compute_pure_absorption(wavelength) + self.dose * DYE_ABSORPTION[channel],),
            scattering=(compute_pure_scattering(wavelength) + self.dose * DYE_SCATTERING[channel],),
            phase_function=phase,
        )


CLEAR_WATER = ExampleWater("clear", "clear", 0.0)
WATERS = tuple(ExampleWater(name, name.replace(" ", "-"), dose) for name, dose in DOSES.items())


def write_example(directory: Path) -> list[Path]:
    """Write the set-up and the pictures into an empty directory.

    Returns:
        The files.
    """
    camera = SyntheticCamera()
    files = []
    for water in (CLEAR_WATER, *WATERS):
        folder = directory / water.folder
        folder.mkdir(parents=True, exist_ok=True)
        for name, light, exposures in _draw_pictures(camera, water):
            for exposure in exposures:
                generator = stream(SEED, f"calibrate/example/{water.folder}/{name}/{exposure:g}")
                planes = [
                    camera.expose(light[channel], exposure, N_FRAMES, generator)
                    for channel in WAVELENGTHS
                ]
                files += _write_frames(folder / f"{name}-{exposure:g}", planes)
    dark_folder = directory / "dark"
    dark_folder.mkdir(parents=True, exist_ok=True)
    no_light = np.zeros((camera.rows, camera.columns))
    for exposure in sorted({*LED_EXPOSURES, BOARD_EXPOSURE, VEIL_EXPOSURE}):
        generator = stream(SEED, f"calibrate/example/dark/{exposure:g}")
        planes = [camera.expose(no_light, exposure, N_DARK_FRAMES, generator) for _ in WAVELENGTHS]
        files += _write_frames(dark_folder / f"dark-{exposure:g}", planes)
    setup = directory / SETUP_NAME
    setup.write_text(_write_setup(camera), encoding="utf-8")
    return [*files, setup]


def _draw_pictures(
    camera: SyntheticCamera, water: ExampleWater
) -> list[tuple[str, dict[str, FloatArray], tuple[float, ...]]]:
    """Draw the light of the pictures through a water, by channel, with their exposures."""
    pictures: dict[str, dict[str, FloatArray]] = {"led": {}, "board": {}, "veil": {}}
    for channel in WAVELENGTHS:
        medium = water.make_medium(channel)
        pictures["led"][channel] = LED_LIGHT * _draw_led(camera, medium)
        pictures["board"][channel] = BOARD_LIGHT * math.pi * _draw_board(camera, medium)
        pictures["veil"][channel] = BOARD_LIGHT * math.pi * _draw_veil(camera, medium)
    exposures = {"led": LED_EXPOSURES, "board": (BOARD_EXPOSURE,), "veil": (VEIL_EXPOSURE,)}
    return [(name, light, exposures[name]) for name, light in pictures.items()]


def _draw_led(camera: SyntheticCamera, medium: Medium) -> FloatArray:
    direct_light = float(compute_direct(medium, DISTANCE)[0])

    def compute_scattered(angles: FloatArray) -> FloatArray:
        return compute_led_signal(medium, DISTANCE, angles)[:, 0] - direct_light

    return draw_led(camera, direct_light, compute_scattered)


def _draw_board(camera: SyntheticCamera, medium: Medium) -> FloatArray:
    def compute_irradiance(x: FloatArray, y: FloatArray) -> FloatArray:
        lengths, factors = compute_board_irradiance((x, y), DISTANCE, LAMP_POSITION)
        attenuation = compute_lamp_attenuation(medium, math.radians(30.0), 2.0 * lengths)[..., 0]
        return np.asarray(factors * np.exp(-attenuation * lengths))

    def compute_transfer(frequencies: FloatArray) -> FloatArray:
        return compute_modulation_transfer(medium, frequencies, DISTANCE)[:, 0]

    board = draw_board(camera, LAYOUT, DISTANCE, compute_transfer, compute_irradiance)
    return board + _draw_veil(camera, medium, DISTANCE)


def _draw_veil(camera: SyntheticCamera, medium: Medium, distance: float = math.inf) -> FloatArray:
    x0, y0 = camera.middle
    rows, columns = np.indices((camera.rows, camera.columns))
    rays = np.stack(
        [
            (columns - x0) / camera.focal_length,
            (rows - y0) / camera.focal_length,
            np.ones(rows.shape),
        ],
        axis=-1,
    )
    rays = rays / np.linalg.norm(rays, axis=-1, keepdims=True)
    lamp = Lamp(
        position=LAMP_POSITION,
        direction=(0.0, 0.0, 1.0),
        intensity=(1.0,),
        half_angle=math.radians(30.0),
    )
    ranges = distance / rays[..., 2] if math.isfinite(distance) else np.full(rows.shape, math.inf)
    return compute_lamp_veil(medium, lamp, (0.0, 0.0, 0.0), rays, ranges)[..., 0]


def _write_frames(stem: Path, planes: list[list[FloatArray]]) -> list[Path]:
    """Write frames as colour pictures of 16 bit; planes are red, green and blue."""
    import cv2

    files = []
    for index, frame in enumerate(zip(*planes, strict=True), start=1):
        picture = np.stack(frame[::-1], axis=-1).astype(np.uint16)  # OpenCV's order
        path = stem.with_name(f"{stem.name}-{index}.png")
        is_encoded, data = cv2.imencode(".png", picture)
        assert is_encoded
        path.write_bytes(data.tobytes())
        files.append(path)
    return files


def _write_setup(camera: SyntheticCamera) -> str:
    lines = [
        "<?xml version='1.0'?>",
        "<!-- Synthetic pictures: edit this set-up for your own. Lengths in m, angles in rad. -->",
        "<calibration>",
        "  <camera>",
        f"    <focalLength>{camera.focal_length:g}</focalLength>  <!-- in the water, in pixels -->",
        f"    <fullScale>{camera.full_scale}</fullScale> <encoding>linear</encoding>",
        "  </camera>",
    ]
    for plane, (channel, wavelength) in enumerate(WAVELENGTHS.items()):
        lines.append(
            f"  <channel> <name>{channel}</name> <plane>{plane}</plane> "
            f"<wavelength>{wavelength:g}</wavelength> </channel>"
        )
    x, y, z = LAMP_POSITION
    lines += [
        f"  <led> <name>white-led</name> <distance>{DISTANCE:g}</distance> </led>",
        "  <board>",
        f"    <name>board</name> <distance>{DISTANCE:g}</distance>",
        f"    <lampPosition> <x>{x:g}</x> <y>{y:g}</y> <z>{z:g}</z> </lampPosition>",
        f"    <lampHalfAngle>{math.radians(30.0):.4f}</lampHalfAngle>",
        *(f"    <square>{side:g}</square>" for side in LAYOUT.sides),
        "    <white>0.9</white> <black>0.05</black>",
        "  </board>",
        "  <reference>",
        *_write_pictures(CLEAR_WATER, with_veil=False),
        "  </reference>",
    ]
    for water in WATERS:
        lines += [
            "  <water>",
            f"    <name>{water.name}</name> <dose>{water.dose:g}</dose>",
            *_write_pictures(water, with_veil=True),
            "  </water>",
        ]
    return "\n".join([*lines, "</calibration>", ""])


def _write_pictures(water: ExampleWater, *, with_veil: bool) -> list[str]:
    pictures = [("white-led", "led", LED_EXPOSURES), ("board", "board", (BOARD_EXPOSURE,))]
    if with_veil:
        pictures.append(("open-water", "veil", (VEIL_EXPOSURE,)))
    lines = []
    for source, name, exposures in pictures:
        lines += ["    <picture>", f"      <source>{source}</source>"]
        for exposure in exposures:
            lines += [
                "      <exposure>",
                f"        <time>{exposure:g}</time>",
                f"        <frames>{water.folder}/{name}-{exposure:g}-*.png</frames>",
                f"        <dark>dark/dark-{exposure:g}-*.png</dark>",
                "      </exposure>",
            ]
        lines.append("    </picture>")
    return lines
