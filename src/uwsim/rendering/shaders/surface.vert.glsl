// Provides: the vertices of a model, in the camera frame and on the image.
// Needs: frame.glsl, instance.glsl, between.glsl, lamps.glsl.
// Whatever is linear in space is computed here and interpolated, exactly.
#define BETWEEN out
#include "frame.glsl"
#include "instance.glsl"
#include "between.glsl"
#if defined(COLOUR) && defined(LAMPS)
#include "lamps.glsl"
#endif

in vec3 vertex;
#ifdef COLOUR
in vec3 vertex_normal;
in vec3 tint;
#ifdef TEXTURED
in vec2 uv;
#endif
#endif

void main() {
    vec4 point = camera_from_model * vec4(vertex, 1.0);
    position = point.xyz;
    gl_Position = clip_from_camera * point;
#ifdef COLOUR
    normal = mat3(camera_normals) * vertex_normal;
    along.x = dot(normal, sun.xyz);
    along.y = dot(position, sun.xyz);
    along.z = -(dot(position, up.xyz) + up.w);
    along.w = clip_fog.y - clip_fog.x * position.z;
    base = tint;
    lights = vec4(sunlight.rgb, sky.x);
    veil = vec4(water_colour.rgb, sky.y);
    losses = attenuation.rgb;
    mist = fog;
#ifdef TEXTURED
    place = uv;
#endif
#ifdef AIR
    sunk = -up.w;
#endif
#ifdef SHADOWS
    vec3 lifted = position + normal * (sun.w * inversesqrt(max(dot(normal, normal), 1e-12)));
    shadow_place = (shadow_from_camera * vec4(lifted, 1.0)).xyz;
#endif
#ifdef LAMPS
    vec3 unit_normal = normal * inversesqrt(max(dot(normal, normal), 1e-12));
    for (int i = 0; i < LAMPS; ++i) {
        vec3 towards = lamp_place[i].xyz - position;
        float lift = lamp_light[i].w * dot(towards, lamp_axis[i].xyz) * sign(dot(unit_normal, towards));
        on_lamp_map[i] = lamp_from_camera[i] * vec4(position + unit_normal * lift, 1.0);
    }
#endif
#endif
}
