"""Suites of tasks: the tasks of a leaderboard, their runs, submissions and their verification."""
