// Provides: one triangle over the whole target, with the place of each texel in the wider levels, and the numbers of the lamps.
// Needs: the textures and the switches of blurred.frag.glsl; with LAMPS: optics.glsl, lamps.glsl, veil_varyings.glsl.
// Rays of the first level, which has half the resolution, are linear over the image.
#ifdef LAMPS
#define VARYING out
#include "optics.glsl"
#include "lamps.glsl"
#include "veil_varyings.glsl"
uniform sampler2D level_2;
noperspective out vec2 v_ray;  // slopes of the ray, camera frame
#endif
#ifdef WIDER
uniform sampler2D level_0;
uniform sampler2D level_1;
noperspective out vec2 v_wider_place;
#endif

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    gl_Position = vec4(corner, 0.0, 1.0);
#ifdef WIDER
    v_wider_place = (0.25 * corner + 0.25) * vec2(textureSize(level_0, 0)) / vec2(textureSize(level_1, 0));
#endif
#ifdef LAMPS
    vec2 pixel = (corner + 1.0) * vec2(textureSize(level_2, 0));
    v_ray = ray_first.xy + pixel.x * ray_column.xy + pixel.y * ray_row.xy;
    pass_on_lamps();
#endif
}
