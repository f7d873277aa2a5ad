"""Files: input files with their hashes, names, sources of Python code, caches on disk."""
