// Provides: nothing but the depth.
// Needs: nothing.
// The rasteriser writes it.
void main() {}
