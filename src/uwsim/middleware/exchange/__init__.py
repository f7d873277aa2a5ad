"""Parts of a bridge: what is exchanged between a bus and those outside."""
