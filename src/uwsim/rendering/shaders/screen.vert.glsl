// Provides: one triangle over the whole target, without depth; with the switch BEHIND at the far plane.
// Needs: nothing; three vertices without attributes.
// For the passes of physical water that work on whole images.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
#ifdef BEHIND
    gl_Position = vec4(corner, 1.0, 1.0);
#else
    gl_Position = vec4(corner, 0.0, 1.0);
#endif
}
