// What the three passes of a draft share: mix.cpp beside this folder writes these words.

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
// Of light of this sign, that numbered k from 1.
uint layer(int k, bool near) { return near ? near_count() - uint(k) : near_count() + uint(k) - 1u; }

// What a pixel holds beside what is seen: part of something nearer, then what is hidden. Its word in `extra_of`
// says where in `extras` these are: the first number times 4, and a bit for each.
struct Extra {
    vec4 light;
    float covered;
    bool near;
    Mix mixed;
};
const uint kRim = 1u, kHidden = 2u;
