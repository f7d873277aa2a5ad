"""The tracks of suites: the topics that an algorithm under test may receive."""
