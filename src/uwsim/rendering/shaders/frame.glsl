// Provides: the block Frame: values that are constant in an image.
// Needs: nothing. Filled by frame.py, where the same members are declared.
// Camera frame: OpenGL axes (x right, y up, -z ahead), metres.
layout(std140) uniform Frame {
    mat4 clip_from_camera;
    mat4 shadow_from_camera;  // to texture coordinates and depth, 0..1
    vec4 up;                  // xyz: W's z axis, camera frame; w: camera's height above the water [m]
    vec4 sun;                 // xyz: towards the sun, camera frame; w: offset along normals against self-shadowing [m]
    vec4 sunlight;            // rgb: colour of the sun times the light rate
    vec4 ambient_specular;    // x: ambient, y: specular brightness, both times the light rate
    vec4 water_colour;        // rgb: colour of in-scattered light
    vec4 attenuation;         // rgb [1/m]
    vec4 fog;                 // rgb: colour; w: density squared [1/m2]
    vec4 clip_fog;            // clip-space z, the distance in UWSim's fog = x * planar depth + y [m]
    vec4 background;          // rgb: colour of pixels without a surface
};
