// Provides: the water's surface around the camera, raised by the waves.
// Needs: surface_block.glsl, waves.glsl; vertices are offsets from the camera in the horizontal plane of W [m].
// The far plane is at infinity; with the switch DIRECT it is that of the camera.
#include "surface_block.glsl"
#include "waves.glsl"
in vec2 vertex;
out vec3 v_offset;

void main() {
    float variance;
    v_offset = vec3(vertex, waves_at(vertex, 0.0, variance).x - eye.x);
    gl_Position = clip_from_offset * vec4(v_offset, 1.0);
#ifndef DIRECT
    gl_Position.z = gl_Position.w - 2.0 * eye.y;
#endif
}
