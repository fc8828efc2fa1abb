// Kernels of a set laid out for a device, made in parallel, kept in memory under the name of their source.
#pragma once

#include "base/parallel.h"
#include "device/device.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace petzval::device {

// The smallest part of a kernel's weights that holds all its light.
inline Rect lit_part(View<const Rgba> weights) {
    Rect lit{weights.width(), weights.height(), 0, 0};
    for (int y = 0; y < weights.height(); ++y) {
        const Rgba* const row = weights.row(y);
        int begin = 0, end = weights.width();
        while (begin < end && row[begin] == Rgba{}) ++begin;
        if (begin == end) continue;
        while (row[end - 1] == Rgba{}) --end;
        lit = {std::min(lit.x0, begin), std::min(lit.y0, y), std::max(lit.x1, end), y + 1};
    }
    return lit.empty() ? Rect{} : lit;
}

// All that was made of one source and not dropped yet. Of a Kernel are asked laid_out() and bytes.
template <typename Kernel>
class KernelTable final : public Memory::Thing {
public:
    std::shared_ptr<const Kernel> find(const KernelAsk& ask) const {
        const std::lock_guard lock(mutex_);
        const auto known = kernels_.find(ask);
        return known == kernels_.end() ? nullptr : known->second;
    }
    void add(const KernelAsk& ask, std::shared_ptr<const Kernel> kernel) {
        const std::lock_guard lock(mutex_);
        const std::size_t bytes = kernel->bytes;
        if (kernels_.try_emplace(ask, std::move(kernel)).second) bytes_ += bytes;
    }
    std::size_t bytes() const override {
        const std::lock_guard lock(mutex_);
        return bytes_;
    }
    // Those that no atlas holds.
    void trim(std::size_t max_bytes) override {
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

private:
    mutable std::mutex mutex_;
    std::map<KernelAsk, std::shared_ptr<const Kernel>> kernels_;
    std::size_t bytes_ = 0;
};

// In the order of the set; incomplete once cancelled. use: what they are laid out for, in a word.
template <typename Kernel>
std::vector<std::shared_ptr<const Kernel>> laid_out(const KernelSource& source, const KernelSet& set,
                                                    const std::string& use, Memory& memory,
                                                    const Control& control) {
    std::vector<std::shared_ptr<const Kernel>> kernels(set.asks.size());
    const auto table = memory.get<KernelTable<Kernel>>(
        source.name() + " for " + use, [] { return std::make_shared<KernelTable<Kernel>>(); });
    // Asks cut from one kernel of the lens are made together.
    std::vector<std::vector<std::size_t>> missing;
    for (std::size_t i = 0; i < set.asks.size(); ++i) {
        if ((kernels[i] = table->find(set.asks[i]))) continue;
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
            auto& kernel = kernels[missing[std::size_t(group)][k]];
            kernel = Kernel::laid_out(made[k]);
            table->add(asks[k], kernel);
        }
    });
    return kernels;
}

}  // namespace petzval::device
