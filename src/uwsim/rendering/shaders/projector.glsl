// Provides: the block Projector: the projector of a pattern.
// Needs: nothing. Filled by projector_light.py, where the same members are declared.
// Camera frame: OpenGL axes, metres.
layout(std140) uniform Projector {
    mat4 projector_from_camera;  // to homogeneous texture coordinates and depth in the shadow map
    vec4 projector_position;     // xyz [m]; w: 1 laser, 0 lamp
    vec4 projector_axis;         // xyz: opposite to the beam; w: offset along normals against self-shadowing, per metre of distance [1]
};
