// Provides: light shafts: what the waves add to the sun's light that the water scatters into the camera, or take from it.
// Needs: frame.glsl, optics.glsl, caustics_block.glsl, caustics.glsl with MAP_LEVEL; the image of the surfaces; the switches
// RATIO, the edge of a texel in pixels, N_STEPS, and MAP_PERCENT, the edge of a mean of the map in percent of a step.
// b pi E_b / mu p(Theta) integral of exp(-c* t) (G - 1) over the way t in water: caustics/light_shafts.py.
#include "frame.glsl"
#include "optics.glsl"
#include "caustics_block.glsl"
#include "caustics.glsl"
uniform sampler2D surface_image;
out vec4 colour_out;

void main() {
    vec2 pixel = float(RATIO) * gl_FragCoord.xy;
    ivec2 last = textureSize(surface_image, 0) - 1;
    float range = texelFetch(surface_image, min(ivec2(pixel), last), 0).a;
    vec3 ray = ray_first.xyz + pixel.x * ray_column.xyz + pixel.y * ray_row.xyz;
    float unit = inversesqrt(dot(ray, ray));
    ray *= unit;
    float depth = -up.w;
    float rise = dot(ray, up.xyz);
    vec3 loss = sun_loss.rgb * upwelling.w;  // c*
    float length = min(range, shaft_numbers.z);
    float surface_range = depth / max(rise, 1e-4);
    float ratio = rise > 0.0 && range > 0.8 * surface_range ? caustic_loss.w : 3.0;  // a body hides the sun's aureole
    if (rise > 0.0) length = min(length, surface_range);
    if (depth <= 0.0 || length <= 0.0) {
        colour_out = vec4(0.0);
        return;
    }
    vec2 start = vec2(caustic_x.w, caustic_y.w);
    vec2 drift = vec2(dot(ray, caustic_x.xyz), dot(ray, caustic_y.xyz));
    float speed = max(sqrt(dot(drift, drift)), 1e-4);  // across the beams [tiles/m]
    float longest = shaft_numbers.z * swell_frame.w / speed;
    float step_texels = speed * shaft_numbers.w;  // for each metre
    float pixel_texels = float(RATIO) * ray_column.x * unit * swell_frame.w * shaft_numbers.w;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < N_STEPS; ++i) {
        vec2 shares = vec2(i, i + 1) / float(N_STEPS);
        vec2 ends = longest * shares * shares;
        float width = min(ends.y, length) - ends.x;
        if (width <= 0.0) break;
        float way = ends.x + 0.5 * width;
        float map_level = log2(max(max(0.01 * float(MAP_PERCENT) * step_texels * width, pixel_texels * way), 1.0));
        float sample_depth = depth - rise * way;
        float excess = caustic_excess(start + drift * way, sample_depth, caustic_depths, swell_frame, map_level);
        sum += exp(loss * -way - (sun_loss.rgb + caustic_loss.rgb) * max(sample_depth, 0.0)) * (excess * width);
    }
    float cosine = dot(ray, sun.xyz);
    float q = sqrt(sqrt(max(0.5 - 0.5 * cosine, 1e-4)));
    vec4 high = phase_high;
    vec4 low = phase_low;
    float log_phase = ((high.w * q + high.z) * q + high.y) * q + high.x;
    log_phase = (((log_phase * q + low.w) * q + low.z) * q + low.y) * q + low.x;
    float g = shaft_numbers.x;
    float root = sqrt(max(1.0 + g * g - 2.0 * g * cosine, 1e-6));
    float scaled_phase = shaft_numbers.y * (1.0 - g * g) / (12.566371 * root * root * root);  // p* b* / b
    float phase = min(exp(log_phase), ratio * scaled_phase);
    colour_out = vec4(sun_beam.rgb * scattering.rgb * sum * (phase * 3.1415927 / upwelling.w), 0.0);
}
