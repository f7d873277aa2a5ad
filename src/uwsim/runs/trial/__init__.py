"""The execution of one trial: one algorithm, one seed, and the levels of a benchmark.

`trial` has the loop over the levels, `level_triggers` the triggers that begin and end a level,
`triggered_measure` a measure with its triggers, `status` the status of a level, and `level_row` the
values to store.
"""
