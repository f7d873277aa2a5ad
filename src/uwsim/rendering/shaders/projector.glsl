// Provides: the block Projector: the projector of a pattern.
// Needs: nothing. Filled by projector_light.py, declared there too.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Projector {
    mat4 projector_from_camera;  // to texture coordinates and depth in its map, times w
    vec4 projector_place;        // xyz [m]; w: 1 laser, 0 lamp
    vec4 projector_axis;         // xyz: against the light; w: lift against acne per metre [1]
};
