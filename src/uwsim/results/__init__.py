"""Results on disk; read and written without MuJoCo.

`result` is the content of ``result.json``, which `result_file` reads and writes; `journal` keeps
the rows of each trial while a run lasts; `provenance` has what may differ between equal runs,
`table` the printed table.
"""
