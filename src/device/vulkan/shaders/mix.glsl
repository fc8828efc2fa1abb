// Shared by the three passes of a draft: mix.cpp beside this folder writes these words.

// For each blur: level, cells across and down, the first row of cells that is here and how many, its first cell;
// then weights, radius and shares inside along x, and along y.
const uint kBlurWords = 12u;
const uint kSmall = 0u, kLarge = 1u;                      // by depth, and where one of them is shown
const uint kLayered = 0u, kByRadius = 1u, kByDepth = 2u;  // laws

layout(push_constant) uniform Push {
    uint blur, axis;                 // that a pass is about
    uint width, height, first_row;   // of the picture; the first row of pixels that is here
    uint out_row, out_rows;          // rows of the result
    uint law, view;
    uint has_extras;                 // whether pixels may have any
    float near[4], far[4];           // BlurStack: band, stretch, largest radius, count
} at;

uint fact(uint blur, uint which) { return words[kBlurWords * blur + which]; }
float number(uint word) { return uintBitsToFloat(words[word]); }

// engine/waist/cells.h, CellSplines. On level 0 cells are pixels.
struct Span {
    int begin, end;
};
// Pixels that have a share in a cell, along an axis of that many pixels.
Span pixels_of(int cell, int level, int pixels) {
    if (level == 0) return Span(cell, cell + 1);
    return Span(max(0, (cell - 1) << level), min((cell + 2) << level, pixels));
}
// Shares of a pixel in the cell before its own, in its own and in the one after.
vec3 spline_shares(int pixel, int level) {
    const int size = 1 << level;
    const float from_middle = (float(pixel & (size - 1)) + 0.5) / float(size) - 0.5;
    const float before = 0.5 - from_middle, after = 0.5 + from_middle;
    return vec3(0.5 * before * before, 0.75 - from_middle * from_middle, 0.5 * after * after);
}
// In one of them, as a part of the cell; at the ends all goes to the last cell.
float spline_share(int pixel, int cell, int level, int cells) {
    if (level == 0) return 1;
    const vec3 shares = spline_shares(pixel, level);
    const int own = pixel >> level;
    float share = cell == own ? shares.y : cell < own ? shares.x : shares.z;
    if (cell == own && cell == 0) share += shares.x;
    if (cell == own && cell + 1 == cells) share += shares.z;
    return ldexp(share, -level);
}

// engine/gaussian/gaussian_mix.cpp: blurs numbered from the narrowest, 1; 0 is the sharp picture.
struct Mix {
    int lower;
    float upper_share;
};
const float kWithin = 0.5;
float blurred_px(float radius_px, float s[4]) { return max(0.0, radius_px - s[0]) * s[1]; }
float radius_of(int blur, float s[4]) { return blur == 0 ? kWithin : ldexp(s[2], blur - int(s[3])); }
Mix in_stack(float radius_px, float s[4]) {
    const float r = blurred_px(radius_px, s);
    const int count = int(s[3]);
    if (count == 0 || r <= kWithin) return Mix(0, 0);
    int upper = 1;
    while (upper < count && radius_of(upper, s) < r) ++upper;
    const float low = radius_of(upper - 1, s), high = radius_of(upper, s);
    return Mix(upper - 1, min(1.0, (r * r - low * low) / (high * high - low * low)));
}
Mix own_mix(float coc_px) { return coc_px < 0 ? in_stack(-coc_px, at.near) : in_stack(coc_px, at.far); }
float sharp_share(Mix mixed) { return mixed.lower == 0 ? 1 - mixed.upper_share : 0; }

// Places of the layers, and how many.
uint near_count() { return uint(at.near[3]); }
uint layer_count() { return near_count() + uint(at.far[3]); }
// Layer of light of this sign, number k from 1.
uint layer(int k, bool near) { return near ? near_count() - uint(k) : near_count() + uint(k) - 1u; }

// Further surfaces of a pixel: part of a nearer one, then hidden ones. Its word in `extra_of` gives their
// position in `extras`: the first number times 4, and a bit for each.
struct Extra {
    vec4 light;
    float covered;
    bool near;
    Mix mixed;
};
const uint kRim = 1u, kHidden = 2u;
