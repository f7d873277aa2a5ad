"""What touches what in the engine: contacts, also of kinematic vehicles, and a tree of shapes."""
