#include "device/cpu/mix.h"

#include "base/parallel.h"
#include "device/cpu/blur.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::device {

using namespace engine;

namespace {

constexpr float kLeastArea = 1e-5f;

class Mixer {
public:
    Mixer(const GaussianPlan& plan, const Control& control)
        : plan_(plan),
          workers_(control.workers),
          width_(plan.colour.width()),
          height_(plan.colour.height()) {}

    void run(View<Rgba> out) {
        make_layers();
        constexpr int kBand = 16;
        parallel_for((height_ + kBand - 1) / kBand, workers_, [&](int band) {
            Readers readers(layers_.size());
            for (std::size_t k = 0; k < layers_.size(); ++k)
                if (is_used(k)) readers[k] = BlurReader(layers_[k], plan_.blurs[k].level, width_);
            for (int y = band * kBand; y < std::min(height_, (band + 1) * kBand); ++y) {
                for (std::size_t k = 0; k < layers_.size(); ++k)
                    if (is_used(k)) readers[k].go_to_row(y);
                for (int x = 0; x < width_; ++x)
                    out(x, y) = is_layered() ? composite(readers, x, y) : mixed(readers, x, y);
            }
        });
    }

private:
    using Readers = std::vector<BlurReader>;
    bool is_layered() const { return plan_.law == GaussianPlan::Law::Layered; }
    bool is_used(std::size_t blur) const { return plan_.blurs[blur].is_used(); }

    // Rows are shared out by cells of the coarsest.
    void make_layers() {
        int coarsest = 0;
        for (const Blur& blur : plan_.blurs) {
            layers_.emplace_back(blur);
            per_cell_.push_back(std::ldexp(1.0f, -2 * blur.level));
            coarsest = std::max(coarsest, blur.level);
        }
        const int size = 1 << coarsest;
        parallel_for((height_ + size - 1) / size, workers_, [&](int row) {
            for (int y = row * size; y < std::min(height_, (row + 1) * size); ++y)
                for (int x = 0; x < width_; ++x) deposit(x, y);
        });
        for (std::size_t k = 0; k < layers_.size(); ++k)
            if (is_used(k)) blur_layer(layers_[k], plan_.blurs[k], workers_);
    }

    void deposit(int x, int y) {
        const Rgba colour = plan_.colour(x, y);
        const auto add = [&](std::size_t blur, float share) {
            if (share <= 0 || !is_used(blur)) return;
            const int level = plan_.blurs[blur].level;
            const float part = share * per_cell_[blur];
            layers_[blur].light(x >> level, y >> level) += part * colour;
            layers_[blur].covered(x >> level, y >> level) += part;
        };
        if (!is_layered()) {
            add(GaussianPlan::kSmall, 1);
            add(GaussianPlan::kLarge, 1);
            return;
        }
        const bool near = plan_.coc_px(x, y) < 0;
        const MixWeights w = plan_.weights(x, y);
        add(near ? GaussianPlan::kNearSmall : GaussianPlan::kFarSmall, w.small);
        add(near ? GaussianPlan::kNearLarge : GaussianPlan::kFarLarge, w.large);
        add(GaussianPlan::kBackdrop, near ? w.sharp : 1);
    }

    // Each layer takes of the pixel's lens what it arrives with, or what is left.
    Rgba composite(const Readers& readers, int x, int y) const {
        Rgba sum;
        float free = 1;
        const auto take = [&](Rgba light, float covered) {
            if (covered <= kLeastArea) return;
            const float taken = std::min(covered, free);
            sum += (taken / covered) * light;
            free -= taken;
        };
        const auto take_layer = [&](std::size_t blur) {
            if (is_used(blur)) take(readers[blur].light(x), readers[blur].covered(x));
        };
        take_layer(GaussianPlan::kNearLarge);
        take_layer(GaussianPlan::kNearSmall);
        const float sharp = plan_.weights(x, y).sharp;
        take(sharp * plan_.colour(x, y), sharp);
        take_layer(GaussianPlan::kFarSmall);
        take_layer(GaussianPlan::kFarLarge);
        // Under the soft edge of something near: what lies around it. Else: more of what was seen.
        if (free > kLeastArea && plan_.coc_px(x, y) < 0 && is_used(GaussianPlan::kBackdrop)) {
            const BlurReader& backdrop = readers[GaussianPlan::kBackdrop];
            if (backdrop.covered(x) > kLeastArea) {
                sum += (free / backdrop.covered(x)) * backdrop.light(x);
                free = 0;
            }
        }
        return free < 1 - kLeastArea ? sum * (1 / (1 - free)) : plan_.colour(x, y);
    }

    // The three pictures by the pixel's weights; or one of them.
    Rgba mixed(const Readers& readers, int x, int y) const {
        const BlurReader &small = readers[GaussianPlan::kSmall], &large = readers[GaussianPlan::kLarge];
        const MixWeights w = plan_.weights(x, y);
        switch (plan_.view) {
            case GaussianView::BlurSmall:
                return small.light(x);
            case GaussianView::BlurLarge:
                return large.light(x);
            case GaussianView::FocusIndex:
                return {w.sharp, w.sharp, w.sharp, 1};
            default:
                break;
        }
        const Rgba sharp = plan_.colour(x, y);
        return w.sharp == 1 ? sharp : w.sharp * sharp + w.small * small.light(x) + w.large * large.light(x);
    }

    const GaussianPlan& plan_;
    Workers& workers_;
    int width_, height_;
    std::vector<BlurLayer> layers_;  // as the plan's blurs
    std::vector<float> per_cell_;    // of a pixel
};

}  // namespace

void mix_blurs(const GaussianPlan& plan, View<Rgba> out, const Control& control) {
    Mixer(plan, control).run(out);
}

}  // namespace petzval::device
