#include "engine/lights/highlight_kernels.h"

#include "base/cancel.h"

namespace petzval::engine {

// A lens that sees squares of pixels instead of points: each kernel averaged over `size` x `size` places of
// its source, of which the first is the top-left pixel.
class SquareLens final : public kernel::LensModel {
public:
    SquareLens(const kernel::LensModel& lens, int size) : lens_(lens), size_(size) {}

    kernel::PointSpread point_spread(double coc_radius_px, kernel::FieldPosition field) const override {
        kernel::PointSpread point = lens_.point_spread(coc_radius_px, field);
        if (size_ == 1) return point;
        const Rect e = point.extent;
        const int width = e.width(), height = e.height(), more = size_ - 1;
        Picture wide(width + more, height);
        for (int y = 0; y < height; ++y) {
            check_cancelled();
            for (int x = 0; x < width; ++x)
                for (int i = 0; i < size_; ++i) wide(x + i, y) += point.weights(x, y);
        }
        Picture square(width + more, height + more);
        const float share = 1 / float(size_ * size_);
        for (int y = 0; y < height; ++y) {
            check_cancelled();
            for (int x = 0; x < width + more; ++x)
                for (int i = 0; i < size_; ++i) square(x, y + i) += share * wide(x, y);
        }
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

constexpr int kSizes[] = {1, 2, 4, kLargestSquare};

}  // namespace

HighlightKernels::HighlightKernels(const EngineView& input)
    : KernelSource("highlights", device::KernelUse::ByPixel) {
    const kernel::BankOptions options{.columns = 32,
                                      .rows = 18,
                                      .largest_rim_step_px = 0.5,
                                      .aspect = double(input.lens.frame.width()) / input.lens.frame.height(),
                                      .relative_step = 0.005,
                                      .least_step_px = 0.0625,
                                      .max_bytes = std::size_t(64) << 20};
    kernel::BankOptions fine = options;
    fine.relative_step = 0.001, fine.least_step_px = 0.02;
    // Bright discs: final quality gives each the kernel of its own place.
    fine.largest_rim_step_px = input.options.quality == Quality::Final ? 0.01 : 0.1;
    for (const int size : kSizes) {
        lenses_.push_back(std::make_unique<const SquareLens>(input.lens.level(0), size));
        banks_.push_back(std::make_unique<const kernel::KernelBank>(*lenses_.back(), options));
        banks_.push_back(std::make_unique<const kernel::KernelBank>(*lenses_.back(), fine));
    }
}

HighlightKernels::~HighlightKernels() = default;

device::KernelAsk HighlightKernels::ask(const Highlight& h, kernel::FieldPosition field, bool fine) const {
    int size = 0;
    while (kSizes[size] < h.size) ++size;
    const int piece = 2 * size + (fine ? 1 : 0);
    const kernel::KernelBank::Place place = banks_[std::size_t(piece)]->place(double(h.coc_px), field);
    return {.level = 0, .zone = place.cell, .step = place.step, .piece = piece};
}

std::vector<device::KernelSource::Made> HighlightKernels::make(
    std::span<const device::KernelAsk> asks) const {
    std::vector<Made> made;
    for (const device::KernelAsk& ask : asks)
        made.push_back({banks_[std::size_t(ask.piece)]->kernel({ask.step, ask.zone})});
    return made;
}

std::size_t HighlightKernels::bytes() const {
    std::size_t sum = sizeof(*this);
    for (const auto& bank : banks_) sum += bank->bytes_held();
    return sum;
}

}  // namespace petzval::engine
