// Shared by programs of the final star: a tile of the picture in the middle of a square of `side` points,
// which has room for the light it throws.
layout(push_constant) uniform Push {
    uint width, height;  // of the picture
    uint side, reach;
    int left, top;       // of the tile
    uint channels;       // 0: red and green, as the parts of a complex number; 1: blue
    float threshold;
    uint adds;           // 0: what was there goes
    uint half_length;    // of the transforms that a pass makes
    uint stride, across; // from one number of a transform to the next, and from one transform to the next
    float sign;          // of the exponent
} at;
