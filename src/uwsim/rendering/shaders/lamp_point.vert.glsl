// Provides: a point of 3 x 3 pixels where the camera sees a lamp.
// Needs: frame.glsl, lamps.glsl with LAMPS; a vertex for each lamp, without attributes.
// The depth is that of a point 0.1 m nearer, so that a lamp's own housing does not hide it.
#include "frame.glsl"
#include "lamps.glsl"
flat out vec3 v_position;  // of the lamp, camera frame [m]
flat out vec3 v_axis;
flat out vec4 v_light;     // rgb: intensity times colour; w: cosine at the edge of the cone
flat out float v_steepness;

void main() {
    int i = gl_VertexID;
    v_position = lamp_position[i].xyz;
    v_axis = lamp_axis[i].xyz;
    v_light = vec4(lamp_light[i].rgb, lamp_position[i].w);
    v_steepness = lamp_axis[i].w;
    gl_Position = clip_from_camera * vec4(v_position, 1.0);
    float range = max(length(v_position), 1e-3);
    vec4 nearer = clip_from_camera * vec4(v_position * max(1.0 - 0.1 / range, 0.5), 1.0);
    if (gl_Position.w > 0.0 && nearer.w > 0.0) gl_Position.z = nearer.z / nearer.w * gl_Position.w;
    gl_PointSize = 3.0;
}
