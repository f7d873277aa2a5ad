"""An OpenGL 3.3 core context without a window."""

from __future__ import annotations

import os
from typing import Any

import moderngl

from ..base.environment import set_environment
from ..errors import NoGraphics

ENVIRONMENT = {
    "LP_NUM_THREADS": str(min(4, 2 * (os.cpu_count() or 1))),
    "EGL_LOG_LEVEL": "fatal",
}
"""The environment variables of Mesa that are set, unless the user has set them. Camera images are
too small for more than a few threads of the software rasteriser, and `NoGraphics` reports errors
once. The variables do not change a byte of an image."""

N_DEVICES = 4
"""The number of EGL devices that are tried, in EGL's order: graphics cards precede llvmpipe."""


def create_context() -> moderngl.Context:
    """Create a headless context through EGL, on a GPU if there is one, else on Mesa's llvmpipe.

    Raises:
        NoGraphics: there is no usable OpenGL; the error message states what to install.
    """
    failures: list[Exception] = []
    for device in range(N_DEVICES):
        settings: dict[str, Any] = {"standalone": True, "backend": "egl", "device_index": device}
        try:
            with set_environment(ENVIRONMENT):  # processes started later choose for themselves
                context = moderngl.create_context(require=330, **settings)
        except Exception as error:  # glcontext and moderngl raise bare Exceptions
            failures.append(error)
        else:
            context.gc_mode = "context_gc"
            return context
    first_error = " ".join(str(failures[0]).split())
    raise NoGraphics(
        "No OpenGL 3.3 context could be made. Install Mesa's software renderer with: "
        f"apt-get install libegl1 libgl1 libgl1-mesa-dri ({first_error})"
    ) from failures[0]
