"""The texts of ``comparison.json`` and ``comparison.csv``, reproducible byte for byte.

.. code-block:: text

    first,second,scope,fog [1/m],n_pairs,n,first_mean,second_mean,difference,low,high,p_holm,...
    esm,ic,level,0.0,10,10,0.138,0.141,0.003,0.001,0.005,0.0527,...
    esm,ic,sweep,,10,10,0.42,0.48,0.06,0.02,0.11,0.0137,...

A line for each level of each pair of results, and one for the sweep as a whole. Differences are
second less first. ``docs/statistics.md`` says what every column means; an empty field says nothing.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping

from ...results.per_level import intervals_of, success_rates
from ...statistics import Interval
from .inputs import Entry
from .model import CONFIDENCE, POWER, AtLevel, Comparison, Overall, PairedDifference, Versus
from .repeats import ALPHA
from .sentences import sentences

FORMAT = "uwsim-comparison/1"

Fields = dict[str, object]


def json_text(comparison: Comparison) -> str:
    """Return the text of ``comparison.json``."""
    column = comparison.column
    baseline = comparison.baseline
    document = {
        "format": FORMAT,
        "measure": {"name": column.name, "unit": column.unit, "expression": column.expression},
        "better": "higher" if comparison.higher_is_better else "lower",
        "confidence": CONFIDENCE,
        "alpha": ALPHA,
        "power": POWER,
        "baseline": baseline.name if baseline else None,
        "differing_experiments": list(comparison.forced),
        "remarks": list(comparison.remarks),
        "results": [_entry(entry, column.name) for entry in comparison.entries],
        "pairs": [_versus(comparison, versus) for versus in comparison.versus],
    }
    return json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def csv_text(comparison: Comparison) -> str:
    """Return the text of ``comparison.csv``."""
    labels = [column.label for column in comparison.entries[0].result.columns_of_kind("level")]
    lines: list[tuple[list[object], Fields]] = []
    for versus in comparison.versus:
        names = [versus.first.name, versus.second.name]
        for at in versus.levels:
            lines.append(([*names, "level", *map(repr, at.level)], _level_fields(at)))
        lines.append(([*names, "sweep", *("" for _ in labels)], _overall_fields(versus.overall)))
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    leading, numbers = ["first", "second", "scope"], list(lines[0][1])
    taken = {*leading, *numbers}
    places = [f"{label} (level)" if label in taken else label for label in labels]
    writer.writerow([*leading, *places, *numbers])
    for led, fields in lines:
        writer.writerow([*led, *(_cell(fields[name]) for name in numbers)])
    return stream.getvalue()


def _cell(value: object) -> object:
    return "" if value is None else " ".join(map(str, value)) if isinstance(value, list) else value


# ---------------------------------------------------------------------------- parts


def _entry(entry: Entry, column: str) -> Fields:
    run = entry.result.run
    rates = success_rates(entry.result, confidence=CONFIDENCE)
    return {
        "name": entry.name,
        "directory": entry.source,
        "sha256": entry.sha256,
        **{
            key: _json_values(getattr(run, key))
            for key in ("algorithm", "parameters", "version", "mode")
        },
        "inputs": _json_values(entry.result.inputs.as_dict()),
        "levels": [
            {
                "level": list(at.level),
                "seeds": list(ended.seeds),
                **_interval(at.interval),
                "n_missing": at.n_missing,
                "n_ok": ended.success.successes if ended.success else None,
                "share_ok_low": ended.success.low if ended.success else None,
                "share_ok_high": ended.success.high if ended.success else None,
            }
            for at, ended in zip(
                intervals_of(entry.result, column, confidence=CONFIDENCE), rates, strict=True
            )
        ],
    }


def _versus(comparison: Comparison, versus: Versus) -> Fields:
    images = versus.same_images
    return {
        "first": versus.first.name,
        "second": versus.second.name,
        "words": list(sentences(comparison, versus)),
        "rows_only_first": versus.n_only_first,
        "rows_only_second": versus.n_only_second,
        "image_streams": None if images is None else {"shared": images[0], "same_bytes": images[1]},
        "sweep": {
            "levels": [list(level) for level in versus.overall.levels],
            "n_levels": versus.overall.n_levels,
            "levels_first_smaller": versus.overall.n_first_smaller,
            "levels_second_smaller": versus.overall.n_second_smaller,
            **_overall_fields(versus.overall),
        },
        "levels": [{"level": list(at.level), **_level_fields(at)} for at in versus.levels],
    }


def _level_fields(at: AtLevel) -> Fields:
    success = at.success
    return {
        "seeds": list(at.seeds),
        "n_pairs": len(at.seeds),
        "n_only_first": at.n_only_first,
        "n_only_second": at.n_only_second,
        "n_neither": at.n_neither,
        **_difference(at.value),
        "share_ok_first": success.first.value if success else None,
        "share_ok_first_low": success.first.low if success else None,
        "share_ok_first_high": success.first.high if success else None,
        "share_ok_second": success.second.value if success else None,
        "share_ok_second_low": success.second.low if success else None,
        "share_ok_second_high": success.second.high if success else None,
        "n_ok_only_first": success.first_only if success else None,
        "n_ok_only_second": success.second_only if success else None,
        "p_ok": success.p if success else None,
        "p_ok_holm": success.p_holm if success else None,
    }


def _overall_fields(overall: Overall) -> Fields:
    """The fields of a level, over the seeds: shares are means of the seeds' shares of levels."""
    ended = overall.success
    return {
        "seeds": list(overall.seeds),
        "n_pairs": len(overall.seeds),
        "n_only_first": None,
        "n_only_second": None,
        "n_neither": None,
        **_difference(overall.value),
        "share_ok_first": ended.first.mean if ended else None,
        "share_ok_first_low": ended.first.low if ended else None,
        "share_ok_first_high": ended.first.high if ended else None,
        "share_ok_second": ended.second.mean if ended else None,
        "share_ok_second_low": ended.second.low if ended else None,
        "share_ok_second_high": ended.second.high if ended else None,
        "n_ok_only_first": None,
        "n_ok_only_second": None,
        "p_ok": ended.p if ended else None,
        "p_ok_holm": ended.p_holm if ended else None,
    }


def _difference(d: PairedDifference) -> Fields:
    return {
        "n": d.difference.n,
        "first_mean": d.first.mean,
        "first_std": d.first.std,
        "first_low": d.first.low,
        "first_high": d.first.high,
        "second_mean": d.second.mean,
        "second_std": d.second.std,
        "second_low": d.second.low,
        "second_high": d.second.high,
        "difference": d.difference.mean,
        "difference_std": d.difference.std,
        "difference_low": d.difference.low,
        "difference_high": d.difference.high,
        "cohens_d": d.cohens_d,
        "hedges_g": d.hedges_g,
        "rank_biserial": d.rank_biserial,
        "vargha_delaney_a": d.superiority,
        "p_sign_flip": d.p,
        "p_signed_rank": d.p_signed_rank,
        "p_holm": d.p_holm,
        "repeats_needed": d.needed,
        "repeats_to_test": d.fewest,
        "verdict": d.verdict,
    }


def _interval(interval: Interval) -> Fields:
    names = ("n", "mean", "std", "low", "high")
    return {name: getattr(interval, name) for name in names}


def _json_values(value: object) -> object:
    if isinstance(value, Mapping):
        return {str(key): _json_values(v) for key, v in value.items()}
    if isinstance(value, tuple):
        return [_json_values(v) for v in value]
    return value
