"""Smooth images that are known everywhere, and what a camera and fog would make of them."""

from __future__ import annotations

import numpy as np

from uwsim.algorithms.esm.homography import warp


class Texture:
    """A sum of cosines: known, with its derivatives, at every point of the plane."""

    def __init__(
        self, seed: int = 0, *, shortest: float = 8.0, longest: float = 60.0, waves: int = 16
    ) -> None:
        rng = np.random.Generator(np.random.Philox(seed))
        n = waves
        wavelength = shortest * (longest / shortest) ** rng.random(n)
        angle = 2 * np.pi * rng.random(n)
        k = 2 * np.pi / wavelength * np.stack([np.cos(angle), np.sin(angle)])
        self._k = k.astype(np.float32)
        self._phase = (2 * np.pi * rng.random(n)).astype(np.float32)
        self._mean, self._contrast = 128.0, 30.0

    def at(self, points: np.ndarray) -> np.ndarray:
        """Grey levels at points (n, 2): mean 128, standard deviation about 30."""
        phase = (points.astype(np.float32) @ self._k + self._phase).astype(np.float32)
        return self._mean + self._contrast * np.cos(phase).sum(axis=1) / np.sqrt(phase.shape[1] / 2)

    def image(
        self, homography: np.ndarray | None = None, *, width: int = 320, height: int = 240
    ) -> np.ndarray:
        """The image after the plane was moved by ``homography``, (h, w) float32."""
        u, v = np.meshgrid(np.arange(width), np.arange(height))
        points = np.stack([u.ravel(), v.ravel()], axis=1)
        if homography is not None:
            points = warp(np.linalg.inv(homography), points)
        return self.at(points).reshape(height, width).astype(np.float32)


def through_fog(
    image: np.ndarray, transmission: float, rng: np.random.Generator, *, sigma: float = 0.0
) -> np.ndarray:
    """Mix towards grey level 16 and add the camera's noise [grey level], in 8 bits."""
    foggy = 16.0 + transmission * (image - 16.0) + sigma * rng.standard_normal(image.shape)
    return np.clip(np.rint(foggy), 0, 255).astype(np.uint8)


def rectangle(u: float, v: float, width: float, height: float) -> np.ndarray:
    """NW, NE, SE, SW of an upright rectangle about (u, v), (4, 2)."""
    w, h = width / 2, height / 2
    return np.array([[u - w, v - h], [u + w, v - h], [u + w, v + h], [u - w, v + h]])
