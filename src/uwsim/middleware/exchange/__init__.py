"""Parts of a bridge that exchange messages and calls between a bus and external programs."""
