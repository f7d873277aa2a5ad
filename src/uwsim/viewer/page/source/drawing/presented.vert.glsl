// Provides: one triangle over the whole target, and the texture coordinates of its pixels.
// Needs: nothing; three vertices without attributes. With the switch FLIPPED, row 0 of the target is the lowest one of the image.
out vec2 v_uv;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    v_uv = 0.5 * corner + 0.5;
#ifdef FLIPPED
    v_uv.y = 1.0 - v_uv.y;
#endif
    gl_Position = vec4(corner, 0.0, 1.0);
}
