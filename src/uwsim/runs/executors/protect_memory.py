"""A module whose import denies other processes access to this one's memory (`ProtectedForks`)."""

from ...results.seal import deny_access_to_memory

deny_access_to_memory()
