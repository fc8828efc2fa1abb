// The samples of a picture, by rows: all of a 4K frame at once would be the largest thing that it holds.
#pragma once

#include "base/workspaces.h"
#include "engine/waist/engine.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

namespace petzval::engine {

class SampleSource {
public:
    SampleSource() = default;
    // Requested ranges begin at a multiple of this, and end at one or at the last row.
    static constexpr int kRows = 16;
    // Reads existing samples, which must outlive this.
    SampleSource(const CocSamples& all) : all_(&all), width_(all.width), height_(all.height()) {
        for (const CocSample& s : all.samples)
            largest_coc_px_ = std::max(largest_coc_px_, std::abs(s.coc_px));
    }
    // make(y0, y1, into) makes rows y0…y1-1, from any thread. largest_coc_px: the largest |radius| of all.
    using Make = std::function<void(int, int, CocSamples&)>;
    SampleSource(int width, int height, float largest_coc_px, Make make)
        : make_(std::move(make)), width_(width), height_(height), largest_coc_px_(largest_coc_px) {}

    int width() const { return width_; }
    int height() const { return height_; }
    float largest_coc_px() const { return largest_coc_px_; }
    // use(samples of rows y0…y1-1, counted from y0), which last as long as the call.
    template <typename Use>
    void rows(int y0, int y1, const Use& use) const {
        if (all_) return use(CocSamplesView(*all_).rows(y0, y1));
        const auto made = memory_->take();
        make_(y0, y1, *made);
        use(CocSamplesView(*made));
    }

private:
    const CocSamples* all_ = nullptr;
    Make make_;
    std::shared_ptr<Workspaces<CocSamples>> memory_ = std::make_shared<Workspaces<CocSamples>>();
    int width_ = 0, height_ = 0;
    float largest_coc_px_ = 0;
};

}  // namespace petzval::engine
