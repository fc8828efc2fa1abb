#include "engine/lights/highlight_spread.h"

#include "base/parallel.h"
#include "device/cpu/stamp.h"
#include "engine/lights/pupil_shadow.h"
#include "engine/lights/shadow_casters.h"
#include "engine/waist/holdout.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <tuple>

namespace petzval::engine {

using kernel::PointSpread;

// A lens that sees squares of pixels instead of points: each kernel averaged over `size` x `size` places of
// its source, of which the first is the top-left pixel.
class SquareLens final : public kernel::LensModel {
public:
    SquareLens(const kernel::LensModel& lens, int size) : lens_(lens), size_(size) {}

    PointSpread point_spread(double coc_radius_px, kernel::FieldPosition field) const override {
        PointSpread point = lens_.point_spread(coc_radius_px, field);
        if (size_ == 1) return point;
        const Rect e = point.extent;
        const int width = e.width(), height = e.height(), more = size_ - 1;
        Picture wide(width + more, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int i = 0; i < size_; ++i) wide(x + i, y) += point.weights(x, y);
        Picture square(width + more, height + more);
        const float share = 1 / float(size_ * size_);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width + more; ++x)
                for (int i = 0; i < size_; ++i) square(x, y + i) += share * wide(x, y);
        return {Rect{e.x0, e.y0, e.x1 + more, e.y1 + more}, std::move(square), point.neutral};
    }
    std::vector<kernel::PupilRay> rays(int count, kernel::FieldPosition field,
                                       std::uint64_t seed) const override {
        return lens_.rays(count, field, seed);
    }
    double reach_px(double coc_radius_px) const override { return lens_.reach_px(coc_radius_px) + size_; }
    bool varies_over_field() const override { return lens_.varies_over_field(); }
    std::string description() const override { return lens_.description(); }

private:
    const kernel::LensModel& lens_;
    int size_;
};

namespace {

// What is nearer by less than this is the highlight's own surface. (The next pixels of a surface that slopes
// by less than a pixel of radius per pixel lie outside the pupil as the highlight sees them.)
constexpr float kOwnSurfacePx = 0.02f;
// A bright light finds every crack between the squares of a sloping surface.
constexpr float kOverlapPx = 0.02f;
constexpr float kBrightDisc = 0.002f;     // share of white
constexpr float kSlowBrightDisc = 0.03f;  // of lenses whose kernels take long to make
constexpr std::size_t kBatchBytes = std::size_t(64) << 20;

constexpr int kSizes[] = {1, 2, 4, 8};
constexpr int kMostShared = 4;  // pixels on a side that share a view of what is in the way

}  // namespace

HighlightKernels::HighlightKernels(const Input& input) {
    const kernel::BankOptions options{.columns = 32,
                                      .rows = 18,
                                      .largest_rim_step_px = 0.5,
                                      .aspect = double(input.width()) / input.frame_height,
                                      .relative_step = 0.005,
                                      .least_step_px = 0.0625,
                                      .max_bytes = std::size_t(64) << 20};
    kernel::BankOptions fine = options;
    fine.relative_step = 0.001, fine.least_step_px = 0.02;
    // Of bright discs; final quality gives each the kernel of its own place.
    fine.largest_rim_step_px = input.quality == Quality::Final ? 0.01 : 0.1;
    for (const int size : kSizes) {
        lenses_.push_back(std::make_unique<const SquareLens>(input.lens(0), size));
        banks_.push_back(std::make_unique<const kernel::KernelBank>(*lenses_.back(), options));
        fine_banks_.push_back(std::make_unique<const kernel::KernelBank>(*lenses_.back(), fine));
    }
}

HighlightKernels::~HighlightKernels() = default;

std::size_t HighlightKernels::bytes() const {
    std::size_t sum = sizeof(*this);
    for (const auto* banks : {&banks_, &fine_banks_})
        for (const auto& bank : *banks) sum += bank->bytes_held();
    return sum;
}

std::shared_ptr<const PointSpread> HighlightKernels::of(const Highlight& h, kernel::FieldPosition field,
                                                        bool fine) const {
    std::size_t bank = 0;
    while (kSizes[bank] < h.size) ++bank;
    return (fine ? fine_banks_ : banks_)[bank]->kernel(double(h.coc_px), field);
}

namespace {

// Where shadows are looked for from: the middle of a highlight, or of a square of pixels that share one view.
struct Viewpoint {
    float x = 0, y = 0;  // in pixels; the middle of pixel 0 is 0
    float coc_px = 0;
    int size = 1;  // of the highlight
    float own_surface_px = kOwnSurfacePx;

    static Viewpoint of(const Highlight& h) {
        const float middle = 0.5f * float(h.size - 1);
        return {float(h.x) + middle, float(h.y) + middle, h.coc_px, h.size, kOwnSurfacePx};
    }
    // Highlights of one lamp see nearly the same: single pixels in a square so much smaller than their disc
    // that no shadow in it moves by more than half of that square share one view. Of what is nearer by less
    // than a part of its size a square cannot tell whether it is the lamp itself.
    static Viewpoint shared(const Highlight& h, Quality quality) {
        const float radius = std::abs(h.coc_px), two = quality == Quality::Draft ? 12 : 24;
        const int square = quality == Quality::Final || h.size > 1 || radius < two ? 1
                           : radius < 2.5f * two                                   ? 2
                                                                                   : 4;
        if (square == 1) return of(h);
        constexpr float kStepsPerPx = 8;
        const float centre = 0.5f * float(square - 1);
        const int first_x = h.x / square * square, first_y = h.y / square * square;
        return {float(first_x) + centre, float(first_y) + centre,
                std::round(h.coc_px * kStepsPerPx) / kStepsPerPx, 1, 0.25f * float(square)};
    }
    // Offset of the first tap of its disc from a highlight's first pixel.
    int first_tap() const {
        return size / 2 - (size % 2 == 0 ? 1 : 0) - int(std::floor(std::abs(coc_px) + 0.5f));
    }
};

class Spreader {
public:
    Spreader(const Input& input, const HighlightKernels& kernels, const CocSamples& samples, float white)
        : input_(input),
          kernels_(kernels),
          casters_(samples, *input.workers),
          stretch_(float(std::max(1.0, input.pixel_aspect))),
          same_pixel_px_(input.deep_dims_itself ? same_pixel_px(input.pixel_aspect) : 0),
          bright_disc_(white * (input.lens(0).is_quick() ? kBrightDisc : kSlowBrightDisc)) {}

    std::shared_ptr<const PointSpread> kernel(const Highlight& h) const {
        // The rim of a disc that is bright by itself shows a radius that is off by little.
        const float on_disc =
            luminance(h.colour) * float(h.size * h.size) / (float(M_PI) * h.coc_px * h.coc_px + 1);
        return kernels_.of(h, input_.field_at(h.x, h.y), on_disc > bright_disc_);
    }
    // Null: nothing is in the way.
    std::unique_ptr<const PupilShadow> shadow(Viewpoint view) const {
        view.own_surface_px = std::max(view.own_surface_px, same_pixel_px_);
        if (casters_.nearest_coc_px() >= view.coc_px - view.own_surface_px) return nullptr;
        auto shadow = std::make_unique<PupilShadow>(view.coc_px, view.size % 2 == 0);
        if (!collect(view, *shadow)) return nullptr;
        shadow->finish();
        return shadow;
    }

private:
    bool collect(const Viewpoint& view, PupilShadow& shadow) const {
        constexpr int kBlock = ShadowCasters::kBlock;
        bool any = false;
        // Taps at the rim of the disc reach beyond it by half their width.
        const float pupil_end =
            stretch_ + (0.5f + 0.5f * float(view.size)) / std::max(0.5f, std::abs(view.coc_px));
        const auto reach_of = [&](float c) { return (view.coc_px - c) * stretch_ + 1 + float(view.size); };
        const int farthest = int(reach_of(casters_.nearest_coc_px())) + kBlock;
        const Plane& blocks = casters_.nearest_of_blocks();
        const int x = int(view.x), y = int(view.y);
        const Rect near = Rect{(x - farthest) / kBlock, (y - farthest) / kBlock, (x + farthest) / kBlock + 1,
                               (y + farthest) / kBlock + 1}
                              .intersected(blocks.rect());
        for (int by = near.y0; by < near.y1; ++by)
            for (int bx = near.x0; bx < near.x1; ++bx) {
                const float c = blocks(bx, by);
                if (c >= view.coc_px - view.own_surface_px) continue;
                const int dx = std::max({bx * kBlock - x, x - (bx + 1) * kBlock + 1, 0});
                const int dy = std::max({by * kBlock - y, y - (by + 1) * kBlock + 1, 0});
                if (float(dx * dx + dy * dy) > reach_of(c) * reach_of(c)) continue;
                any = cover_block(bx, by, view, pupil_end, shadow) || any;
            }
        return any;
    }

    bool cover_block(int bx, int by, const Viewpoint& view, float pupil_end, PupilShadow& shadow) const {
        bool any = false;
        float done = -1e30f;  // all that is nearer has been seen
        for (int coarse = ShadowCasters::kViews - 1; coarse >= 0; --coarse) {
            const float end =
                std::min(ShadowCasters::end_of_view(coarse, view.coc_px), view.coc_px - view.own_surface_px);
            if (end <= done) continue;
            for (const Caster& caster : casters_.of_block(coarse, bx, by)) {  // nearest first
                if (caster.coc_px > end) break;
                if (caster.coc_px > done) any = cover(view, pupil_end, caster, shadow) || any;
            }
            done = end;
        }
        return any;
    }

    static bool cover(const Viewpoint& view, float pupil_end, const Caster& caster, PupilShadow& shadow) {
        const float apart = view.coc_px - caster.coc_px;
        if (caster.size > 1 && apart < ShadowCasters::kSameRadiusPx) return false;
        const float per_px = 1 / apart;
        const float u = (caster.x - view.x) * per_px, v = (caster.y - view.y) * per_px;
        // A tap sees each pixel of the highlight through another place of the caster's plane, wider apart the
        // further that plane is from focus.
        const float blur =
            float(view.size - 1) * std::abs(caster.coc_px) / std::max(1.0f, std::abs(view.coc_px));
        const float side = caster.size + kOverlapPx;
        if (std::max(std::abs(u), std::abs(v)) - 0.5f * (side + blur) * per_px >= pupil_end) return false;
        shadow.cover(u, v, side * per_px, blur * per_px, caster.coverage);
        return true;
    }

    const Input& input_;
    const HighlightKernels& kernels_;
    ShadowCasters casters_;
    float stretch_;        // of the pupil, vertically, by pixels that are not square
    float same_pixel_px_;  // what is nearer by less has dimmed the light where it was taken; 0: nothing has
    float bright_disc_;
};

// What a highlight sends: a kernel, and the shadow in it, if there is one.
struct Sent {
    std::shared_ptr<const PointSpread> kernel;
    const PupilShadow* shadow = nullptr;
    int first_tap = 0;
};

// out: rows of the picture from first_row on; only those of `rows` are written. Returns what it took.
Work add(const Sent& sent, const Highlight& h, CocSamplesView holdout, const Rect& rows, int first_row,
         View<Rgba> out) {
    const Rect e = sent.kernel->extent;
    const Rect place = Rect{h.x + e.x0, h.y + e.y0, h.x + e.x1, h.y + e.y1}.intersected(rows);
    if (place.empty()) return {};
    const Rgba light = h.colour * float(h.size * h.size);
    std::vector<float> shares(std::size_t(place.width()), 1.0f);
    for (int y = place.y0; y < place.y1; ++y) {
        if (sent.shadow)
            sent.shadow->visible(place.x0 - h.x - sent.first_tap, y - h.y - sent.first_tap, shares);
        if (!holdout.empty())
            for (int x = place.x0; x < place.x1; ++x)
                shares[std::size_t(x - place.x0)] = (sent.shadow ? shares[std::size_t(x - place.x0)] : 1) *
                                                    let_through(holdout, x, y, h.coc_px);
        const Rgba* const weights = sent.kernel->weights.row(y - h.y - e.y0) + (place.x0 - h.x - e.x0);
        add_shares({weights, shares.size()}, light, shares, out.row(y - first_row) + place.x0);
    }
    return Work::of_taps(shares.size() * std::size_t(place.height()));
}

// The views of all highlights; those that nobody shares are the highlight's own.
class Views {
public:
    Views(const std::vector<Highlight>& highlights, Quality quality) {
        std::map<std::tuple<float, float, float, int>, std::size_t> known;
        std::vector<std::size_t> first;  // highlight of each view; those of shared ones are kShared
        for (std::size_t i = 0; i < highlights.size(); ++i) {
            const Viewpoint v = Viewpoint::shared(highlights[i], quality);
            const auto [at, is_new] = known.try_emplace({v.y, v.x, v.coc_px, v.size}, views_.size());
            if (is_new)
                views_.push_back(v), first.push_back(i);
            else
                first[at->second] = kShared;
            of_highlight_.push_back(at->second);
        }
        for (std::size_t v = 0; v < views_.size(); ++v)
            if (first[v] != kShared) views_[v] = Viewpoint::of(highlights[first[v]]);
    }
    // Of the view of highlights [begin, end), each once, ascending.
    std::vector<std::size_t> of_batch(std::size_t begin, std::size_t end) const {
        std::vector<std::size_t> some(of_highlight_.begin() + std::ptrdiff_t(begin),
                                      of_highlight_.begin() + std::ptrdiff_t(end));
        std::sort(some.begin(), some.end());
        some.erase(std::unique(some.begin(), some.end()), some.end());
        return some;
    }
    std::size_t of_highlight(std::size_t i) const { return of_highlight_[i]; }
    const Viewpoint& operator[](std::size_t view) const { return views_[view]; }

private:
    static constexpr std::size_t kShared = std::size_t(-1);
    std::vector<Viewpoint> views_;
    std::vector<std::size_t> of_highlight_;
};

}  // namespace

Work spread_highlights(const Input& input, const HighlightKernels& kernels, const CocSamples& samples,
                       const std::vector<Highlight>& highlights, float white, const Rect& rows,
                       View<Rgba> out) {
    if (highlights.empty()) return {};
    WorkCount work;
    const Spreader spreader(input, kernels, samples, white);
    const Views views(highlights, input.quality);
    const float largest = std::max(std::abs(input.nearest_coc_px), std::abs(input.farthest_coc_px));
    const Rect sending = rows.grown(int(std::ceil(input.lens(0).reach_px(double(largest)))) + 1 + kSizes[3]);
    // Shadows are found in parallel, batch by batch, and light is added in the order of the list: the same
    // bits for any threads.
    for (std::size_t begin = 0; begin < highlights.size() && !input.progress->cancelled();) {
        std::size_t end = begin;
        for (std::size_t bytes = 0; end < highlights.size() && bytes < kBatchBytes; ++end)
            bytes += std::size_t(4 * highlights[end].coc_px * highlights[end].coc_px + 9) * sizeof(float);
        const std::vector<std::size_t> seen = views.of_batch(begin, end);
        std::vector<std::unique_ptr<const PupilShadow>> shadows(seen.size());
        parallel_for(int(seen.size()), *input.workers, [&](int i) {
            const Viewpoint& view = views[seen[std::size_t(i)]];
            if (input.progress->cancelled()) return;
            if (view.y >= float(sending.y0 - kMostShared) && view.y < float(sending.y1 + kMostShared))
                shadows[std::size_t(i)] = spreader.shadow(view);
        });
        std::vector<Sent> sent(end - begin);
        parallel_for(int(sent.size()), *input.workers, [&](int i) {
            const Highlight& h = highlights[begin + std::size_t(i)];
            if (input.progress->cancelled() || h.y < sending.y0 || h.y >= sending.y1) return;
            const std::size_t view = views.of_highlight(begin + std::size_t(i));
            const auto shadow = std::lower_bound(seen.begin(), seen.end(), view) - seen.begin();
            sent[std::size_t(i)] = {spreader.kernel(h), shadows[std::size_t(shadow)].get(),
                                    views[view].first_tap()};
        });
        constexpr int kBand = 32;
        parallel_for((out.height() + kBand - 1) / kBand, *input.workers, [&](int band) {
            const int y = rows.y0 + band * kBand;
            const Rect here = Rect{0, y, out.width(), y + kBand}.intersected(rows);
            Work of_band;
            for (std::size_t i = begin; i < end; ++i)
                if (sent[i - begin].kernel)
                    of_band += add(sent[i - begin], highlights[i], input.holdout, here, rows.y0, out);
            work.add(of_band);
        });
        begin = end;
    }
    return work.sum();
}

}  // namespace petzval::engine
