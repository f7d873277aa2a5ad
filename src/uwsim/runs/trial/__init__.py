"""One trial: a task at all its levels with one seed."""
