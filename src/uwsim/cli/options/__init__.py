"""Options that commands share, their completion and their help."""
