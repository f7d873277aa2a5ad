r"""Alignment of an image with a template by ESM and related first-order methods.

With the image :math:`I`, the template :math:`I^*`, a template pixel :math:`p`, the warp :math:`w`
and the present estimate :math:`\hat H` of the homography, the residual
:math:`s_p(x) = I(w(\hat H e^{x}, p)) - I^*(p)` is linearised in the step :math:`x` with

.. math:: J = (a\,J_I + b\,J_{I^*})\,J_w J_G, \qquad x = -J^+ s(0), \qquad
          \hat H \leftarrow \hat H \exp(x)

where :math:`J_I` is the gradient of the warped image, :math:`J_{I^*}` the gradient of the template,
:math:`J_w` the derivative of the warp and :math:`J_G` the generators of the homographies
(`homography.exponential`). a = b = 1/2 is ESM (Benhimane and Malis 2004, 2007), which converges to
second order without second derivatives. a = 0, b = 1 is the inverse compositional method (Baker and
Matthews 2004), and a = 1, b = 0 the forward compositional method.

*Photometric normalisation.* Both patches are normalised to zero mean and unit variance. J is
projected onto the complement of the vectors 1 and I*, along which an offset and a gain of the
brightness act, so that changes of light and fog do not cause a motion. Without the normalisation,
grey levels are compared as they are.
"""

from __future__ import annotations

from dataclasses import dataclass

from ...base.geometry import Array
from ...base.numerics.linear import inverse, product
from .alignment_kernel import Settings, iterate
from .correlation import nearest_zncc
from .patch import Patch
from .pyramid import Grey
from .template import Template

GRADIENT_WEIGHTS = {"esm": (0.5, 0.5), "ic": (0.0, 1.0), "fc": (1.0, 0.0)}
"""The weights (a, b) of the image's and of the template's gradient in J."""


@dataclass(frozen=True, kw_only=True)
class Method:
    """The linearisation and the stopping criteria of an alignment."""

    blend: str = "esm"
    """The blend of the two gradients in J: ``esm``, ``ic`` (inverse compositional) or ``fc``
    (forward compositional)."""
    photometric: bool = True
    """True if patches are normalised to zero mean and unit variance."""
    max_iterations: int = 20
    """The greatest number of steps in one call."""
    precision: float = 1e-4
    """The length of a step, in normalised template coordinates, below which the iterations end."""


@dataclass(frozen=True, eq=False)
class Alignment:
    """The result of an alignment."""

    homography: Array
    """The homography from points of the template's image to points of the image, (3, 3); of all
    iterations, the one with the best score."""
    correlation: float
    """The correlation of the template with the interpolated image, -1..1; -1 if too few pixels of
    the template are in the image."""
    iterations: int
    """The number of steps."""


def align(image: Grey, template: Template, guess: Array, method: Method) -> Alignment:
    """Align a template with an image.

    Args:
        image: the image, (h, w) [grey level].
        template: the template.
        guess: the homography at which the iterations start, from points of the template's image to
            points of the image [px], (3, 3).
        method: the method of alignment.
    """
    a, b = GRADIENT_WEIGHTS[method.blend]
    patch = Patch(
        runs=template.runs,
        values=template.values,
        slope_u=template.slope_u,
        slope_v=template.slope_v,
        mean=template.mean,
        contrast=template.contrast,
    )
    settings = Settings(
        a=a,
        b=b,
        photometric=method.photometric,
        max_iterations=method.max_iterations,
        precision=method.precision,
    )
    start = product(guess, template.image_from_normalised)
    homography, correlation, iterations = iterate(image, patch, start, settings)
    back = inverse(template.image_from_normalised)
    return Alignment(product(homography, back), correlation, iterations)


def zncc(image: Grey, template: Template, homography: Array) -> float:
    """Return the zero-mean normalised cross-correlation (ZNCC) of a template and an image.

    The template's pixels are compared with the nearest pixels of the image, without interpolation:
    bilinear interpolation averages the noise of four pixels, so that the correlation would stay
    high where the target is not visible. For a template of the contrast S, an image in which the
    transmission T of fog reduces the contrast to S T, and noise of the standard deviation sigma,
    the result is ``S T / sqrt((S T)^2 + sigma^2)``. It is -1 if less than a quarter of the patch is
    in the image.

    Args:
        image: the image, (h, w) [grey level].
        template: the template.
        homography: the homography from points of the template's image to points of the image [px],
            (3, 3).
    """
    return nearest_zncc(
        image,
        template.runs,
        template.values,
        product(homography, template.image_from_normalised),
    )
