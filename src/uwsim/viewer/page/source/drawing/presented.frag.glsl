// Provides: a finished image at its place on the page; an image twice as wide and high becomes the mean of its squares of four.
// Needs: presented.vert.glsl; the image, row 0 at the top, with linear interpolation.
in vec2 v_uv;
uniform sampler2D level_0;
out vec4 colour_out;

void main() {
    colour_out = textureLod(level_0, v_uv, 0.0);
}
