// Provides: the water's surface around the camera, raised by the waves.
// Needs: surface_block.glsl, surface_varyings.glsl, waves.glsl, open_water.glsl without the switch ABOVE; vertices are offsets from the camera in the horizontal plane of W [m].
// The far plane is at infinity; with the switch DIRECT it is that of the camera.
#include "surface_block.glsl"
#define VARYING out
#include "surface_varyings.glsl"
#include "waves.glsl"
#ifndef ABOVE
#include "open_water.glsl"
out vec3 v_open_water;  // behind the surface; even enough to be interpolated
#endif
in vec2 vertex;
out vec3 v_offset;

void main() {
    pass_on_surface();
    float variance;
    v_offset = vec3(vertex, waves_at(vertex, 0.0, variance).x - eye.x);
    gl_Position = clip_from_offset * vec4(v_offset, 1.0);
#ifndef ABOVE
    vec2 place = gl_Position.xy / max(gl_Position.w, 1e-3) * 0.5 + 0.5;
    v_open_water = open_water(clamp(place, 0.0, 1.0) * image_size.xy, image_size.xy);
#endif
#ifndef DIRECT
    gl_Position.z = gl_Position.w - 2.0 * eye.y;
#endif
}
