#include "engine/highlight_spread.h"

#include "base/parallel.h"
#include "engine/holdout.h"
#include "engine/pupil_shadow.h"
#include "engine/shadow_casters.h"
#include "engine/stamp.h"

#include <algorithm>
#include <cmath>
#include <memory>

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

std::shared_ptr<const PointSpread> HighlightKernels::of(const Highlight& h, kernel::FieldPosition field,
                                                        bool fine) const {
    std::size_t bank = 0;
    while (kSizes[bank] < h.size) ++bank;
    return (fine ? fine_banks_ : banks_)[bank]->kernel(double(h.coc_px), field);
}

namespace {

class Spreader {
public:
    Spreader(const Input& input, const HighlightKernels& kernels, const CocSamples& samples, float white)
        : input_(input),
          kernels_(kernels),
          casters_(samples, input.threads),
          stretch_(float(std::max(1.0, input.pixel_aspect))),
          bright_disc_(white * (input.lens(0).is_quick() ? kBrightDisc : kSlowBrightDisc)) {}

    // What a highlight sends: a kernel, and the shadow in it.
    struct Sent {
        std::shared_ptr<const PointSpread> kernel;
        std::unique_ptr<const PupilShadow> shadow;  // null: there is none
    };
    Sent sent(const Highlight& h) const {
        // The rim of a disc that is bright by itself shows a radius that is off by little.
        const float on_disc =
            luminance(h.colour) * float(h.size * h.size) / (float(M_PI) * h.coc_px * h.coc_px + 1);
        auto open = kernels_.of(h, input_.field_at(h.x, h.y), on_disc > bright_disc_);
        if (casters_.nearest_coc_px() >= h.coc_px - kOwnSurfacePx) return {std::move(open), nullptr};
        auto shadow = std::make_unique<PupilShadow>(h.coc_px, h.size % 2 == 0);
        if (!collect(h, *shadow)) shadow.reset();
        return {std::move(open), std::move(shadow)};
    }

private:
    bool collect(const Highlight& h, PupilShadow& shadow) const {
        constexpr int kBlock = ShadowCasters::kBlock;
        bool any = false;
        // Taps at the rim of the disc reach beyond it by half their width.
        const float pupil_end = stretch_ + (0.5f + 0.5f * float(h.size)) / std::max(0.5f, std::abs(h.coc_px));
        const auto reach_of = [&](float c) { return (h.coc_px - c) * stretch_ + 1 + float(h.size); };
        const int farthest = int(reach_of(casters_.nearest_coc_px())) + kBlock;
        const Plane& blocks = casters_.nearest_of_blocks();
        const Rect near = Rect{(h.x - farthest) / kBlock, (h.y - farthest) / kBlock,
                               (h.x + farthest) / kBlock + 1, (h.y + farthest) / kBlock + 1}
                              .intersected(blocks.rect());
        for (int by = near.y0; by < near.y1; ++by)
            for (int bx = near.x0; bx < near.x1; ++bx) {
                const float c = blocks(bx, by);
                if (c >= h.coc_px - kOwnSurfacePx) continue;
                const int dx = std::max({bx * kBlock - h.x, h.x - (bx + 1) * kBlock + 1, 0});
                const int dy = std::max({by * kBlock - h.y, h.y - (by + 1) * kBlock + 1, 0});
                if (float(dx * dx + dy * dy) > reach_of(c) * reach_of(c)) continue;
                for (const Caster& caster : casters_.of_block(bx, by)) {
                    if (h.coc_px - caster.coc_px < kOwnSurfacePx) break;  // nearest first
                    any = cover(h, pupil_end, caster, shadow) || any;
                }
            }
        return any;
    }

    static bool cover(const Highlight& h, float pupil_end, const Caster& caster, PupilShadow& shadow) {
        const float apart = h.coc_px - caster.coc_px;
        if (caster.size > 1 && apart < ShadowCasters::kSameRadiusPx) return false;
        const float per_px = 1 / apart;
        const float middle = 0.5f * float(h.size - 1);
        const float u = (caster.x - float(h.x) - middle) * per_px,
                    v = (caster.y - float(h.y) - middle) * per_px;
        // A tap sees each pixel of the highlight through another place of the caster's plane, wider apart the
        // further that plane is from focus.
        const float blur = float(h.size - 1) * std::abs(caster.coc_px) / std::max(1.0f, std::abs(h.coc_px));
        const float side = caster.size + kOverlapPx;
        if (std::max(std::abs(u), std::abs(v)) - 0.5f * (side + blur) * per_px >= pupil_end) return false;
        shadow.cover(u, v, side * per_px, blur * per_px, caster.coverage);
        return true;
    }

    const Input& input_;
    const HighlightKernels& kernels_;
    ShadowCasters casters_;
    float stretch_;  // of the pupil, vertically, by pixels that are not square
    float bright_disc_;
};

// Offset of the first tap of a highlight's disc from its first pixel.
int first_tap(const Highlight& h) {
    return h.size / 2 - (h.size % 2 == 0 ? 1 : 0) - int(std::floor(std::abs(h.coc_px) + 0.5f));
}

// out: rows of the picture from first_row on; only those of `rows` are written.
void add(const Spreader::Sent& sent, const Highlight& h, CocSamplesView holdout, const Rect& rows,
         int first_row, View<Rgba> out) {
    const Rect e = sent.kernel->extent;
    const Rect place = Rect{h.x + e.x0, h.y + e.y0, h.x + e.x1, h.y + e.y1}.intersected(rows);
    if (place.empty()) return;
    const Rgba light = h.colour * float(h.size * h.size);
    std::vector<float> shares(std::size_t(place.width()), 1.0f);
    for (int y = place.y0; y < place.y1; ++y) {
        const int first = first_tap(h);
        if (sent.shadow) sent.shadow->visible(place.x0 - h.x - first, y - h.y - first, shares);
        if (!holdout.empty())
            for (int x = place.x0; x < place.x1; ++x)
                shares[std::size_t(x - place.x0)] = (sent.shadow ? shares[std::size_t(x - place.x0)] : 1) *
                                                    let_through(holdout, x, y, h.coc_px);
        const Rgba* const weights = sent.kernel->weights.row(y - h.y - e.y0) + (place.x0 - h.x - e.x0);
        add_shares({weights, shares.size()}, light, shares, out.row(y - first_row) + place.x0);
    }
}

}  // namespace

void spread_highlights(const Input& input, const HighlightKernels& kernels, const CocSamples& samples,
                       const std::vector<Highlight>& highlights, float white, const Rect& rows,
                       View<Rgba> out) {
    if (highlights.empty()) return;
    const Spreader spreader(input, kernels, samples, white);
    const float largest = std::max(std::abs(input.nearest_coc_px), std::abs(input.farthest_coc_px));
    const Rect sending = rows.grown(int(std::ceil(input.lens(0).reach_px(double(largest)))) + 1 + kSizes[3]);
    // Shadows are found in parallel, batch by batch, and light is added in the order of the list: the same
    // bits for any threads.
    for (std::size_t begin = 0; begin < highlights.size() && !input.progress->cancelled();) {
        std::size_t end = begin;
        for (std::size_t bytes = 0; end < highlights.size() && bytes < kBatchBytes; ++end)
            bytes += std::size_t(4 * highlights[end].coc_px * highlights[end].coc_px + 9) * sizeof(float);
        std::vector<Spreader::Sent> sent(end - begin);
        parallel_for(int(sent.size()), input.threads, [&](int i) {
            const Highlight& h = highlights[begin + std::size_t(i)];
            if (input.progress->cancelled()) return;
            if (h.y >= sending.y0 && h.y < sending.y1) sent[std::size_t(i)] = spreader.sent(h);
        });
        constexpr int kBand = 32;
        parallel_for((out.height() + kBand - 1) / kBand, input.threads, [&](int band) {
            const int y = rows.y0 + band * kBand;
            const Rect here = Rect{0, y, out.width(), y + kBand}.intersected(rows);
            for (std::size_t i = begin; i < end; ++i)
                if (sent[i - begin].kernel)
                    add(sent[i - begin], highlights[i], input.holdout, here, rows.y0, out);
        });
        begin = end;
    }
}

}  // namespace petzval::engine
