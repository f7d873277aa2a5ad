// Provides: the block Frame, what is the same for everything in one picture.
// Needs: nothing. Filled by renderer.FRAME, in this order.
// Camera frame: OpenGL axes (x right, y up, -z ahead), metres.
layout(std140) uniform Frame {
    mat4 clip_from_camera;
    mat4 shadow_from_camera;  // to texture coordinates and depth, 0..1
    vec4 up;                  // xyz: world's z axis in the camera frame; w: camera's height above the water [m]
    vec4 sun;                 // xyz: unit vector towards the sun, camera frame; w: lift against shadow acne [m]
    vec4 ambient;             // rgb, times the light rate
    vec4 diffuse;             // rgb, times the light rate
    vec4 specular;            // rgb, times the light rate
    vec4 water_colour;        // rgb, in-scattered light
    vec4 attenuation;         // rgb [1/m]
    vec4 fog_colour;          // rgb; w: density squared [1/m2]
    vec4 fog_distance;        // fog distance = x * range + y * planar depth + z
    vec4 background;          // rgb of what is infinitely far
};
