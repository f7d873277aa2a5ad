"""The definitions of images with uwsim: of Apptainer, and of OCI builders (Docker, Podman).

Both are made from one list. The caches of compiled code are filled at the build, on the processor
of the building machine; on another type of processor, the first start compiles once for a user.
"""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from ..errors import BadSetting

BASE = "debian:12-slim"
PACKAGES = ("python3", "python3-venv", "libegl1", "libgl1", "libgl1-mesa-dri")
"""The Debian packages that uwsim needs: Python, and Mesa's EGL and OpenGL."""
HOME = "/opt/uwsim"
"""The folder of the virtual environment and its caches in the image."""
WARM_UP = ("bench", "currents", "--level", "current=0", "--out", "/tmp/warm-up.result")
"""The run that fills the caches: physics, sensors, a camera, logs, plots and the report."""
ENVIRONMENT = {
    "PATH": f"{HOME}/bin:/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin",
    "MPLCONFIGDIR": "/tmp/uwsim-matplotlib",
}
LAUNCHER = rf"""#!/bin/bash
# Start uwsim with the caches of the image, copied to the user's folder if the image is read-only.
caches={HOME}/caches
if [ ! -w "$caches" ]; then
    own="${{XDG_CACHE_HOME:-${{HOME:-/nonexistent}}/.cache}}/uwsim-image"
    if [ ! -d "$own" ]; then
        mkdir -p "$(dirname "$own")" 2>/dev/null
        draft=$(mktemp -d "$own.XXXXXX" 2>/dev/null || mktemp -d)
        cp -r "$caches/." "$draft"
        mv -T "$draft" "$own" 2>/dev/null || own=$draft
    fi
    caches=$own
fi
export NUMBA_CACHE_DIR="$caches/numba" XDG_CACHE_HOME="$caches"
exec {HOME}/venv/bin/uwsim "$@"
"""
"""The program ``uwsim`` of the image."""


@dataclass(frozen=True, kw_only=True)
class ContainerImage:
    """The contents of an image."""

    wheel: Path
    """The wheel of uwsim on the building machine."""
    extras: tuple[str, ...] = ()
    """The names of extras of uwsim, such as ``export``."""

    def __post_init__(self) -> None:
        """Check the name of the wheel; raise BadSetting."""
        if self.wheel.suffix != ".whl" or any(c.isspace() for c in str(self.wheel)):
            raise BadSetting(f"--wheel {self.wheel}: expected a file .whl, without spaces.")

    def apptainer(self) -> str:
        """Return the definition file of Apptainer."""
        lines = [
            "# Build with: apptainer build image.sif FILE",
            "Bootstrap: docker",
            f"From: {BASE}",
            "",
            "%files",
            f"    {self.wheel} /tmp/{self.wheel.name}",
            "",
            "%post",
            *_indent(self._build()),
            "",
            "%environment",
            *_indent(f"export {name}={value}" for name, value in ENVIRONMENT.items()),
            "",
            "%runscript",
            '    exec uwsim "$@"',
        ]
        return "\n".join(lines) + "\n"

    def oci(self) -> str:
        """Return the Containerfile of Docker, Podman and Buildah."""
        lines = [
            "# Build with: podman build --tag uwsim --file FILE .   (or docker)",
            f"FROM {BASE}",
            f"COPY {self.wheel} /tmp/{self.wheel.name}",
            *(f"ENV {name}={value}" for name, value in ENVIRONMENT.items()),
            "RUN " + " && \\\n    ".join(self._build()),
            'ENTRYPOINT ["uwsim"]',
        ]
        return "\n".join(lines) + "\n"

    def _build(self) -> list[str]:
        """Return the shell commands of the build, each in one line."""
        extras = f"[{','.join(self.extras)}]" if self.extras else ""
        launcher = f"{HOME}/bin/uwsim"
        return [
            "apt-get update",
            "DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "
            + " ".join(PACKAGES),
            "rm -rf /var/lib/apt/lists",
            f"python3 -m venv {HOME}/venv",
            f"{HOME}/venv/bin/pip install --no-cache-dir "
            + shlex.quote(f"/tmp/{self.wheel.name}{extras}"),
            f"mkdir -p {HOME}/bin {HOME}/caches",
            f"printf '%s\\n' {_words(LAUNCHER.splitlines())} > {launcher}",
            f"chmod 755 {launcher}",
            f"{launcher} {shlex.join(WARM_UP)}",
            f"rm -rf /tmp/warm-up.result /tmp/{self.wheel.name}",
            f"chmod -R a+rX {HOME}",
        ]


def _indent(lines: Iterable[str]) -> list[str]:
    return [f"    {line}" for line in lines]


def _words(lines: Sequence[str]) -> str:
    return " ".join(shlex.quote(line) for line in lines)
