r"""Alignment of an image with a template by ESM and related first-order methods.

With :math:`p` a template pixel, :math:`w` the warp and :math:`\hat H` the guess, the residual
:math:`s_p(x) = I(w(\hat H e^{x}, p)) - I^*(p)` is linearised with

.. math:: J = (a\,J_I + b\,J_{I^*})\,J_w J_G, \qquad x = -J^+ s(0), \qquad
          \hat H \leftarrow \hat H \exp(x)

where :math:`J_I` is the gradient of the warped image and :math:`J_{I^*}` that of the template.
a = b = 1/2 is ESM (Benhimane and Malis 2004, 2007): second order without second derivatives.
a = 0, b = 1 is inverse compositional (Baker and Matthews 2004), a = 1, b = 0 forward compositional.

*Photometry.* Both patches are normalised to zero mean and unit variance. J is projected onto the
complement of 1 and I*, the effects of gain and bias, so that changes of light and fog cause no
motion. Without it, the grey levels are compared without normalisation.
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

GRADIENT_SHARES = {"esm": (0.5, 0.5), "ic": (0.0, 1.0), "fc": (1.0, 0.0)}
"""The shares (a, b) of the image's and of the template's gradient in J."""


@dataclass(frozen=True, kw_only=True)
class Method:
    """The linearisation and the stopping criteria of an alignment."""

    blend: str = "esm"
    """``esm``, ``ic`` or ``fc``."""
    photometric: bool = True
    """True if patches are normalised to zero mean and unit variance."""
    max_iterations: int = 20
    """The most steps in one call."""
    precision: float = 1e-4
    """The length of a step, in normalised coordinates, below which it is the last."""


@dataclass(frozen=True, eq=False)
class Alignment:
    """The result of an alignment."""

    homography: Array
    """The homography from template to image points, (3, 3), with the best score."""
    correlation: float
    """The correlation with the interpolated image, -1..1; -1 if too few pixels are in it."""
    iterations: int
    """The number of steps."""


def align(image: Grey, template: Template, guess: Array, method: Method) -> Alignment:
    """Refine ``guess`` (3, 3), a homography from template to ``image`` points [px]."""
    a, b = GRADIENT_SHARES[method.blend]
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
    """Return the zero-mean normalised cross-correlation of template and nearest image pixels.

    Pixels are not interpolated: bilinear interpolation averages the noise of four pixels, so that
    the correlation stays high where the target is not visible. With noise sigma in the image
    and contrast S T left of the template, the result is ``S T / sqrt((S T)^2 + sigma^2)``.
    It is -1 if less than a quarter of the patch is in the image.
    """
    return nearest_zncc(
        image,
        template.runs,
        template.values,
        product(homography, template.image_from_normalised),
    )
