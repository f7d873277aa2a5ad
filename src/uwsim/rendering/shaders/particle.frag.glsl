// Provides: coverage D (J - B) of a particle, and its coverage as alpha; the renderer draws it over those behind.
// Needs: optics.glsl, open_water.glsl; the outputs of particle.vert.glsl; the image of the surfaces.
// J: radiance of the particle, B: of open water behind it, D = exp(-c r). Nearer surfaces hide it.
#include "optics.glsl"
#include "open_water.glsl"
uniform sampler2D surface_image;
flat in vec4 v_light;
flat in vec4 v_shape;
noperspective in vec2 v_offset;
out vec4 colour_out;

void main() {
    vec2 inner = v_offset / v_shape.xy;
    float square = dot(inner, inner);
    float inside = 1.0 - square;
    if (inside <= 0.0) discard;
    float range = texelFetch(surface_image, ivec2(gl_FragCoord.xy), 0).a;
    if (range < v_light.a) discard;
    float profile = 3.0 * inside * inside;
    // the rim of a bubble is seen if its image is large enough
    if (v_shape.w > 0.5) profile = mix(profile, 30.0 * square * square * inside * inside, clamp(0.5 * v_shape.y - 1.0, 0.0, 0.85));
    float coverage = min(v_shape.z * profile, 1.0);
    vec3 water = open_water(gl_FragCoord.xy, vec2(textureSize(surface_image, 0)));
    vec3 direct = exp((absorption.rgb + scattering.rgb) * -v_light.a);
    colour_out = vec4(coverage * direct * (v_light.rgb - water), coverage);
}
