// Shared by the programs of instanced_sprites.cpp.
layout(push_constant) uniform Push {
    ivec2 size;      // pixels of the picture
    int every;       // one sprite for each square of so many pixels
    int levels;
    vec4 rims;       // of the barrel, two of them: how far the corner of the frame sees it displaced, radius; pupil radii
} at;

// The atlas: far sprites on its left half, near ones on its right; level 0 above, all others side by side below it. Every
// level has a border that sprites of its rim are drawn into.
const int kBorder = 12;      // texels; no sprite is wider than kWidest + 1
const float kWidest = 8;     // radius in texels of a level
int texels(int pixels, int level) { return (pixels + (1 << level) - 1) >> level; }
ivec2 corner_of(int level, bool near) {
    ivec2 corner = ivec2(near ? at.size.x + 2 * kBorder * at.levels : 0, 0) + kBorder;
    if (level == 0) return corner;
    corner.y += at.size.y + 2 * kBorder;
    for (int l = 1; l < level; ++l) corner.x += texels(at.size.x, l) + 2 * kBorder;
    return corner;
}
