// Provides: the vertices of a model, in the camera frame and on the picture.
// Needs: frame.glsl, instance.glsl.
// With SHADOWS the place in the shadow map too, pushed off the surface against acne.
#include "frame.glsl"
#include "instance.glsl"

in vec3 vertex;
#ifdef COLOUR
in vec3 normal;
in vec3 tint;
out vec3 surface_normal;
flat out vec3 surface_tint;
#ifdef TEXTURED
in vec2 uv;
out vec2 surface_uv;
#endif
#ifdef SHADOWS
out vec3 shadow_place;
#endif
#endif
out vec3 position;

void main() {
    vec4 point = camera_from_model * vec4(vertex, 1.0);
    position = point.xyz;
    gl_Position = clip_from_camera * point;
#ifdef COLOUR
    surface_normal = mat3(camera_normals) * normal;
    surface_tint = tint;
#ifdef TEXTURED
    surface_uv = uv;
#endif
#ifdef SHADOWS
    vec3 lifted = position + normalize(surface_normal) * sun.w;
    shadow_place = (shadow_from_camera * vec4(lifted, 1.0)).xyz;
#endif
#endif
}
