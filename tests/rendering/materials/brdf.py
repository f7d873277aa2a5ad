"""The reflection of rough surfaces in numpy, as reference for the shaders."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
IN_WATER, IN_AIR = 1.5 / 1.34, 1.5


def exact_fresnel(cosine: FloatArray, index: float) -> FloatArray:
    """Return Fresnel's reflectance for unpolarised light from the two amplitudes."""
    refracted = np.sqrt(1.0 - (1.0 - cosine**2) / index**2)
    senkrecht = (cosine - index * refracted) / (cosine + index * refracted)
    parallel = (refracted - index * cosine) / (refracted + index * cosine)
    return 0.5 * (senkrecht**2 + parallel**2)


def microfacets(
    normal: FloatArray, light: FloatArray, view: FloatArray, roughness: float
) -> tuple[FloatArray, FloatArray]:
    """Return pi D G of GGX with Smith's joint shadowing, and v.h, for unit vectors (..., 3)."""
    half = light + view
    half /= np.linalg.norm(half, axis=-1, keepdims=True)
    alpha = roughness**2
    n_h, n_l, n_v, v_h = (
        (a * b).sum(axis=-1)
        for a, b in ((normal, half), (normal, light), (normal, view), (view, half))
    )
    # Walter et al. (2007), equation 33, with tan^2 of the angle between normal and half vector
    tangent2 = 1.0 / n_h**2 - 1.0
    density = alpha**2 / (math.pi * n_h**4 * (alpha**2 + tangent2) ** 2)

    def smith_lambda(cosine: FloatArray) -> FloatArray:
        return 0.5 * (np.sqrt(1.0 + alpha**2 * (1.0 / cosine**2 - 1.0)) - 1.0)

    shadowing = 1.0 / (1.0 + smith_lambda(n_l) + smith_lambda(n_v))
    return math.pi * density * shadowing / (4.0 * n_l * n_v), v_h


def even_reflectance(cosine: float, roughness: float, index: float | None) -> float:
    """Return the share of even light that microfacets reflect, by a sum over directions.

    Args:
        cosine: the cosine between normal and camera.
        roughness: the roughness.
        index: the relative refractive index; None: a mirror.
    """
    n = 700
    cosines = (np.arange(n) + 0.5) / n
    azimuths = math.pi * (np.arange(n) + 0.5) / n
    c, phi = np.meshgrid(cosines, azimuths, indexing="ij")
    s = np.sqrt(1.0 - c * c)
    light = np.stack([s * np.cos(phi), s * np.sin(phi), c], axis=-1)
    view = np.array([math.sqrt(1.0 - cosine**2), 0.0, cosine])
    normal = np.array([0.0, 0.0, 1.0])
    facets, v_h = microfacets(normal, light, np.broadcast_to(view, light.shape), roughness)
    fresnel = 1.0 if index is None else exact_fresnel(v_h, index)
    return float((facets * fresnel * c).mean() * 2.0)


def reflected_share(
    normal: FloatArray,
    light: FloatArray,
    view: FloatArray,
    *,
    albedo: float,
    roughness: float,
    metallic: float,
) -> FloatArray:
    """Return pi times the BRDF of a surface in water."""
    facets, v_h = microfacets(normal, light, view, roughness)
    n_v = np.clip((normal * view).sum(axis=-1), 0.0, 1.0)
    nodes = np.linspace(max(float(n_v.min()), 0.02), 1.0, 12)
    dielectric = np.interp(
        n_v, nodes, [even_reflectance(node, roughness, IN_WATER) for node in nodes]
    )
    mirror = np.interp(n_v, nodes, [even_reflectance(node, roughness, None) for node in nodes])
    schlick = albedo + (1.0 - albedo) * (1.0 - v_h) ** 5
    metal = schlick * (1.0 + albedo * (1.0 / mirror - 1.0))
    fresnel = (1.0 - metallic) * exact_fresnel(v_h, IN_WATER) + metallic * metal
    return albedo * (1.0 - metallic) * (1.0 - dielectric) + facets * fresnel
