"""One trial: a task at all its levels with one seed.

`trial` has the loop over the levels, `level_triggers` their beginning and end, `triggered_measure`
a measure between its triggers, `status` the algorithm's status, `level_row` the values to store.
"""
