// Kernels as atlas.h beside this folder lays them out; `weights` is declared by who includes this.

// A pair of signed 16 bits.
ivec2 halves(uint word) { return ivec2(int(word << 16) >> 16, int(word) >> 16); }

// The weight at d from a kernel's corner, within its size. where: what its record says; bit 31: one weight stands
// for all channels.
vec4 weight(ivec2 d, ivec2 wide, uint where) {
    const int tap = d.y * wide.x + d.x;
    const uint first = 4u * (where & 0x7fffffffu);
    if ((where >> 31) != 0u) return vec4(weights[first + uint(tap)]);
    const uint i = first + 4u * uint(tap);
    return vec4(weights[i], weights[i + 1u], weights[i + 2u], weights[i + 3u]);
}
