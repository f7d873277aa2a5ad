"""Contacts of a running scene; checks for bodies that begin in the ground or fall through it."""
