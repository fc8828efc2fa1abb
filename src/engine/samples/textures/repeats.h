// Repetitions in a piece of a picture, found by comparing the picture with itself, shifted.
//
// K. He and J. Sun, "Statistics of patch offsets for image completion", 2012: textures match themselves at
// few offsets. Normalised correlation of the known pixels finds these offsets.
#pragma once

#include <array>
#include <vector>

namespace petzval::engine {

// A square piece of a picture: what its light differs from the mean around, relative to both; 0 where nothing
// is known.
struct Details {
    // Detail of a piece whose middle, `inner` on a side, is compared with all pixels no farther than
    // `farthest`.
    Details(int inner, int farthest);

    int inner, farthest, side;
    int stride;                        // pixels from row to row; pixels beyond `side` are unknown
    std::vector<float> values, known;  // known: 1 or 0

    std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(stride) + std::size_t(x); }
    void set(int x, int y, float value) { values[at(x, y)] = value, known[at(x, y)] = 1; }
};

// Sums over all pairs of pixels an offset apart: of products, of squares of both, and their number.
struct Pairs {
    float products = 0, squares = 0, count = 0;
    // Correlation of both sides, -1…1. Small where there is little detail.
    float alike() const { return 2 * products / (squares + 1e-3f * count + 1e-12f); }
};

struct Texture {
    static constexpr int kMost = 24;  // at most one per direction and distance
    struct Offset {
        float x, y;   // pixels of details
        float alike;  // 0…1
    };
    std::array<Offset, kMost> repeats;  // best first; `alike` is 0 where there are no more
    // Grain, 0…1: the texture looks the same everywhere and no place predicts another, as in sand or noise.
    float grain = 0;
};

Texture texture_of(const Details& piece);

// Pairs of the offsets with 0 <= y <= farthest, |x| <= farthest, in rows of 2 farthest + 1; those of -y are
// the same. Every third pixel of every third row of the middle is compared with others, the rows shifted by
// one.
std::vector<Pairs> pairs_of(const Details& piece);

}  // namespace petzval::engine
