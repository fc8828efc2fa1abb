#include "engine/lights/plan.h"

#include "laws/surfaces.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace petzval::engine {
namespace {

constexpr float kBrightDisc = 0.002f;     // share of white
constexpr float kSlowBrightDisc = 0.03f;  // of lenses whose kernels take long to make
constexpr std::size_t kBatchBytes = std::size_t(64) << 20;

Viewpoint own_viewpoint(const Highlight& h) {
    const float middle = 0.5f * float(h.size - 1);
    return {float(h.x) + middle, float(h.y) + middle, h.coc_px, h.size, laws::kOwnTapPx, h.is_shown};
}

// Highlights of one lamp share almost the same view: single pixels in a square share one viewpoint if the
// square is so much smaller than their disc that no shadow in it moves by more than half of that square. A
// square cannot distinguish an occluder that is nearer by less than a fraction of its size from the lamp
// itself.
Viewpoint shared_viewpoint(const Highlight& h, Quality quality) {
    const float radius = std::abs(h.coc_px), two = quality == Quality::Draft ? 8 : 24;
    const int square = quality == Quality::Final || h.size > 1 || radius < two ? 1
                       : radius < 2.5f * two                                   ? 2
                                                                               : 4;
    if (square == 1) return own_viewpoint(h);
    constexpr float kStepsPerPx = 8;
    const float centre = 0.5f * float(square - 1);
    const int first_x = h.x / square * square, first_y = h.y / square * square;
    return {float(first_x) + centre,
            float(first_y) + centre,
            std::round(h.coc_px * kStepsPerPx) / kStepsPerPx,
            1,
            0.25f * float(square),
            false};
}

}  // namespace

LightsPlanner::LightsPlanner(const EngineView& strip, const HighlightKernels& kernels,
                             const ShadowCasters& casters, const std::vector<Highlight>& highlights,
                             float white, const Rect& rows, int first_row,
                             const std::vector<Highlight>* asked_by)
    : input_(strip),
      kernels_(kernels),
      highlights_(highlights),
      asked_by_(asked_by ? *asked_by : highlights),
      casters_(casters),
      bright_disc_(white * (strip.lens.level(0).is_quick() ? kBrightDisc : kSlowBrightDisc)),
      rows_(rows),
      first_row_(first_row) {
    find_viewpoints();
    const float largest =
        std::max(std::abs(strip.samples.nearest_coc_px), std::abs(strip.samples.farthest_coc_px));
    sending_ = rows.grown(int(std::ceil(strip.lens.level(0).reach_px(double(largest)))) + 1 + kLargestSquare);
}

// Viewpoints that nobody shares are the highlight's own.
void LightsPlanner::find_viewpoints() {
    std::map<std::tuple<float, float, float, int, bool>, std::size_t> known;
    constexpr std::size_t kShared = std::size_t(-1);
    std::vector<std::size_t> first;  // highlight of each viewpoint; those of shared ones are kShared
    for (std::size_t i = 0; i < highlights_.size(); ++i) {
        const Viewpoint v = shared_viewpoint(highlights_[i], input_.options.quality);
        const auto [at, is_new] =
            known.try_emplace({v.y, v.x, v.coc_px, v.size, v.is_shown}, viewpoints_.size());
        if (is_new)
            viewpoints_.push_back(v), first.push_back(i);
        else
            first[at->second] = kShared;
        viewpoint_of_.push_back(at->second);
    }
    for (std::size_t v = 0; v < viewpoints_.size(); ++v)
        if (first[v] != kShared) viewpoints_[v] = own_viewpoint(highlights_[first[v]]);
    // In a deep picture, what lies nearer within one pixel is itself.
    const float least = input_.samples.deep_dims_itself ? same_pixel_px(input_.lens.pixel_aspect) : 0;
    for (Viewpoint& v : viewpoints_)
        if (!v.is_shown) v.own_surface_px = std::max(v.own_surface_px, least);
}

device::KernelAsk LightsPlanner::ask(const Highlight& h) const {
    const float light = luminance(h.colour) * float(h.size * h.size);
    const auto bright_on = [&](float radius_px) {
        return light > bright_disc_ * (float(M_PI) * radius_px * radius_px + 1);
    };
    Seen seen = Seen::Nothing;
    if (bright_on(h.coc_px)) seen = Seen::Disc;
    if (bright_on(float(input_.lens.level(0).reach_px(double(h.coc_px))))) seen = Seen::DiscAndRim;
    return kernels_.ask(h, input_.lens.field_at(h.x, h.y), seen);
}

bool LightsPlanner::next(LightsPlan& plan) {
    plan = {};
    plan.rows = rows_, plan.first_row = first_row_, plan.casters = &casters_;
    plan.kept = &kept_;
    plan.holdout = input_.samples.holdout;
    plan.picture = input_.samples.coc_px.rect(), plan.open_edges = input_.window.open_edges;
    plan.stretch = float(std::max(1.0, input_.lens.pixel_aspect));
    std::vector<std::uint32_t> placed(viewpoints_.size(), 0);  // place in the plan, from 1 on
    std::vector<device::KernelAsk> asks;
    std::set<device::KernelAsk> asked;
    for (std::size_t bytes = 0; next_ < highlights_.size() && bytes < kBatchBytes; ++next_) {
        const Highlight& h = highlights_[next_];
        bytes += std::size_t(4 * h.coc_px * h.coc_px + 9) * sizeof(float);
        if (h.y < sending_.y0 || h.y >= sending_.y1) continue;
        std::uint32_t& viewpoint = placed[viewpoint_of_[next_]];
        if (viewpoint == 0) {
            plan.viewpoints.push_back(viewpoints_[viewpoint_of_[next_]]);
            viewpoint = std::uint32_t(plan.viewpoints.size());
        }
        plan.lights.push_back({h, viewpoint - 1, 0});
        asks.push_back(ask(asked_by_[next_]));
        if (asked.insert(asks.back()).second) {
            const double side = 2 * input_.lens.level(0).reach_px(double(h.coc_px)) + 1;
            bytes += std::size_t(side * side) * sizeof(Rgba);
        }
    }
    std::vector<device::KernelAsk>& set = plan.kernels.asks;
    set.assign(asked.begin(), asked.end());
    for (std::size_t i = 0; i < asks.size(); ++i)
        plan.lights[i].kernel =
            std::uint32_t(std::lower_bound(set.begin(), set.end(), asks[i]) - set.begin());
    return !plan.lights.empty() || next_ < highlights_.size();
}

}  // namespace petzval::engine
