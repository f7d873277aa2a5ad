// Provides: the optical depth of a lump of a cloud up to four ranges, and its light; the renderer adds them up.
// Needs: frame.glsl, optics.glsl, clouds.glsl, open_water.glsl; lamps.glsl with LAMPS; the outputs of cloud.vert.glsl.
// Closed form of a Gaussian along a ray: particles/puffs.py; the light: physical/cloud_pass.py.
#include "frame.glsl"
#include "optics.glsl"
#include "clouds.glsl"
#include "cloud_edge.glsl"
#include "open_water.glsl"
#ifdef LAMPS
#include "lamps.glsl"
#endif
uniform sampler2D surface_image;
flat in vec4 v_place;
flat in float v_depth;
layout(location = 0) out vec4 layers_out;    // optical depth up to each layer
layout(location = 1) out vec4 lamplight_out; // rgb: optical depth times lamplight scattered once; a: optical depth
layout(location = 2) out vec4 daylight_out;  // rgb: optical depth times excess of daylight over open water

vec4 error_function(vec4 x) {  // Abramowitz and Stegun 7.1.27, to 5e-4
    vec4 t = abs(x);
    vec4 root = 1.0 + t * (0.278393 + t * (0.230389 + t * (0.000972 + t * 0.078108)));
    root *= root;
    return sign(x) * (1.0 - 1.0 / (root * root));
}

#ifdef LAMPS
float phase(float cosine) {
    float q = sqrt(sqrt(clamp(0.5 - 0.5 * cosine, 0.0, 1.0)));
    float sum = phase_high.w;
    sum = sum * q + phase_high.z;
    sum = sum * q + phase_high.y;
    sum = sum * q + phase_high.x;
    sum = sum * q + phase_low.w;
    sum = sum * q + phase_low.z;
    sum = sum * q + phase_low.y;
    return exp(sum * q + phase_low.x);
}
#endif

void main() {
    vec2 size = vec2(textureSize(surface_image, 0));
    vec2 pixel = float(CLOUD_EDGE) * gl_FragCoord.xy;
    vec3 ray = normalize(ray_first.xyz + pixel.x * ray_column.xyz + pixel.y * ray_row.xyz);
    float foot = dot(ray, v_place.xyz);
    vec3 offset = v_place.xyz - foot * ray;
    float inverse = 0.70710678 / v_place.w;
    float peak = 0.5 * v_depth * exp(-dot(offset, offset) * inverse * inverse);
    if (peak < 1e-5) discard;
    vec4 ranges = cloud_layers.x + cloud_layers.y * vec4(0.0, 1.0, 2.0, 3.0);
    float begin = error_function(vec4(-foot * inverse)).x;
    vec4 depths = peak * max(error_function((ranges - foot) * inverse) - begin, 0.0);
    float total = peak * max(1.0 - begin, 0.0);
    float middle = max(foot, 0.5 * v_place.w);
    vec3 point = middle * ray;
    vec3 loss = absorption.rgb + 0.03 * scattering.rgb;  // c - 0.97 b, as in lamp_veil.glsl
    vec3 kept = exp(loss * -middle);
    float z = max(-(dot(point, up.xyz) + up.w), 0.0);
    vec3 day = cloud_colour.rgb * daylight_total.rgb * exp(daylight_loss.rgb * -z);
    vec3 sum = vec3(0.0);
#ifdef LAMPS
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - point;
        float distance = max(length(towards), max(0.5 * v_place.w, 0.1));
        vec3 direction = towards / distance;
        float cone = lamp_position[i].w > -1.0
            ? clamp((dot(lamp_axis[i].xyz, direction) - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0) : 1.0;
        float part = 3.14159265 * phase(dot(direction, ray)) * cone * cone * (3.0 - 2.0 * cone) / (distance * distance);
        sum += lamp_light[i].rgb * exp(loss * -distance) * part;
    }
    sum *= cloud_colour.rgb / max(max(cloud_colour.r, cloud_colour.g), max(cloud_colour.b, 1e-3));
#endif
    layers_out = depths;
    lamplight_out = vec4(total * kept * sum, total);
    daylight_out = vec4(total * kept * (day - open_water(pixel, size)), 0.0);
}
