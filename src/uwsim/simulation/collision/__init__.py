"""Contacts of a running scene, and bodies that begin in the ground or pass through it."""
