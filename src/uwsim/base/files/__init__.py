"""Files: what was read and its hash, names, sources of Python code, caches on disk."""
