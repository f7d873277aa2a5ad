"""The options that locate the files of a stored result."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from ...verify.recorded_plan import FileOverrides
from .help_texts import FILES, option
from .options import CodeOptions


@dataclass(frozen=True, kw_only=True)
class FileOptions:
    """The options that locate the files of a result."""

    benchmark: Annotated[
        Path | None,
        option(
            FILES,
            "--benchmark",
            metavar="FILE.xml",
            help="The benchmark, if it is not found by its name.",
        ),
    ] = None
    scene: Annotated[
        Path | None,
        option(
            FILES, "--scene", metavar="FILE.xml", help="The scene, if it is not found by its name."
        ),
    ] = None
    code: CodeOptions

    def overrides(self) -> FileOverrides:
        """Return the locations that replace those recorded in the result."""
        return FileOverrides(
            benchmark=self.benchmark,
            scene=self.scene,
            plugins=tuple(self.code.plugin or ()),
            data_path=self.code.folders,
            no_code=self.code.no_code,
        )
