// Provides: depth only, which the rasteriser writes.
// Needs: nothing.
// For all shadow maps.
void main() {}
