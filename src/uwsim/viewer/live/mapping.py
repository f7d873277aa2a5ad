"""The mapping of keys, gamepad and on-screen sticks to the axes of a pilot.

The axes are `uwsim.algorithms.pilot.AXES`. A user's mapping file replaces parts of the default. A
list replaces the default list; ``[keys]`` replaces the targets of the keys that it names:

.. code-block:: toml

    dead_zone = 0.08
    axes = ["yaw", "-heave", "sway", "-surge"]      # for the gamepad's axes 0 to 3
    buttons = ["", "", "", "", "", "", "-jaw", "+jaw"]
    sticks = ["yaw", "heave", "sway", "surge"]      # on-screen sticks: left x, y, right x, y

    [keys]
    z = "+thruster1 -thruster2"                     # several axes at once
    q = ""                                          # no effect
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from ...algorithms.pilot import AXES
from ...errors import BadSetting, did_you_mean

KEYS = {
    **{"w": "+surge", "s": "-surge", "d": "+sway", "a": "-sway", "e": "+yaw", "q": "-yaw"},
    **{"r": "+heave", "v": "-heave", "t": "+joint1", "g": "-joint1", "y": "+joint2"},
    **{"h": "-joint2", "u": "+joint3", "j": "-joint3", "i": "+joint4", "k": "-joint4"},
    **{"o": "+jaw", "l": "-jaw", "m": "+lamps", "n": "-lamps", "5": "+arm", "6": "-arm"},
    **{"7": "+mode1", "8": "+mode2", "9": "+mode3", "0": "+mode4"},
}
"""The default targets of each key; the page's own functions of these letters require Shift, while a
pilot is accepted."""


@dataclass(frozen=True, kw_only=True)
class PilotMapping:
    """The targets of each key, gamepad axis, button and stick.

    A target is an axis of the pilot with an optional sign, as ``-heave``. Several targets are
    separated by blanks; an empty text means that the input has no effect.
    """

    keys: Mapping[str, str] = field(default_factory=lambda: KEYS)
    """The targets of each key; a key has the browser's name in lower case."""
    axes: tuple[str, ...] = ("yaw", "-heave", "sway", "-surge")
    """The targets of the gamepad's axes, in the gamepad's order."""
    buttons: tuple[str, ...] = ("", "", "", "", "", "", "-jaw", "+jaw")
    """The targets of the gamepad's buttons, in the gamepad's order."""
    sticks: tuple[str, ...] = ("yaw", "heave", "sway", "surge")
    """The targets of the on-screen sticks: left x, left y, right x, right y."""
    dead_zone: float = 0.08
    """The absolute value up to which an input of gamepad or sticks counts as 0 [1]."""

    def values(self, message: Mapping[str, Any]) -> tuple[float, ...]:
        """Return the value of each of the pilot's axes, -1..1, for an input message of the page.

        Invalid inputs count as 0.
        """
        total = dict.fromkeys(AXES, 0.0)
        keys = message.get("keys")
        for key in keys[:32] if isinstance(keys, list) else ():
            if isinstance(key, str) and key in self.keys:
                _add(total, self.keys[key], 1.0)
        for name in ("axes", "buttons", "sticks"):
            numbers = message.get(name)
            for target, number in zip(
                getattr(self, name), numbers if isinstance(numbers, list) else (), strict=False
            ):
                if target and abs(value := _number(number)) > self.dead_zone:
                    _add(total, target, value)
        return tuple(min(1.0, max(-1.0, total[axis])) for axis in AXES)


def read_mapping(path: Path) -> PilotMapping:
    """Read a mapping file; a setting or a key that is missing in the file has its default.

    Raises:
        BadSetting: the file cannot be read, or has an invalid setting.
    """
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except RecursionError:
        raise BadSetting(f"--pilot-mapping {path}: lists are nested too deeply.") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise BadSetting(f"--pilot-mapping {path}: the file cannot be read: {reason}.") from None
    names = [entry.name for entry in fields(PilotMapping)]
    for name, value in table.items():
        if name not in names:
            near = did_you_mean(name, names)
            raise BadSetting(f"--pilot-mapping {path}: {name!r} is not a setting.{near}")
        _check(path, name, value)
    settings: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in table.items()}
    settings["keys"] = KEYS | table.get("keys", {})
    return PilotMapping(**settings)


def _check(path: Path, name: str, value: object) -> None:
    if name == "dead_zone":
        if not isinstance(value, int | float) or not 0.0 <= value < 1.0:
            raise BadSetting(f"--pilot-mapping {path}: dead_zone is {value!r}; expected 0 to 1.")
        return
    targets = list(value.values()) if isinstance(value, dict) else value
    if isinstance(value, dict) != (name == "keys") or not isinstance(targets, list):
        raise BadSetting(f"--pilot-mapping {path}: {name} is {value!r}; see docs/piloting.md.")
    for target in targets:
        if not isinstance(target, str):
            raise BadSetting(
                f"--pilot-mapping {path}: {name} has {repr(target)[:60]}; expected the names of "
                "axes in quotation marks."
            )
    for target in " ".join(targets).split():
        axis = target.removeprefix("-").removeprefix("+")
        if axis not in AXES:
            raise BadSetting(
                f"--pilot-mapping {path}: {name}: no axis is called {target!r}."
                f"{did_you_mean(axis, AXES)} Axes: {', '.join(AXES)}."
            )


def _add(total: dict[str, float], targets: str, value: float) -> None:
    for target in targets.split():
        total[target.lstrip("+-")] += -value if target.startswith("-") else value


def _number(value: object) -> float:
    """Return a number from a page, clipped to -1..1; 0 if the value is not a number."""
    if isinstance(value, bool) or not isinstance(value, int | float) or value != value:
        return 0.0
    return float(min(1, max(-1, value)))


def sum_inputs(inputs: Mapping[int, Sequence[float]]) -> tuple[float, ...] | None:
    """Return the sum of the inputs of all viewers for each axis, clipped to -1..1.

    Args:
        inputs: the values of the pilot's axes, by the viewer's id.

    Returns:
        None if there are no inputs.
    """
    if not inputs:
        return None
    sums = [sum(column) for column in zip(*inputs.values(), strict=True)]
    return tuple(min(1.0, max(-1.0, value)) for value in sums)
