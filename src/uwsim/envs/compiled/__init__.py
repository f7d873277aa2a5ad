"""Episodes of a benchmark in rows of free vehicles, whose steps are compiled code.

`numbers` has what the compiled code reads and writes, `kernel` the code, `draws` what a seed draws
at the beginning of an episode, and `episodes` the rows together. The physics are those of
`uwsim.envs.batch`. One environment is the only row of such a batch.
"""
