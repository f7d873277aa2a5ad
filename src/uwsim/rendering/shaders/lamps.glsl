// Provides: the block Lamps: the lamps of the vehicles.
// Needs: the switch LAMPS, how many of the four there are. Filled by lamps.py, declared there too.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Lamps {
    mat4[4] lamp_from_camera;  // to texture coordinates and depth in the maps, times w
    vec4[4] lamp_place;        // xyz [m]; w: cosine at the edge of the cone
    vec4[4] lamp_axis;         // xyz: against the light; w: cosine beyond the edge to 0..1
    vec4[4] lamp_light;        // rgb: intensity times colour; w: lift against acne per metre [1]
};
