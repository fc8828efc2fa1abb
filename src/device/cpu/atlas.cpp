#include "device/cpu/atlas.h"

#include "base/parallel.h"

namespace petzval::device {

std::shared_ptr<const StampSet> StampSet::laid_out(const KernelSource::Made& spreads) {
    auto set = std::make_shared<StampSet>();
    for (const auto& spread : spreads) {
        const engine::StampKernel& kernel = set->kernels.emplace_back(*spread);
        set->taps += std::size_t(kernel.groups() * engine::StampKernel::kGroup * kernel.extent().height());
        set->bytes += kernel.bytes() + sizeof(kernel);
    }
    set->bytes += sizeof(*set);
    return set;
}

SpreadAtlas::SpreadAtlas(const KernelSource& source, const KernelSet& set, const Control& control)
    : kernels_(set.asks.size()) {
    parallel_for(int(kernels_.size()), control.workers, [&](int i) {
        if (control.progress.cancelled()) return;
        kernels_[std::size_t(i)] = source.make({&set.asks[std::size_t(i)], 1}).front().front();
    });
}

}  // namespace petzval::device
