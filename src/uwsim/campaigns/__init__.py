"""Campaigns: the trials of one benchmark divided among processes that share a folder, and merged.

A campaign is a list of trials, a pure function of files and seeds. Each shard runs its part of the
list; no process knows of another, and there are no locks. `merge` writes the result, whose bytes
are those of a run on one machine.
"""
