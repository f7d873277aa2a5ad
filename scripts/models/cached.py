"""A cache of images and materials that several models share."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, wraps
from typing import ParamSpec, TypeVar, cast

from uwsim.base.numerics.opencv import deterministic_opencv

Arguments = ParamSpec("Arguments")
Product = TypeVar("Product")


def cache_image(make: Callable[Arguments, Product]) -> Callable[Arguments, Product]:
    """Cache what a function makes from images, in the deterministic mode of OpenCV.

    Whoever calls the function first decides what is cached: without the mode, a file that is built
    later in the same process would have other bytes.
    """

    @cache
    @wraps(make)
    def make_once(*arguments: Arguments.args, **options: Arguments.kwargs) -> Product:
        with deterministic_opencv():
            return make(*arguments, **options)

    return cast("Callable[Arguments, Product]", make_once)
