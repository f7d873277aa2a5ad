// Provides: the casters as the sun sees them, depth only.
// Needs: instance.glsl with the sun's clip space in the place of the camera frame.
// An orthographic camera; filled by sun_shadow.py.
#include "instance.glsl"

in vec3 vertex;

void main() {
    gl_Position = camera_from_model * vec4(vertex, 1.0);
}
