#include "engine/samples/kept_surfaces.h"

#include "base/content_hash.h"
#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <vector>

namespace petzval::engine {
namespace {

// A frame is worked on in a few strips, and a window alternates between drafts and final frames.
constexpr std::size_t kMostNames = 64;

template <typename Pixel>
std::uint64_t hash_of_pixels(View<const Pixel> pixels, int every_row, std::uint64_t seed, Workers& workers) {
    std::vector<std::uint64_t> rows(std::size_t((pixels.height() + every_row - 1) / every_row));
    parallel_for(int(rows.size()), workers, [&](int i) {
        rows[std::size_t(i)] =
            hash_of(pixels.row(i * every_row), std::size_t(pixels.width()) * sizeof(Pixel), seed);
    });
    return hash_of(rows.data(), rows.size() * sizeof(std::uint64_t), seed);
}

}  // namespace

bool KeptSurfaces::was_asked_for(std::uint64_t outline) {
    const std::lock_guard lock(mutex_);
    if (std::find(asked_for_.begin(), asked_for_.end(), outline) != asked_for_.end()) return true;
    asked_for_.push_front(outline);
    if (asked_for_.size() > kMostNames) asked_for_.pop_back();
    return false;
}

std::uint64_t name_of_surfaces(const EngineView& input, View<const Rgba> colour, const Dim& dim,
                               std::uint64_t rules, int every_row) {
    const Samples& s = input.samples;
    Workers& workers = *input.services.workers;
    const std::array<float, 4> numbers{s.nearest_coc_px, s.farthest_coc_px, dim.least, dim.white};
    const std::array<std::uint64_t, 4> parts{rules, dim ? dim.name : 0, std::uint64_t(colour.width()),
                                             std::uint64_t(colour.height())};
    std::uint64_t name = hash_of(numbers.data(), sizeof numbers, 1);
    name = hash_of(parts.data(), sizeof parts, name);
    name = hash_of_pixels(colour, every_row, name, workers);
    return hash_of_pixels(s.coc_px, every_row, name, workers);
}

}  // namespace petzval::engine
