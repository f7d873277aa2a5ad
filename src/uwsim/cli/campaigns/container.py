"""``uwsim container``: print the definition of an image with uwsim."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from ...campaigns.container import ContainerImage
from ...version import __version__
from ..options.help_texts import OUTPUT, option


class ImageFormat(StrEnum):
    """The format of the definition of an image."""

    apptainer = "apptainer"
    oci = "oci"


FormatArgument = Annotated[
    ImageFormat,
    typer.Argument(
        metavar="apptainer|oci",
        help="The format: a definition file of Apptainer, or a Containerfile (Docker, Podman).",
        show_default=False,
    ),
]


def container(
    image_format: FormatArgument,
    wheel: Annotated[
        Path,
        option(
            OUTPUT,
            "--wheel",
            metavar="FILE.whl",
            help="The wheel of uwsim, from `pip wheel . --no-deps`.",
        ),
    ] = Path(f"uwsim-{__version__}-py3-none-any.whl"),
    extras: Annotated[
        list[str] | None,
        option(
            OUTPUT,
            "--extra",
            metavar="NAME",
            help="An optional part of uwsim, such as export; may be repeated.",
        ),
    ] = None,
) -> None:
    """Print the definition of an image with uwsim.

    The image has Python and Mesa of Debian 12, the wheel, and filled caches of compiled code. These
    are for the type of processor that builds the image; others compile once.
    """
    image = ContainerImage(wheel=wheel, extras=tuple(extras or ()))
    print(image.apptainer() if image_format is ImageFormat.apptainer else image.oci(), end="")
