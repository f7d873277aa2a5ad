"""Files: input files and their hashes, file names, sources of Python code, caches on disk."""
