// Provides: projected(dry, colour, unit_normal), the light of a surface with the projected pattern.
// Needs: varyings.glsl and projector.glsl with PROJECTOR; the textures of the pattern and of the shadow map.
// A laser replaces the light by the pattern's colour, 0 or 1 in each channel, times exp(-a d). A lamp adds
// colour p max(N.D, 0) / d^2 exp(-a d) * share of the light that no body blocks: see projector.py.
uniform sampler2DShadow projector_map;
uniform sampler2D projector_pattern;

vec3 projected(vec3 dry, vec3 colour, vec3 unit_normal) {
    vec3 map_point = v_projector_uv.xyz / v_projector_uv.w;
    vec3 towards = projector_position.xyz - v_position;
    float distance = max(length(towards), 0.01);
    float facing = dot(unit_normal, towards) / distance;
    vec2 outside = step(0.5, abs(map_point.xy - 0.5));
    if (v_projector_uv.w <= 0.1 || facing <= 0.0 || outside.x + outside.y > 0.0) return dry;
    vec4 pattern = textureLod(projector_pattern, map_point.xy, 0.0);
    if (pattern.a < 0.5) return dry;
    float share = textureLod(projector_map, vec3(map_point.xy, min(map_point.z, 1.0)), 0.0);
    vec3 transmission = exp(v_attenuation * -distance);
    if (projector_position.w < 0.5)
        return dry + colour * pattern.rgb * transmission * (share * facing / (distance * distance));
    vec3 beam = step(0.5, pattern.rgb);
    float channels = beam.r + beam.g + beam.b;
    bool is_white = min(pattern.r, min(pattern.g, pattern.b)) >= 1.0;
    return share < 0.5 || channels < 0.5 || is_white ? dry : beam * transmission;
}
