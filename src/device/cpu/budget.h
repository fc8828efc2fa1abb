// The budget of lens area of every pixel of a tile, a register of pixels at a time: LensLeft's law, bit for
// bit.
#pragma once

#include "petzval/image.h"

#include "engine/scatter/plan.h"

#include <cstdint>

namespace petzval::engine {

// Lens area given to each pixel of a tile so far, by one sector of the pupil or all of it.
class Budget {
public:
    // Starts an empty tile. Keeps its memory.
    void start(int width, int height);

    // Adds a layer to row y: light in proportion to the lens area it may take of the area it arrives with
    // (its a, and that of the emptiness at its depth; null: none).
    void take(int y, const Rgba* light, const Rgba* emptiness, int layer) {
        take(y, light, emptiness, layer, sum_.row(y), more_.row(y));
    }
    // The same into other sums: the area taken, and the further area that might be taken.
    void take(int y, const Rgba* light, const Rgba* emptiness, int layer, Rgba* sum, Rgba* more);
    Rgba* sum(int y) { return sum_.row(y); }
    Rgba* more(int y) { return more_.row(y); }

    // True if every pixel has less lens area left.
    bool is_spent(float least) const;
    // Adds what row y was given to `light`, and the lens area that was taken for it to `taken`, which has
    // room for whole registers.
    void add_to(int y, Rgba* light, float* taken) const;
    static int whole_registers(int pixels) { return (pixels + kPadding - 1) / kPadding * kPadding; }

    // LensLeft of a row of pixels, by member; T is float or const float.
    template <typename T>
    struct Left {
        T *before, *own, *beside, *more;
    };

private:
    static constexpr int kPadding = 16;

    int width_ = 0, height_ = 0;
    Picture sum_, more_;                          // as LensLeft::Taken
    Plane before_, own_, beside_, area_of_more_;  // rows of whole registers
    Image<std::int32_t> layer_;
};

}  // namespace petzval::engine
