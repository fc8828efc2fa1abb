// Rows of pictures as an EXR stores them: in the file's primaries, finite, inside half's range.
#pragma once

#include "petzval/files.h"
#include "petzval/image.h"
#include "petzval/workers.h"

#include "files/exr_write/bands.h"
#include "files/layout.h"
#include "files/primaries.h"

#include <atomic>
#include <cstddef>

namespace petzval {

// A channel that is written from a picture, which covers the part's data window.
struct Painted {
    Channel channel;
    const Picture* picture = nullptr;
    int component = 0;                               // 0…3: red, green, blue, alpha
    const PrimariesConversion* primaries = nullptr;  // null: as it is
};

// Counts what had to change.
class Painter {
public:
    explicit Painter(Workers& workers) : workers_(workers) {}
    // Rows y0…y1-1 of the frame, of a picture that begins at row `first`.
    void fill(BandChannel& to, const Painted& from, int first, int y0, int y1);
    WriteReport report() const { return {.clamped_to_half = clamped_, .non_finite = non_finite_}; }

private:
    void fill_row(float* to, const Rgba* from, const Painted& how, float largest);

    Workers& workers_;
    std::atomic<std::size_t> clamped_{0}, non_finite_{0};
};

}  // namespace petzval
