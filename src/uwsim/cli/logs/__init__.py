"""Commands that read logs of real vehicles: one module for each command, or part of one."""
