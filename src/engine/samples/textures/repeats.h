// What repeats in a piece of a picture: the picture held against itself, moved.
//
// K. He and J. Sun, "Statistics of patch offsets for image completion", 2012: textures match themselves at
// few offsets. Those are found here by normalised correlation, of what is known alone.
#pragma once

#include <array>
#include <vector>

namespace petzval::engine {

// A square piece of a picture: what its light differs from the mean around, relative to both; 0 where nothing
// is known.
struct Details {
    // Its middle, `inner` on a side, is to be held against all that is no farther than `farthest` away.
    Details(int inner, int farthest);

    int inner, farthest, side;
    int stride;                        // of rows; what is beyond `side` is unknown
    std::vector<float> values, known;  // known: 1 or 0

    std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(stride) + std::size_t(x); }
    void set(int x, int y, float value) { values[at(x, y)] = value, known[at(x, y)] = 1; }
};

// Of all pairs of pixels an offset apart: sums of products, of squares of both, how many.
struct Pairs {
    float products = 0, squares = 0, count = 0;
    // Correlation, -1…1: what one side tells of the other. Little where there is little to be seen.
    float alike() const { return 2 * products / (squares + 1e-3f * count + 1e-12f); }
};

struct Texture {
    static constexpr int kMost = 24;  // one of each direction and distance
    struct Offset {
        float x, y;   // pixels of details
        float alike;  // 0…1
    };
    std::array<Offset, kMost> repeats;  // best first; `alike` is 0 where there are no more
    // 0…1: it looks the same everywhere, and one place tells nothing of the next, as of sand or noise.
    float grain = 0;
};

Texture texture_of(const Details& piece);

// Of offsets with 0 <= y <= farthest, |x| <= farthest, in rows of 2 farthest + 1; those of -y are the same.
// Every third pixel of every third row of the middle is held against others, the rows shifted by one.
std::vector<Pairs> pairs_of(const Details& piece);

}  // namespace petzval::engine
