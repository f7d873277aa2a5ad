// Provides: depth only.
// Needs: nothing.
// The rasteriser writes it.
void main() {}
