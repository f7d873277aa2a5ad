// Provides: the vertices of a model on the image, bit for bit as surface.vert.glsl computes them.
// Needs: frame.glsl, instance.glsl.
// The same two matrix products, so that depths are equal.
#include "frame.glsl"
#include "instance.glsl"

in vec3 vertex;

void main() {
    vec4 point = camera_from_model * vec4(vertex, 1.0);
    gl_Position = clip_from_camera * point;
}
