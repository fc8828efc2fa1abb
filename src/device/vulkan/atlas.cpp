#include "device/vulkan/atlas.h"

namespace petzval::device::vulkan {
namespace {

std::uint32_t halves(int x, int y) { return (std::uint32_t(x) & 0xffffu) | (std::uint32_t(y) << 16); }

}  // namespace

std::shared_ptr<const PackedSet> PackedSet::laid_out(const KernelSource::Made& spreads) {
    auto set = std::make_shared<PackedSet>();
    for (const auto& spread : spreads) {
        const Rect lit = lit_part(spread->weights);
        Kernel& kernel = set->kernels.emplace_back();
        kernel.extent = lit.moved(spread->extent.x0, spread->extent.y0);
        kernel.neutral = spread->neutral, kernel.first = set->weights.size();
        for (int y = lit.y0; y < lit.y1; ++y)
            for (int x = lit.x0; x < lit.x1; ++x) {
                const Rgba w = spread->weights(x, y);
                if (kernel.neutral)
                    set->weights.push_back(w.g);
                else
                    set->weights.insert(set->weights.end(), {w.r, w.g, w.b, w.a});
            }
        set->weights.resize((set->weights.size() + 3) / 4 * 4);
        set->taps += kernel.taps();
    }
    set->weights.shrink_to_fit();
    set->bytes = sizeof(*set) + set->kernels.size() * sizeof(Kernel) + set->weights.size() * sizeof(float);
    return set;
}

PackedAtlas::PackedAtlas(std::vector<std::shared_ptr<const PackedSet>> sets) : sets_(std::move(sets)) {
    for (const auto& set : sets_)
        if (set) weight_bytes_ += set->weights.size() * sizeof(float);
}

KernelsOnDevice PackedAtlas::uploaded(std::span<const std::uint32_t> kernels, Recording& recording) const {
    std::vector<std::uint32_t> first(sets_.size()), records;
    std::vector<float> weights;
    std::size_t floats = 0;
    for (const std::uint32_t k : kernels) floats += sets_[k]->weights.size();
    weights.reserve(floats);
    for (const std::uint32_t k : kernels) {
        const PackedSet& set = *sets_[k];
        first[k] = std::uint32_t(records.size() / 3);
        for (const PackedSet::Kernel& kernel : set.kernels) {
            const Rect& e = kernel.extent;
            const auto fours = std::uint32_t((weights.size() + kernel.first) / 4);
            records.insert(records.end(), {halves(e.x0, e.y0), halves(e.width(), e.height()),
                                           fours | (kernel.neutral ? 0x80000000u : 0u)});
        }
        weights.insert(weights.end(), set.weights.begin(), set.weights.end());
    }
    KernelsOnDevice made;
    made.records = std::uint32_t(first.size());
    first.insert(first.end(), records.begin(), records.end());
    made.words = recording.uploaded(std::span<const std::uint32_t>(first));
    made.weights = recording.uploaded(std::span<const float>(weights));
    return made;
}

}  // namespace petzval::device::vulkan
