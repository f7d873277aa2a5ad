"""Writing of an imported world: scene file, robot files, hydrodynamics files, meshes."""
