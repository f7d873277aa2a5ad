"""Materials in the shaders: maps of normals and finish, and the reflectance of rough surfaces."""
