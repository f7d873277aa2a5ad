"""``--algorithm scripted:RESULT``: the pilot of an earlier result, whose inputs are sent again."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ...errors import BadSetting
from ...results import journal
from ...results.result_file import load
from .plan_request import PlanRequest

PREFIX = "scripted:"
PILOT = "pilot"
ALGORITHM_PREFIX = "algorithm."


def with_stored_pilot(request: PlanRequest) -> tuple[PlanRequest, dict[int, bytes]]:
    """Return the request with the algorithm `pilot`, and the stored inputs by index of the trial.

    A request for another algorithm is returned unchanged. The parameters of the earlier run are
    used, unless the request sets parameters.

    Raises:
        BadSetting: the result holds no inputs of a pilot.
        ResultError: there is no such result.
    """
    name = request.algorithm or ""
    if not name.startswith(PREFIX) or request.algorithm_class is not None:
        return request, {}
    path = Path(name.removeprefix(PREFIX))
    directory = path.parent if path.name == "result.json" else path
    run = load(directory).run
    files = sorted((directory / journal.FOLDER).glob(f"*{journal.INPUTS}"))
    if run.algorithm != PILOT or not files:
        raise BadSetting(f"--algorithm {name}: holds no inputs of a pilot (--algorithm {PILOT}).")
    settings = list(request.settings)
    if not any(setting.startswith(ALGORITHM_PREFIX) for setting in settings):
        settings += [p for p in run.pairs_of_settings if p.startswith(ALGORITHM_PREFIX)]
    pilot_request = replace(request, algorithm=PILOT, settings=settings)
    return pilot_request, {int(file.stem): file.read_bytes() for file in files}
