"""Planning and executing runs: from benchmark, scene and algorithm to the files of a result.

In the order of ``uwsim bench``:

- `make_plan` reads and checks the files that a `plan_request` names, and returns a `plan`;
- `prepare` resolves all names, hashes all files, and returns a `run` with its directory;
- `executors` distribute the plan's trials, and `trial.trial` executes one, level by level;
- finished levels are written to `uwsim.results.journal`; `collect` makes the result of them.

``uwsim check`` is in `uwsim.checks`.
"""
