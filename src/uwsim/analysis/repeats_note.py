"""A note at the start of a run: how many repeats a planned comparison needs."""

from __future__ import annotations


def repeats_note(n_results: int, n_levels: int, repeats: int) -> str | None:
    """Return the note of `uwsim bench` at the start; None where no comparison seems planned.

    One algorithm is planned for against one other.

    Args:
        n_results: algorithms that run together.
        n_levels: of the sweep.
        repeats: seeds of each.
    """
    is_alone = n_results < 2
    if is_alone and repeats == 1:
        return None
    from .comparison.repeats import fewest_repeats  # statistics take a second to load

    sweep, level = fewest_repeats(n_results, n_levels)
    if is_alone and repeats >= level:
        return None
    what = "comparing this result with one other" if is_alone else f"comparing {n_results} results"
    needs = f"needs at least {sweep} repeats"
    if n_levels > 1:
        needs += f" for the sweep as a whole and {level} for single levels"
    done = f"{repeats} repeat{'s' if repeats > 1 else ''} (--repeat)"
    enough = "enough for both" if n_levels > 1 else "enough"
    if repeats < sweep:
        enough = "too few"
    elif repeats < level:
        enough = "enough for the sweep alone"
    return f"note: {what} {needs}; {done}: {enough}."
