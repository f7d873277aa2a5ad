"""From a command line or a call to the plan of a run."""
