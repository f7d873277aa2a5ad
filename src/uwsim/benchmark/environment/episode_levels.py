"""The levels from which an episode is drawn: ``<episodeLevels>``.

.. code-block:: xml

    <episodeLevels> <name>current</name> <values>0 0.1 0.2 0.3</values> </episodeLevels>

A benchmark may have levels that no algorithm passes. Episodes for learning need not begin there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ...errors import did_you_mean
from ...schema import Numbers, Spec
from ..updaters import SceneUpdaterSpec, chain, swept_parameters

TOLERANCE = 1e-9
"""The greatest difference of a value from the level that it names."""


@dataclass(frozen=True, kw_only=True)
class EpisodeLevelsSpec(Spec):
    """An ``<episodeLevels>`` element: the levels of a parameter that an episode is drawn from."""

    name: str
    """The name of the swept parameter, as ``current``."""
    values: Numbers
    """The levels, in the unit of the parameter."""

    def includes(self, level: float) -> bool:
        """Return whether an episode may have a level."""
        return any(abs(value - level) < TOLERANCE for value in self.values)


def drawn_values(
    updater: SceneUpdaterSpec, selections: Sequence[EpisodeLevelsSpec]
) -> dict[str, tuple[float, ...]]:
    """Return the values of each swept parameter from which an episode is drawn.

    They are the levels in one of the parameter's selections, or all levels if it has none.
    """
    values = {}
    for name, levels in _sweeps(updater).items():
        own_selections = [item for item in selections if item.name == name]
        values[name] = tuple(
            level
            for level in levels
            if not own_selections or any(item.includes(level) for item in own_selections)
        )
    return values


def selection_errors(
    updater: SceneUpdaterSpec, selections: Sequence[EpisodeLevelsSpec]
) -> Iterator[str]:
    """Yield the errors of selections: unknown parameters, repeated ones, and unknown levels."""
    sweeps = _sweeps(updater)
    names = [item.name for item in selections]
    for i, item in enumerate(selections):
        if item.name not in sweeps:
            yield (
                f"<episodeLevels> names {item.name[:60]!r}.{did_you_mean(item.name, list(sweeps))} "
                f"Known: {', '.join(sweeps)}"
            )
            continue
        if item.name in names[:i]:
            yield f"two <episodeLevels> have the name {item.name!r}; expected one"
        if not item.values:
            yield f"<values> of {item.name!r} is empty; expected a level at least"
        for value in item.values:
            closest_level = min(sweeps[item.name], key=lambda level: abs(level - value))
            if abs(closest_level - value) >= TOLERANCE:
                yield (
                    f"<values>: {value:.12g} is not a level of {item.name!r}; the nearest is "
                    f"{closest_level:.12g}"
                )


def _sweeps(updater: SceneUpdaterSpec) -> dict[str, tuple[float, ...]]:
    """Return the levels of each swept parameter."""
    names = swept_parameters(updater)
    return {name: spec.values() for name, spec in zip(names, chain(updater), strict=True)}
