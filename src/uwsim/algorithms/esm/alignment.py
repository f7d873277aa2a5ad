r"""Alignment of an image with a template: ESM, and its first-order relatives.

With :math:`p` a template pixel, :math:`w` the warp and :math:`\hat H` the guess, the residual
:math:`s_p(x) = I(w(\hat H e^{x}, p)) - I^*(p)` is linearised with

.. math:: J = (a\,J_I + b\,J_{I^*})\,J_w J_G, \qquad x = -J^+ s(0), \qquad
          \hat H \leftarrow \hat H \exp(x)

where :math:`J_I` is the gradient of the warped image and :math:`J_{I^*}` that of the template.
a = b = 1/2 is ESM (Benhimane and Malis 2004, 2007): second order without second derivatives.
a = 0, b = 1 is inverse compositional (Baker and Matthews 2004), a = 1, b = 0 forward compositional.

*Photometry.* Both patches are brought to zero mean and unit variance, and what a change of gain and
bias would explain of J is taken out of it (projection onto the complement of 1 and I*), so that
light and fog do not look like motion. Without it the grey levels are compared as they are.
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

BLENDS = {"esm": (0.5, 0.5), "ic": (0.0, 1.0), "fc": (1.0, 0.0)}
"""Share (a, b) of the image's and of the template's gradient in J."""


@dataclass(frozen=True, kw_only=True)
class Method:
    """Linearisation and stopping criteria of an alignment."""

    blend: str = "esm"
    """``esm``, ``ic`` or ``fc``."""
    photometric: bool = True
    """Compare patches of zero mean and unit variance."""
    max_iterations: int = 20
    """At most so many steps in one call."""
    precision: float = 1e-4
    """A step shorter than this, in normalised coordinates, is the last."""


@dataclass(frozen=True, eq=False)
class Alignment:
    """The result of an alignment."""

    homography: Array
    """Sends template points to the image, (3, 3); the best seen on the way."""
    correlation: float
    """Correlation with the interpolated image, -1..1; -1 when too little is in the image."""
    iterations: int
    """Steps taken."""


def align(image: Grey, template: Template, guess: Array, method: Method) -> Alignment:
    """Refine ``guess`` (3, 3), which sends template points to ``image`` points [px]."""
    a, b = BLENDS[method.blend]
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
    """Zero-mean normalised cross-correlation of the template with the image's nearest pixels.

    Pixels are taken as they are, not interpolated: bilinear interpolation averages the noise of
    four pixels, so that a correlation of it stays high where nothing can be seen any more. With
    noise sigma in the image and contrast S T left of the template, the result is
    ``S T / sqrt((S T)^2 + sigma^2)``. -1 when less than a quarter of the patch is in the image.
    """
    return nearest_zncc(
        image,
        template.runs,
        template.values,
        product(homography, template.image_from_normalised),
    )
