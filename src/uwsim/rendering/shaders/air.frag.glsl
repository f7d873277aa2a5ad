// Provides: the image of surfaces, radiance and range in water, without the water's surface: bodies, and the sky above it.
// Needs: optics.glsl, surface_block.glsl, waves.glsl, sky.glsl; the image of the surfaces, whose alpha is the whole range.
// Pixels that begin in air have the range 0 in water; the sea is drawn before, by water_surface.frag.glsl.
#include "optics.glsl"
#include "surface_block.glsl"
#include "waves.glsl"
#include "sky.glsl"
uniform sampler2D surface_image;
out vec4 light_out;

void main() {
    vec4 texel = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0);
    vec3 ray = mat3(world_from_ray) * (ray_first.xyz + gl_FragCoord.x * ray_column.xyz + gl_FragCoord.y * ray_row.xyz);
    float height = eye.x + eye.y * ray.z;
#ifdef WAVES
    float variance;
    if (abs(height) < bounds.x) height -= waves_at(eye.y * ray.xy, 0.0, variance).x;
#endif
    light_out = texel;
    if (height <= 0.0) return;
    vec3 direction = normalize(ray);
    bool is_body = texel.a < 0.5 * FAR;
    vec3 light = sky_in(is_body ? vec3(direction.xy, -1.0) : direction);
    light = is_body ? mix(light, texel.rgb, exp(-air.x * texel.a)) : light + sun_in(direction, 0.0);
    light_out = vec4(light, 0.0);
}
