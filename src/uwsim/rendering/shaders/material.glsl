// Provides: with NORMAL_MAP, mapped_normal(unit_normal); with MICROFACET, prepare_material, material_daylight, reflected_share.
// Needs: varyings.glsl; with MICROFACET: daylight.glsl, the table of reflectance.py, and with FINISH_MAP a map of occlusion, roughness, metal.
// pi times the BRDF of a rough surface: Lambert under a layer of GGX's microfacets: reflectance.py.
#ifdef NORMAL_MAP
uniform sampler2D normal_map;

vec3 mapped_normal(vec3 unit_normal) {
    vec3 local = texture(normal_map, v_uv).xyz * (255.0 / 127.5) - 1.0;
    vec3 outward = gl_FrontFacing ? unit_normal : -unit_normal;
    vec3 across = cross(outward, v_tangent.xyz) * v_tangent.w;
    vec3 mapped = v_finish.z * (local.x * v_tangent.xyz + local.y * across) + local.z * outward;
    mapped *= inversesqrt(max(dot(mapped, mapped), 1e-12));
    return gl_FrontFacing ? mapped : -mapped;
}
#endif
#ifdef MICROFACET
#define MIN_ROUGHNESS 0.08  // these are the constants of reflectance.py; the indices are squared and relative to the medium
#define WATER_INDEX 1.2530631
#define AIR_INDEX 2.25
uniform sampler2D reflectance_table;
#ifdef FINISH_MAP
uniform sampler2D finish_map;
#endif
vec3 surface_view;      // towards the camera
vec3 surface_diffuse;   // albedo below the layer, times the light that passes the layer
vec3 surface_metal;     // colour of metal
vec3 surface_gain;      // factor on its reflection for light that microfacets reflect several times
vec4 surface_finish;    // x: roughness; y: share of metal; z: squared width; w: n.v
vec2 surface_factors;   // x: squared relative index of a dielectric; y: share of the diffuse daylight that arrives
vec3 surface_mirror;    // reflectance of the layer under even light

// Fresnel's reflectance of a dielectric, or Schlick's of a metal, from the cosine of incidence.
vec3 fresnel(float cosine) {
    float g = sqrt(surface_factors.x - 1.0 + cosine * cosine);
    float minus = g - cosine;
    float plus = g + cosine;
    float ratio = minus / plus;
    float second = (cosine * plus - 1.0) / (cosine * minus + 1.0);
    float dielectric = 0.5 * ratio * ratio * (1.0 + second * second);
    float rest = 1.0 - cosine;
    float power = rest * rest;
    power *= power * rest;
    return mix(vec3(dielectric), surface_gain * (surface_metal + (1.0 - surface_metal) * power), surface_finish.y);
}

// Set the variables above for a pixel; call it before the functions below.
void prepare_material(vec3 albedo, vec3 normal, float depth) {
    float roughness = v_finish.x;
    float metallic = v_finish.y;
    float occlusion = 1.0;
#ifdef FINISH_MAP
    vec3 finish_texel = texture(finish_map, v_uv).rgb;
    occlusion = finish_texel.r;
    roughness *= finish_texel.g;
    metallic *= finish_texel.b;
#endif
    roughness = max(roughness, MIN_ROUGHNESS);
    float width = roughness * roughness;
    surface_view = -v_position * inversesqrt(dot(v_position, v_position));
    float nv = clamp(dot(normal, surface_view), 0.001, 1.0);
    vec2 texels = vec2(textureSize(reflectance_table, 0));
    vec3 table = textureLod(reflectance_table, (vec2(nv, roughness) * (texels - 1.0) + 0.5) / texels, 0.0).rgb;
    bool is_wet = depth > 0.0;
    float dielectric = is_wet ? table.g : table.b;
    surface_finish = vec4(roughness, metallic, width * width, nv);
    surface_factors = vec2(is_wet ? WATER_INDEX : AIR_INDEX, occlusion);
    surface_metal = albedo;
    surface_diffuse = albedo * ((1.0 - metallic) * (1.0 - dielectric));
    surface_gain = 1.0 + albedo * (1.0 / table.r - 1.0);
    surface_mirror = mix(vec3(dielectric), albedo * table.r * surface_gain, metallic);
}

// The share of a beam that the camera receives, pi times the BRDF; facing = normal . towards > 0.
vec3 reflected_share(vec3 normal, vec3 towards, float facing) {
    vec3 middle = towards + surface_view;
    middle *= inversesqrt(max(dot(middle, middle), 1e-12));
    float nh = dot(normal, middle);
    float square = surface_finish.z;
    float nv = surface_finish.w;
    float nl = max(facing, 1e-4);
    float peak = nh * nh * (square - 1.0) + 1.0;
    float shadowing = nl * sqrt(nv * nv * (1.0 - square) + square) + nv * sqrt(nl * nl * (1.0 - square) + square);
    float facets = 0.5 * square / (peak * peak * shadowing);
    return surface_diffuse + facets * fresnel(clamp(dot(surface_view, middle), 0.0, 1.0));
}

// The light of sun and sky that the surface reflects; the arguments are those of daylight.
vec3 material_daylight(vec3 normal, float facing, float upward, float share, float depth) {
    vec3 even = daylight(0.0, upward, share, depth);
    vec3 beam = daylight(1.0, upward, share, depth) - even;
    float mirrored_up = 2.0 * dot(normal, surface_view) * upward - dot(surface_view, v_up);
    float lobe = clamp(mirrored_up / surface_finish.x, -1.0, 1.0);
    vec3 mirrored = daylight(0.0, lobe, share, depth);
    vec3 total = surface_factors.y * (even * surface_diffuse + mirrored * surface_mirror);
    if (facing > 0.0) total += beam * (facing * reflected_share(normal, v_sun, facing));
    return total;
}
#endif
