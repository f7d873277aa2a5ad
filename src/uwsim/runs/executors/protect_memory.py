"""The import of this module closes the memory of the process to others (`ProtectedForks`)."""

from ...results.seal import deny_access_to_memory

deny_access_to_memory()
