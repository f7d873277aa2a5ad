"""The texts of ``comparison.json`` and ``comparison.csv``, reproducible byte for byte.

.. code-block:: text

    first,second,scope,fog [1/m],...,first_mean,...,second_mean,...,difference,...,p_holm,...
    esm,ic,level,0.0,...,0.138,...,0.141,...,0.003,...,0.0527,...
    esm,ic,sweep,,...,0.42,...,0.48,...,0.06,...,0.0137,...

There is a line for each level of each pair of results, and a line for the sweep as a whole; most
columns are left out here. The columns after the level have the names of keys in
``comparison.json``, from ``seeds`` and ``n_pairs`` to ``p_ok_holm``. Results of a task have those
of ``times``, too, from ``time_median_first`` to ``p_time_log_rank``.
Differences are second minus first. ``docs/statistics.md`` defines every column. An empty field
means that there is no value.
"""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Mapping

from ...results.per_level import intervals_of, success_rates
from ...statistics import Interval, Rate
from .inputs import Entry
from .model import (
    CONFIDENCE,
    POWER,
    Comparison,
    LevelStatistics,
    LevelTimes,
    PairComparison,
    PairedDifference,
    PairTimes,
    SweepStatistics,
)
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
        "differing_experiments": list(comparison.experiment_differences),
        "remarks": list(comparison.remarks),
        "results": [_entry_fields(entry, column.name) for entry in comparison.entries],
        "pairs": [_pair_fields(comparison, pair) for pair in comparison.pairs],
    }
    return json.dumps(document, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def csv_text(comparison: Comparison) -> str:
    """Return the text of ``comparison.csv``."""
    labels = [column.label for column in comparison.entries[0].result.columns_of_kind("level")]
    has_times = any(pair.times is not None for pair in comparison.pairs)
    lines: list[tuple[list[object], Fields]] = []
    for pair in comparison.pairs:
        names = [pair.first.name, pair.second.name]
        level_times = {t.level: t for t in pair.times.levels} if pair.times else {}
        for stats in pair.levels:
            fields = _level_fields(stats)
            if has_times:
                fields |= _time_fields(level_times.get(stats.level))
            lines.append(([*names, "level", *map(repr, stats.level)], fields))
        fields = _sweep_fields(pair.sweep)
        if has_times:
            fields |= _sweep_time_fields(pair.times)
        lines.append(([*names, "sweep", *("" for _ in labels)], fields))
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    key_columns, number_columns = ["first", "second", "scope"], list(lines[0][1])
    used_names = {*key_columns, *number_columns}
    level_columns = [f"{label} (level)" if label in used_names else label for label in labels]
    writer.writerow([*key_columns, *level_columns, *number_columns])
    for key_cells, fields in lines:
        writer.writerow([*key_cells, *(_cell(fields[name]) for name in number_columns)])
    return stream.getvalue()


def _cell(value: object) -> object:
    return "" if value is None else " ".join(map(str, value)) if isinstance(value, list) else value


# ---------------------------------------------------------------------------- parts


def _entry_fields(entry: Entry, column: str) -> Fields:
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
                "level": list(level_interval.level),
                "seeds": list(level_rate.seeds),
                **_interval_fields("", level_interval.interval, "n", "mean", "std", "low", "high"),
                "n_missing": level_interval.n_missing,
                "n_ok": level_rate.success.successes if level_rate.success else None,
                "share_ok_low": level_rate.success.low if level_rate.success else None,
                "share_ok_high": level_rate.success.high if level_rate.success else None,
            }
            for level_interval, level_rate in zip(
                intervals_of(entry.result, column, confidence=CONFIDENCE), rates, strict=True
            )
        ],
    }


def _pair_fields(comparison: Comparison, pair: PairComparison) -> Fields:
    images = pair.same_images
    return {
        "first": pair.first.name,
        "second": pair.second.name,
        "words": list(sentences(comparison, pair)),
        "rows_only_first": pair.n_only_first,
        "rows_only_second": pair.n_only_second,
        "image_streams": None if images is None else {"shared": images[0], "same_bytes": images[1]},
        "sweep": {
            "levels": [list(level) for level in pair.sweep.levels],
            "n_levels": pair.sweep.n_levels,
            "levels_first_smaller": pair.sweep.n_first_smaller,
            "levels_second_smaller": pair.sweep.n_second_smaller,
            **_sweep_fields(pair.sweep),
        },
        "levels": [{"level": list(stats.level), **_level_fields(stats)} for stats in pair.levels],
        **(
            {
                "times": {
                    "limit": pair.times.limit,
                    "sweep": _time_difference_fields(pair.times.sweep),
                    "levels": [
                        {"level": list(times.level), **_time_fields(times)}
                        for times in pair.times.levels
                    ],
                }
            }
            if pair.times
            else {}
        ),
    }


def _level_fields(stats: LevelStatistics) -> Fields:
    success = stats.success
    return {
        "seeds": list(stats.seeds),
        "n_pairs": len(stats.seeds),
        "n_only_first": stats.n_only_first,
        "n_only_second": stats.n_only_second,
        "n_neither": stats.n_neither,
        **_difference_fields(stats.value),
        **_share_fields("first", success.first if success else None),
        **_share_fields("second", success.second if success else None),
        "n_ok_only_first": success.first_only if success else None,
        "n_ok_only_second": success.second_only if success else None,
        "p_ok": success.p if success else None,
        "p_ok_holm": success.p_holm if success else None,
    }


def _sweep_fields(sweep: SweepStatistics) -> Fields:
    """Return the fields of `_level_fields` for the whole sweep; rates are means over the seeds."""
    success = sweep.success
    return {
        "seeds": list(sweep.seeds),
        "n_pairs": len(sweep.seeds),
        "n_only_first": None,
        "n_only_second": None,
        "n_neither": None,
        **_difference_fields(sweep.value),
        **_share_fields("first", success.first if success else None),
        **_share_fields("second", success.second if success else None),
        "n_ok_only_first": None,
        "n_ok_only_second": None,
        "p_ok": success.p if success else None,
        "p_ok_holm": success.p_holm if success else None,
    }


def _time_fields(times: LevelTimes | None) -> Fields:
    """Return the fields of the times to success at a level; limits beyond all times are None."""
    fields: Fields = {}
    for name, curve in (("first", times and times.first), ("second", times and times.second)):
        median = curve and curve.median
        fields |= {
            f"time_median_{name}": median and median.value,
            f"time_median_{name}_low": _finite_limit(median.low) if median else None,
            f"time_median_{name}_high": _finite_limit(median.high) if median else None,
        }
    return {
        **fields,
        **_time_difference_fields(times.difference if times else None),
        "p_time_log_rank": times and times.p_log_rank,
    }


def _sweep_time_fields(times: PairTimes | None) -> Fields:
    """Return the fields of `_time_fields` for the whole sweep, which has no median."""
    return _time_fields(None) | _time_difference_fields(times.sweep if times else None)


def _time_difference_fields(d: PairedDifference | None) -> Fields:
    return {
        "time_n": d and d.difference.n,
        "time_first_mean": d and d.first.mean,
        "time_second_mean": d and d.second.mean,
        "time_difference": d and d.difference.mean,
        "time_difference_low": d and d.difference.low,
        "time_difference_high": d and d.difference.high,
        "p_time": d and d.p,
        "p_time_holm": d and d.p_holm,
        "time_verdict": d and d.verdict,
    }


def _finite_limit(limit: float | None) -> float | None:
    return None if limit is None or math.isinf(limit) else limit


def _difference_fields(d: PairedDifference) -> Fields:
    return {
        "n": d.difference.n,
        **_interval_fields("first_", d.first, "mean", "std", "low", "high"),
        **_interval_fields("second_", d.second, "mean", "std", "low", "high"),
        "difference": d.difference.mean,
        **_interval_fields("difference_", d.difference, "std", "low", "high"),
        "cohens_d": d.cohens_d,
        "hedges_g": d.hedges_g,
        "rank_biserial": d.rank_biserial,
        "vargha_delaney_a": d.superiority,
        "p_sign_flip": d.p,
        "p_signed_rank": d.p_signed_rank,
        "p_holm": d.p_holm,
        "repeats_needed": d.repeats_needed,
        "repeats_to_test": d.repeats_to_test,
        "verdict": d.verdict,
    }


def _interval_fields(prefix: str, interval: Interval, *names: str) -> Fields:
    return {f"{prefix}{name}": getattr(interval, name) for name in names}


def _share_fields(name: str, share: Rate | Interval | None) -> Fields:
    return {
        f"share_ok_{name}": share.value if isinstance(share, Rate) else share and share.mean,
        f"share_ok_{name}_low": share and share.low,
        f"share_ok_{name}_high": share and share.high,
    }


def _json_values(value: object) -> object:
    if isinstance(value, Mapping):
        return {str(key): _json_values(v) for key, v in value.items()}
    if isinstance(value, tuple):
        return [_json_values(v) for v in value]
    return value
