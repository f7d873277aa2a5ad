"""An OpenGL 3.3 core context without a window."""

from __future__ import annotations

import os
from typing import Any

import moderngl

from ..errors import NoGraphics

ENVIRONMENT = {
    "EGL_PLATFORM": "surfaceless",
}
"""Switches of Mesa, set where the user has not: no window system is asked for."""

_HEADLESS: dict[str, Any] = {"standalone": True, "backend": "egl"}


def create_context() -> moderngl.Context:
    """Make a headless context through EGL; a GPU when there is one, else Mesa's llvmpipe.

    Raises:
        NoGraphics: there is no usable OpenGL; the message says what to install.
    """
    for name, value in ENVIRONMENT.items():
        os.environ.setdefault(name, value)
    try:
        context = moderngl.create_context(require=330, **_HEADLESS)
    except Exception as error:  # glcontext raises bare Exceptions
        raise NoGraphics(
            "No OpenGL context could be made. Install Mesa's software renderer with: "
            f"apt-get install libegl1 libgl1 libgl1-mesa-dri ({error})"
        ) from error
    context.gc_mode = "context_gc"
    return context
