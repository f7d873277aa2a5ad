"""Results on disk: their content, and their reading and writing (without MuJoCo).

`result` is the content of ``result.json``, which `result_file` reads and writes; `journal` stores
the rows of each trial during a run; `provenance` holds the facts that may differ between runs with
the same result; `table` prints a result.
"""
