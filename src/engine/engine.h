// The waist every defocus engine fits through: one input, one output, one line in a list.
//
// The api room has checked everything by the time an engine runs: sizes agree, colour is finite, circles of
// confusion are finite, the picture is not empty. An engine validates nothing and throws nothing but
// std::bad_alloc.
#pragma once

#include "petzval/defocus.h"
#include "petzval/image.h"
#include "petzval/result.h"

#include "base/progress.h"
#include "kernel/lens_model.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace petzval::engine {

// One thing seen in one pixel: premultiplied colour with its own coverage colour.a, signed CoC radius of its
// front and of its back (equal for a surface).
struct CocSample {
    Rgba colour;
    float coc_px = 0, coc_back_px = 0;
};

// Samples per pixel, nearest (smallest CoC) first; as DeepPicture, with depth turned into radii.
struct CocSamples {
    std::vector<std::size_t> first;  // width * height + 1 entries, or empty: none
    std::vector<CocSample> samples;
    bool empty() const { return samples.empty(); }
    std::span<const CocSample> at(std::size_t pixel) const {
        if (first.empty()) return {};
        return {samples.data() + first[pixel], first[pixel + 1] - first[pixel]};
    }
};

// Which edges of the picture are merely where the render stopped (the scene goes on beyond them), as against
// edges of a data window inside the frame, beyond which there is nothing.
struct OpenEdges {
    bool left = true, top = true, right = true, bottom = true;
};

struct Input {
    View<const Rgba> colour;   // premultiplied; the front view of `deep` where that is given
    View<const float> coc_px;  // signed radius, + behind focus
    // Every sample of every pixel, when the input knows more than its front view (deep files, hidden layers);
    // then colour and coc_px are not all there is to hit. Empty otherwise.
    CocSamples deep;
    OpenEdges open_edges;
    // Field position of pixel (x, y): ((x + 0.5 - centre_x) * per_px, -(y + 0.5 - centre_y) * per_px /
    // pixel_aspect).
    double field_centre_x = 0, field_centre_y = 0, field_per_px = 0;
    double pixel_aspect = 1;
    const kernel::LensModel* lens = nullptr;
    Quality quality = Quality::Standard;
    int pupil_points = 4096;
    int threads = 0;
    std::size_t max_memory_bytes = 0;
    std::uint64_t seed = 1;
    Progress* progress = nullptr;

    int width() const { return colour.width(); }
    int height() const { return colour.height(); }
    kernel::FieldPosition field_at(double x, double y) const {
        return {(x + 0.5 - field_centre_x) * field_per_px,
                -(y + 0.5 - field_centre_y) * field_per_px / pixel_aspect};
    }
};

struct Output {
    Picture image;
    std::vector<StageTime> stages;
    std::vector<std::string> warnings;
};

struct Engine {
    const char* name;
    const char* purpose;  // one line for help texts
    Result<Output> (*run)(const Input&);
};

// Every engine there is; the command line, the conformance tests and the benchmarks walk this list.
std::span<const Engine> engines();

// The engines. Errors: Cancelled, OutOfMemory.
Result<Output> run_reference(const Input& input);
Result<Output> run_scatter(const Input& input);

}  // namespace petzval::engine
