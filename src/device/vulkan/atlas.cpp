#include "device/vulkan/atlas.h"

#include <algorithm>

namespace petzval::device::vulkan {
namespace {

std::uint32_t halves(int x, int y) { return (std::uint32_t(x) & 0xffffu) | (std::uint32_t(y) << 16); }

// Writes the weights of a kernel's lit part.
void pack(const kernel::PointSpread& spread, const Rect& lit, float* to) {
    for (int y = lit.y0; y < lit.y1; ++y) {
        const Rgba* const row = spread.weights.row(y);
        for (int x = lit.x0; x < lit.x1; ++x)
            if (spread.neutral)
                *to++ = row[x].g;
            else
                to = std::copy_n(&row[x].r, 4, to);
    }
}

}  // namespace

std::shared_ptr<const PackedSet> PackedSet::laid_out(const KernelSource::Made& spreads) {
    auto set = std::make_shared<PackedSet>();
    std::vector<Rect> lit_parts;
    std::size_t floats = 0;
    for (const auto& spread : spreads) {
        const Rect lit = lit_part(spread->weights);
        Kernel& kernel = set->kernels.emplace_back();
        kernel.extent = lit.moved(spread->extent.x0, spread->extent.y0);
        kernel.neutral = spread->neutral, kernel.first = floats;
        floats += (kernel.taps() * (kernel.neutral ? 1 : 4) + 3) / 4 * 4;
        set->taps += kernel.taps();
        lit_parts.push_back(lit);
    }
    set->weights.resize(floats);
    for (std::size_t i = 0; i < spreads.size(); ++i)
        pack(*spreads[i], lit_parts[i], set->weights.data() + set->kernels[i].first);
    set->bytes = sizeof(*set) + set->kernels.size() * sizeof(Kernel) + set->weights.size() * sizeof(float);
    return set;
}

PackedAtlas::PackedAtlas(std::vector<std::shared_ptr<const PackedSet>> sets) : sets_(std::move(sets)) {
    for (const auto& set : sets_)
        if (set) weight_bytes_ += set->weights.size() * sizeof(float);
}

KernelsOnDevice PackedAtlas::uploaded(std::span<const std::uint32_t> kernels, Recording& recording) const {
    std::vector<std::uint32_t> first(sets_.size()), records;
    std::vector<std::span<const std::byte>> weights;
    std::size_t floats = 0;
    for (const std::uint32_t k : kernels) {
        const PackedSet& set = *sets_[k];
        first[k] = std::uint32_t(records.size() / 3);
        for (const PackedSet::Kernel& kernel : set.kernels) {
            const Rect& e = kernel.extent;
            const auto fours = std::uint32_t((floats + kernel.first) / 4);
            records.insert(records.end(), {halves(e.x0, e.y0), halves(e.width(), e.height()),
                                           fours | (kernel.neutral ? 0x80000000u : 0u)});
        }
        weights.push_back(std::as_bytes(std::span(set.weights)));
        floats += set.weights.size();
    }
    KernelsOnDevice made;
    made.records = std::uint32_t(first.size());
    first.insert(first.end(), records.begin(), records.end());
    made.words = recording.uploaded(std::span<const std::uint32_t>(first));
    made.weights = recording.uploaded(weights);
    return made;
}

}  // namespace petzval::device::vulkan
