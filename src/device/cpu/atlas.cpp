#include "device/cpu/atlas.h"

#include "base/parallel.h"

#include <utility>

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

template <typename Kernel>
std::shared_ptr<const Kernel> KernelTable<Kernel>::find(const KernelAsk& ask) const {
    const std::lock_guard lock(mutex_);
    const auto known = kernels_.find(ask);
    return known == kernels_.end() ? nullptr : known->second;
}

template <typename Kernel>
void KernelTable<Kernel>::add(const KernelAsk& ask, std::shared_ptr<const Kernel> kernel) {
    const std::lock_guard lock(mutex_);
    const std::size_t bytes = kernel->bytes;
    if (kernels_.try_emplace(ask, std::move(kernel)).second) bytes_ += bytes;
}

template <typename Kernel>
std::size_t KernelTable<Kernel>::bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

template <typename Kernel>
void KernelTable<Kernel>::trim(std::size_t max_bytes) {
    const std::lock_guard lock(mutex_);
    for (auto at = kernels_.begin(); at != kernels_.end() && bytes_ > max_bytes;) {
        if (at->second.use_count() > 1) {
            ++at;
            continue;
        }
        bytes_ -= at->second->bytes;
        at = kernels_.erase(at);
    }
}

template <typename Kernel>
LaidOutAtlas<Kernel>::LaidOutAtlas(const KernelSource& source, const KernelSet& set, const std::string& use,
                                   Memory& memory, const Control& control)
    : kernels_(set.asks.size()) {
    const auto table = memory.get<KernelTable<Kernel>>(
        source.name() + " for " + use, [] { return std::make_shared<KernelTable<Kernel>>(); });
    // Asks cut from one kernel of the lens are made together.
    std::vector<std::vector<std::size_t>> missing;
    for (std::size_t i = 0; i < set.asks.size(); ++i) {
        if ((kernels_[i] = table->find(set.asks[i]))) continue;
        if (missing.empty() || !set.asks[i].is_cut_from(set.asks[missing.back().front()]))
            missing.emplace_back();
        missing.back().push_back(i);
    }
    parallel_for(int(missing.size()), control.workers, [&](int group) {
        if (control.progress.cancelled()) return;
        std::vector<KernelAsk> asks;
        for (const std::size_t i : missing[std::size_t(group)]) asks.push_back(set.asks[i]);
        const auto made = source.make(asks);
        for (std::size_t k = 0; k < asks.size(); ++k) {
            auto& kernel = kernels_[missing[std::size_t(group)][k]];
            kernel = Kernel::laid_out(made[k]);
            table->add(asks[k], kernel);
        }
    });
}

template class LaidOutAtlas<StampSet>;
template class LaidOutAtlas<TapKernel>;

SpreadAtlas::SpreadAtlas(const KernelSource& source, const KernelSet& set, const Control& control)
    : kernels_(set.asks.size()) {
    parallel_for(int(kernels_.size()), control.workers, [&](int i) {
        if (control.progress.cancelled()) return;
        kernels_[std::size_t(i)] = source.make({&set.asks[std::size_t(i)], 1}).front().front();
    });
}

}  // namespace petzval::device
