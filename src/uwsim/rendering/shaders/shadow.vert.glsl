// Provides: the vertices of a shadow caster in the view of a light.
// Needs: instance.glsl, filled with matrices to the light's clip space instead of the camera frame.
// Used for the shadow maps of the sun, the lamps and the projector.
#include "instance.glsl"

in vec3 vertex;

void main() {
    gl_Position = camera_from_model * vec4(vertex, 1.0);
}
