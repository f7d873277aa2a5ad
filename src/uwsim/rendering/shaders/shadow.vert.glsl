// Provides: the vertices of a shadow caster in the view of a light.
// Needs: instance.glsl, filled with matrices to the light's clip space instead of the camera frame.
// Used for the shadow maps of the sun, the lamps and the projector. With ALPHA_TEST, it has holes.
#include "instance.glsl"

in vec3 vertex;
#ifdef ALPHA_TEST
in vec2 uv;
out vec2 v_uv;
#endif

void main() {
    gl_Position = camera_from_model * vec4(vertex, 1.0);
#ifdef ALPHA_TEST
    v_uv = uv;
#endif
}
