// Provides: the vertices of a model on the image, where surface.vert.glsl has them to the last bit.
// Needs: frame.glsl, instance.glsl.
// The same two products, so that depths are equal.
#include "frame.glsl"
#include "instance.glsl"

in vec3 vertex;

void main() {
    vec4 point = camera_from_model * vec4(vertex, 1.0);
    gl_Position = clip_from_camera * point;
}
