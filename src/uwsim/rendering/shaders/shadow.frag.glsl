// Provides: depth only, which the rasteriser writes.
// Needs: with ALPHA_TEST, the alpha of holes, 1..255 of 255, a texture of the base colour.
// For all shadow maps.
#ifdef ALPHA_TEST
uniform sampler2D base_map;
in vec2 v_uv;
#endif

void main() {
#ifdef ALPHA_TEST
    if (texture(base_map, v_uv).a < float(ALPHA_TEST) / 255.0) discard;
#endif
}
