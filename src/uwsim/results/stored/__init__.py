"""The expected shapes of stored values, checked as they are read."""
