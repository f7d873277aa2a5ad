// Provides: the block Lamps: the lamps of the vehicles.
// Needs: the switch LAMPS, the number of lamps, 1..4. Filled by lamps.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Lamps {
    mat4[4] lamp_from_camera;  // to homogeneous texture coordinates and depth in the shadow maps
    vec4[4] lamp_position;     // xyz [m]; w: cosine at the edge of the cone
    vec4[4] lamp_axis;         // xyz: opposite to the beam; w: factor from cosines inside the edge to 0..1
    vec4[4] lamp_light;        // rgb: intensity times colour; w: offset along normals against self-shadowing, per metre of distance [1]
};
