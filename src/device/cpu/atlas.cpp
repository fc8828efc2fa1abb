#include "device/cpu/atlas.h"

#include "base/parallel.h"

#include <utility>

namespace petzval::device {
namespace {

std::shared_ptr<const StampSet> laid_out(const KernelSource::Made& spreads) {
    auto set = std::make_shared<StampSet>();
    for (const auto& spread : spreads) {
        const engine::StampKernel& kernel = set->kernels.emplace_back(*spread);
        set->taps += std::size_t(kernel.groups() * engine::StampKernel::kGroup * kernel.extent().height());
        set->bytes += kernel.bytes() + sizeof(kernel);
    }
    set->bytes += sizeof(*set);
    return set;
}

}  // namespace

std::shared_ptr<const StampSet> StampTable::find(const KernelAsk& ask) const {
    const std::lock_guard lock(mutex_);
    const auto known = kernels_.find(ask);
    return known == kernels_.end() ? nullptr : known->second;
}

void StampTable::add(const KernelAsk& ask, std::shared_ptr<const StampSet> kernels) {
    const std::lock_guard lock(mutex_);
    const std::size_t bytes = kernels->bytes;
    if (kernels_.try_emplace(ask, std::move(kernels)).second) bytes_ += bytes;
}

std::size_t StampTable::bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

void StampTable::trim(std::size_t max_bytes) {
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

StampAtlas::StampAtlas(const KernelSource& source, const KernelSet& set, Memory& memory,
                       const Control& control)
    : kernels_(set.asks.size()) {
    const auto table = memory.get<StampTable>(source.name() + " for stamping",
                                              [] { return std::make_shared<StampTable>(); });
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
            auto& kernels = kernels_[missing[std::size_t(group)][k]];
            kernels = laid_out(made[k]);
            table->add(asks[k], kernels);
        }
    });
}

SpreadAtlas::SpreadAtlas(const KernelSource& source, const KernelSet& set, const Control& control)
    : kernels_(set.asks.size()) {
    parallel_for(int(kernels_.size()), control.workers, [&](int i) {
        if (control.progress.cancelled()) return;
        kernels_[std::size_t(i)] = source.make({&set.asks[std::size_t(i)], 1}).front().front();
    });
}

}  // namespace petzval::device
