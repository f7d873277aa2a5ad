// Provides: the rectangle around the image of a particle, and the light D (J - B) that it adds to open water.
// Needs: frame.glsl, optics.glsl, open_water.glsl, particle_lens.glsl; lamps.glsl with LAMPS; four vertices for each instance, a record of PARTICLE.
// The radiance J is rho (E_sun + 2 E_down + 2 E_up + sum of E_lamp): physical/particle_pass.py.
#include "frame.glsl"
#include "optics.glsl"
#include "open_water.glsl"
#include "particle_lens.glsl"
#ifdef LAMPS
#include "lamps.glsl"
uniform sampler2DShadow lamp_maps;
#endif
uniform sampler2D surface_image;
in vec4 place;   // xyz: camera frame [m]; w: radius [m]
in vec4 extent;  // xyz: motion during the exposure and own length, camera frame [m]; w: share that is drawn
in vec2 traits;  // x: reflectance; y: kind
flat out vec4 v_light;   // rgb: light; a: range [m]
flat out vec4 v_shape;   // x, y: half the length and the width [px]; z: coverage; w: kind
noperspective out vec2 v_offset;  // along and across the streak [px]

vec2 pixel_of(vec3 point) {
    vec2 slope = point.xy / max(-point.z, 0.01) - ray_first.xy;
    float row = slope.y / ray_row.y;
    return vec2((slope.x - row * ray_row.x) / ray_column.x, row);
}

vec3 lit(vec3 point) {
    float z = max(-(dot(point, up.xyz) + up.w), 0.0);
    vec3 total = daylight_total.rgb * exp(daylight_loss.rgb * -z);
    vec3 level = min(sun_beam.rgb * exp(sun_loss.rgb * -z), total);
    vec3 sum = level / upwelling.w + 2.0 * (total - level) + 2.0 * upwelling.rgb * total;
#ifdef LAMPS
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - point;
        float distance = max(length(towards), 0.03);
        float cosine = dot(lamp_axis[i].xyz, towards) / distance;
        float cone = clamp((cosine - lamp_position[i].w) * lamp_axis[i].w, 0.0, 1.0);
        float share = 1.0;
        if (lamp_position[i].w > -1.0) {
            vec4 uv = lamp_from_camera[i] * vec4(point, 1.0);
            share = cone > 0.0 ? textureLod(lamp_maps, uv.xyz / uv.w, 0.0) : 0.0;
        } else {
            cone = 1.0;
        }
        vec3 energy = lamp_optics[i].x - lamp_optics[i].y * sqrt(absorption.rgb * (2.0 * distance));
        vec3 transmission = exp((absorption.rgb + scattering.rgb * (1.0 - energy)) * -distance);
        sum += lamp_light[i].rgb * transmission * (cone * cone * (3.0 - 2.0 * cone) * share / (distance * distance));
    }
#endif
    return sum;
}

void main() {
    vec2 size = vec2(textureSize(surface_image, 0));
    float range = length(place.xyz);
    float depth = max(-place.z, 0.01);
    vec2 first = pixel_of(place.xyz - 0.5 * extent.xyz);
    vec2 last = pixel_of(place.xyz + 0.5 * extent.xyz);
    vec2 streak = last - first;
    float streak_length = min(length(streak), 0.5 * size.x);
    vec2 along = streak_length > 0.01 ? normalize(streak) : vec2(1.0, 0.0);
    float focal = inversesqrt(abs(ray_column.x * ray_row.y));
    float radius = place.w * focal / depth;
    float blur = particle_lens.x * focal * abs(1.0 / depth - particle_lens.y);
    float drawn = max(1.7320508 * sqrt(radius * radius + blur * blur), particle_lens.z);
    float coverage = extent.w * radius * radius / (drawn * (drawn + 0.5 * streak_length));
    vec2 corner = vec2(gl_VertexID % 2 == 0 ? -1.0 : 1.0, gl_VertexID % 4 < 2 ? -1.0 : 1.0);
    v_offset = corner * vec2(0.5 * streak_length + drawn, drawn);
    vec3 direct = exp((absorption.rgb + scattering.rgb) * -range);
    vec3 water = open_water(0.5 * (first + last), size);
    v_light = vec4(direct * (traits.x * lit(place.xyz) - water), range);
    v_shape = vec4(0.5 * streak_length + drawn, drawn, coverage, traits.y);
    vec2 pixel = 0.5 * (first + last) + v_offset.x * along + v_offset.y * vec2(-along.y, along.x);
    gl_Position = vec4(2.0 * pixel / size - 1.0, 0.0, 1.0);
}
