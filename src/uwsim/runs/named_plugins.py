"""The search for plugins that a benchmark file names (``u:plugin``); they may be refused."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..base.files.input_files import compute_hash
from ..errors import AssetNotFound, BadSetting, BenchmarkError
from ..schema import NAMESPACE, Diagnostics, parse

if TYPE_CHECKING:
    from .planning.plan_request import PlanRequest

ATTRIBUTE = f"{{{NAMESPACE}}}plugin"


def plugin_names(benchmark: Path) -> tuple[str, ...]:
    """Return the plugins that a benchmark file names; none if the file is not XML."""
    try:
        root = parse(benchmark, error=BenchmarkError).root
    except (BenchmarkError, OSError):
        return ()  # the reader of the file reports it
    return tuple(str(root.get(ATTRIBUTE, "")).split())


def named_plugins(benchmark: Path, request: PlanRequest) -> list[Path]:
    """Find and announce the plugins that a benchmark file names and that no option has named.

    Raises:
        BadSetting: code is refused.
        BenchmarkError: a plugin is not found, or is outside the folders searched.
    """
    from .foreign_code import announce, code_refusal

    names, option_paths = plugin_names(benchmark), request.plugins
    if names and request.no_code:
        raise code_refusal(names[0], str(benchmark))
    hashes = {compute_hash(path) for path in option_paths if path.is_file()}
    paths = []
    for name in names:
        path = _find_plugin(name, benchmark, request.data_path)
        if (digest := compute_hash(path)) not in hashes:
            hashes.add(digest)
            announce(name, str(benchmark), path=path)
            paths.append(path)
    return paths


def _find_plugin(name: str, benchmark: Path, data_path: Sequence[Path]) -> Path:
    """Find a plugin; raise BenchmarkError with the line of the benchmark if it is not found."""
    from ..assets.find import find

    try:
        path = find(name, named_by=benchmark.parent, data_path=tuple(data_path))
        if path is not None and path.suffix == ".py":
            return path
        reason = "it is not in the folder of the file, nor in those of --data-path"
        if path is not None:
            reason = "it is not a Python file (.py)"
    except (AssetNotFound, BadSetting) as error:
        reason = str(error)
    diagnostics = Diagnostics(benchmark)
    root = parse(benchmark, error=BenchmarkError).root
    diagnostics.error(root, f"u:plugin names {name[:100]!r}: {reason}")
    raise BenchmarkError(diagnostics.to_list())
