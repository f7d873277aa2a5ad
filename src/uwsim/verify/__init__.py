"""Verification of stored results: trials are run again and compared with them byte for byte."""
