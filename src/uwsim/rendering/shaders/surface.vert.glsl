// Provides: the vertices of a model, in the camera frame and on the image.
// Needs: frame.glsl, instance.glsl, varyings.glsl, lamps.glsl, projector.glsl.
// Terms that are linear in space are computed here; their interpolation is exact.
#define VARYING out
#include "frame.glsl"
#include "instance.glsl"
#include "varyings.glsl"
#if defined(COLOUR) && defined(PHYSICAL)
#include "optics.glsl"
#ifdef CAUSTICS
#include "caustics_block.glsl"
#endif
#endif
#if defined(COLOUR) && defined(LAMPS)
#include "lamps.glsl"
#endif
#if defined(COLOUR) && defined(PROJECTOR)
#include "projector.glsl"
#endif

in vec3 vertex;
#ifdef COLOUR
in vec3 vertex_normal;
in vec3 tint;
#ifdef NORMAL_MAP
in vec4 tangent;
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
in vec3 finish;
#endif
#ifdef EMISSION
in vec3 emission;
#endif
#endif
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
in vec2 uv;
#endif

void main() {
    vec4 point = camera_from_model * vec4(vertex, 1.0);
    v_position = point.xyz;
    gl_Position = clip_from_camera * point;
#if defined(HAS_UV) && (defined(COLOUR) || defined(ALPHA_TEST))
    v_uv = uv;
#endif
#ifdef COLOUR
    v_normal = mat3(camera_normals) * vertex_normal;
    v_terms.x = dot(v_normal, sun.xyz);
    v_terms.y = dot(v_position, sun.xyz);
    v_terms.z = -(dot(v_position, up.xyz) + up.w);
#ifdef PHYSICAL
    v_terms.w = dot(v_normal, up.xyz);
#else
    v_terms.w = clip_fog.y - clip_fog.x * v_position.z;
#endif
    v_base_colour = tint;
    v_attenuation = attenuation.rgb;
#ifdef PHYSICAL
    v_sun_beam = vec4(sun_beam.rgb, upwelling.w);
    v_sun_loss = sun_loss.rgb;
    v_daylight_total = daylight_total.rgb;
    v_daylight_loss = daylight_loss.rgb;
    v_upwelling = upwelling.rgb;
#ifdef CAUSTICS
    v_caustic_place = vec2(dot(v_position, caustic_x.xyz), dot(v_position, caustic_y.xyz)) + vec2(caustic_x.w, caustic_y.w);
    v_caustic_depths = caustic_depths;
    v_swell_frame = swell_frame;
    v_caustic_loss = caustic_loss.rgb;
#endif
#else
    v_lights = vec4(sunlight.rgb, ambient_specular.x);
    v_water_colour = vec4(water_colour.rgb, ambient_specular.y);
    v_fog = fog;
#endif
#ifdef NORMAL_MAP
    mat3 rotation = mat3(camera_from_model);
    vec3 along = rotation * tangent.xyz;
    v_tangent = vec4(along * inversesqrt(max(dot(along, along), 1e-12)), tangent.w * sign(determinant(rotation)));
#endif
#if defined(NORMAL_MAP) || defined(MICROFACET)
    v_sun = sun.xyz;
    v_up = up.xyz;
    v_finish = finish;
#endif
#ifdef EMISSION
    v_emission = emission;
#endif
#ifdef AIR
    v_camera_depth = -up.w;
#endif
#ifdef SHADOWS
#ifdef SOFT
    float lift = 2.5 * sun.w;  // look-ups are wider
#else
    float lift = sun.w;
#endif
    vec3 lifted = v_position + v_normal * (lift * inversesqrt(max(dot(v_normal, v_normal), 1e-12)));
    v_shadow_uv = (shadow_from_camera * vec4(lifted, 1.0)).xyz;
#ifdef HULLS
    mat3 across = transpose(mat3(shadow_from_camera));
    v_shadow_scale = vec2(length(across[0]), length(across[2]));
#endif
#endif
#ifdef LAMPS
    vec3 unit_normal = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_position[i].xyz - v_position;
        float lift = lamp_light[i].w * dot(towards, lamp_axis[i].xyz) * sign(dot(unit_normal, towards));
        v_lamp_uv[i] = lamp_from_camera[i] * vec4(v_position + unit_normal * lift, 1.0);
#ifdef FLAT_LAMPS
        v_lamp_position[i] = lamp_position[i];
        v_lamp_axis[i] = lamp_axis[i];
        v_lamp_light[i] = lamp_light[i].rgb;
        v_lamp_loss[i] = absorption.rgb + scattering.rgb * (1.0 - lamp_optics[i].x);
        v_lamp_spread[i] = scattering.rgb * sqrt(2.0 * absorption.rgb) * lamp_optics[i].y;
#endif
    }
#endif
#ifdef PROJECTOR
    vec3 outwards = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1e-12));
    vec3 back = projector_position.xyz - v_position;
    float raise = projector_axis.w * dot(back, projector_axis.xyz) * sign(dot(outwards, back));
    v_projector_uv = projector_from_camera * vec4(v_position + outwards * raise, 1.0);
#endif
#endif
}
