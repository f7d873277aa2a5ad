"""The measures that judge what an algorithm reports of its surroundings, one module each."""
