"""The note at the start of a run on the repeats that a comparison needs."""

from __future__ import annotations


def repeats_note(n_results: int, n_levels: int, repeats: int) -> str | None:
    """Return the note at the start of `uwsim bench`; None for one algorithm with one repeat.

    For one algorithm, the note is about the comparison of its result with one other result.

    Args:
        n_results: the number of algorithms that run together.
        n_levels: the number of levels of the sweep.
        repeats: the number of repeats (seeds) of each algorithm.
    """
    is_single = n_results < 2
    if is_single and repeats == 1:
        return None
    from .comparison.repeats import min_repeats  # statistics take a second to load

    sweep_repeats, level_repeats = min_repeats(n_results, n_levels)
    if is_single and repeats >= level_repeats:
        return None
    plan = "comparing this result with one other" if is_single else f"comparing {n_results} results"
    need_text = f"needs at least {sweep_repeats} repeats"
    if n_levels > 1:
        need_text += f" for the sweep as a whole and {level_repeats} for single levels"
    repeats_text = f"{repeats} repeat{'s' if repeats > 1 else ''} (--repeat)"
    verdict = "enough for both" if n_levels > 1 else "enough"
    if repeats < sweep_repeats:
        verdict = "too few"
    elif repeats < level_repeats:
        verdict = "enough for the sweep alone"
    return f"note: {plan} {need_text}; {repeats_text}: {verdict}."
