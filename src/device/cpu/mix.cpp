#include "device/cpu/mix.h"

#include "base/parallel.h"
#include "base/workspaces.h"
#include "device/cpu/blur.h"
#include "engine/waist/cells.h"
#include "laws/compositing.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::device {

using namespace engine;

namespace {

using laws::kLeastBlurred;

// Light that a band of rows adds to the cells of a layer above and below its own.
struct Rim {
    int row = -1;
    std::vector<Rgba> light;
    std::vector<float> covered;
    LitCells lit;
};

class Mixer {
public:
    Mixer(const GaussianPlan& plan, const Control& control)
        : plan_(plan),
          workers_(control.workers),
          passed_(control.passed),
          width_(plan.colour.width()),
          height_(plan.colour.height()) {}

    void run(View<Rgba> out) {
        make_layers();
        const int across = (width_ + BlurTile::kWidth - 1) / BlurTile::kWidth,
                  down = (height_ + BlurTile::kHeight - 1) / BlurTile::kHeight;
        Workspaces<Workspace> workspaces;
        parallel_for(across * down, workers_, [&](int i) {
            const int x = i % across * BlurTile::kWidth, y = i / across * BlurTile::kHeight;
            const auto workspace = workspaces.take();
            mix_tile(Rect{x, y, x + BlurTile::kWidth, y + BlurTile::kHeight}.intersected(out.rect()),
                     *workspace, out);
        });
        passed("mix");
    }

private:
    // Memory that a worker keeps between tiles.
    struct Workspace {
        std::vector<BlurTile> narrow;
        BlurScratch scratch;
        std::vector<BlurReader> all;               // as the plan's blurs
        std::vector<const BlurReader*> near, far;  // of the layers that are seen in this row, nearest first
    };

    void mix_tile(const Rect& tile, Workspace& w, View<Rgba> out) const {
        if (w.all.empty()) make_readers(w);
        make_narrow(tile, w);
        for (int y = tile.y0; y < tile.y1; ++y) {
            w.near.clear(), w.far.clear();
            for (std::size_t k = 0; k < w.all.size(); ++k) {
                const bool is_near = k < std::size_t(plan_.near.count());
                if (w.all[k].go_to_row(y, {tile.x0, tile.x1}))
                    (is_near ? w.near : w.far).push_back(&w.all[k]);
            }
            for (int x = tile.x0; x < tile.x1; ++x)
                out(x, y) = is_layered() ? composite(w, x, y) : mixed(w.all, x, y);
        }
    }

    void make_readers(Workspace& w) const {
        for (std::size_t k = 0; k < plan_.blurs.size(); ++k)
            if (is_narrow(k)) w.narrow.emplace_back(plan_.blurs[k]);
        for (std::size_t k = 0, narrow = 0; k < plan_.blurs.size(); ++k) {
            if (is_narrow(k))
                w.all.emplace_back(w.narrow[narrow++]);
            else
                w.all.emplace_back(layers_[k], across_[k], down_[k]);
        }
    }

    void make_narrow(const Rect& tile, Workspace& w) const {
        Rect window = tile;
        std::vector<BlurTile*> of_blur(plan_.blurs.size());
        for (std::size_t k = 0, narrow = 0; k < plan_.blurs.size(); ++k) {
            if (!is_narrow(k)) continue;
            BlurTile& blur = *(of_blur[k] = &w.narrow[narrow++]);
            blur.go_to(tile);
            const Rect own = blur.window();
            window = {std::min(window.x0, own.x0), std::min(window.y0, own.y0), std::max(window.x1, own.x1),
                      std::max(window.y1, own.y1)};
        }
        if (w.narrow.empty()) return;
        window = window.intersected({0, 0, width_, height_});
        for (int y = window.y0; y < window.y1; ++y)
            for (int x = window.x0; x < window.x1; ++x)
                spread(x, y, [&](std::size_t k, Rgba light, float covered) {
                    if (of_blur[k] && of_blur[k]->window().contains(x, y))
                        of_blur[k]->add(x, y, light, covered);
                });
        for (BlurTile& blur : w.narrow) blur.blur(w.scratch);
    }

    void passed(const char* pass) const {
        if (passed_) passed_(pass);
    }
    bool is_layered() const { return plan_.law == GaussianPlan::Law::Layered; }
    bool is_narrow(std::size_t blur) const { return plan_.blurs[blur].is_narrow(); }

    // Makes the layers of all blurs that are not narrow.
    void make_layers() {
        int coarsest = 4;
        for (const Blur& blur : plan_.blurs) {
            layers_.push_back(blur.is_narrow() ? BlurLayer() : BlurLayer(blur));
            across_.emplace_back(blur.level, blur.cells_across());
            down_.emplace_back(blur.level, blur.cells_down());
            coarsest = std::max(coarsest, blur.level);
        }
        // Bands are whole cells of the coarsest. What one puts into the cells beside it is added later, in
        // the order of bands, so that no two write to one cell and sums do not depend on threads.
        const int size = 1 << coarsest, bands = (height_ + size - 1) / size;
        std::vector<std::vector<Rim>> rims(static_cast<std::size_t>(bands));
        parallel_for(bands, workers_, [&](int band) {
            rims[std::size_t(band)] = deposit(band * size, std::min(height_, (band + 1) * size));
        });
        for (const auto& of_band : rims)
            for (std::size_t i = 0; i < of_band.size(); ++i) add_rim(layers_[i / 2], of_band[i]);
        passed("spread");
        for (std::size_t k = 0; k < layers_.size(); ++k)
            if (!is_narrow(k)) blur_layer(layers_[k], plan_.blurs[k], workers_);
        passed("blur");
    }

    // Pixel rows begin…end-1, which are whole cells; returns two rims for each layer.
    std::vector<Rim> deposit(int begin, int end) {
        std::vector<RowOfLight> rows;
        for (const CellSplines& across : across_) rows.emplace_back(across);
        std::vector<Rim> rims(2 * layers_.size());
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < width_; ++x)
                spread(x, y, [&](std::size_t k, Rgba light, float covered) {
                    if (!is_narrow(k)) rows[k].add(x, light, covered);
                });
            for (std::size_t k = 0; k < layers_.size(); ++k) {
                if (rows[k].empty()) continue;
                rows[k].fold_ends();
                const CellSplines& down = down_[k];
                const float per_row = std::ldexp(1.0f, -2 * down.level());
                const int first = down.cell(begin), last = down.cell(end - 1);
                for (int i = 0; i < 3; ++i) {
                    const int row = down.cell(y, i);
                    const float share = per_row * down.shares(y)[std::size_t(i)];
                    if (share <= 0) continue;
                    if (row >= first && row <= last)
                        rows[k].add_to(layers_[k].light.row(row), layers_[k].covered.row(row),
                                       layers_[k].lit[std::size_t(row)], share);
                    else
                        add_to_rim(rows[k], rims[2 * k + (row > last)], row, share);
                }
                rows[k].clear();
            }
        }
        return rims;
    }

    static void add_to_rim(const RowOfLight& from, Rim& rim, int row, float share) {
        if (rim.row < 0) rim.row = row, rim.light.resize(from.size()), rim.covered.resize(from.size());
        from.add_to(rim.light.data(), rim.covered.data(), rim.lit, share);
    }

    static void add_rim(BlurLayer& layer, const Rim& rim) {
        if (rim.row < 0) return;
        for (int x = rim.lit.begin; x < rim.lit.end; ++x) {
            layer.light(x, rim.row) += rim.light[std::size_t(x)];
            layer.covered(x, rim.row) += rim.covered[std::size_t(x)];
        }
        layer.lit[std::size_t(rim.row)].add(rim.lit);
    }

    // The light of a pixel, as add(blur, light, covered).
    template <typename Add>
    void spread(int x, int y, const Add& add) const {
        if (!is_layered()) {
            for (std::size_t k = 0; k < plan_.blurs.size(); ++k) add(k, plan_.colour(x, y), 1.0f);
            return;
        }
        plan_.for_each_sample(x, y, [&](const LayeredSample& s) {
            const auto share_out = [&](int k, float share) {
                if (k > 0 && share > 0)
                    add(s.coc_px < 0 ? plan_.near_blur(k) : plan_.far_blur(k), share * s.light,
                        share * s.covered);
            };
            share_out(s.mix.lower, 1 - s.mix.upper_share);
            share_out(s.mix.lower + 1, s.mix.upper_share);
        });
    }

    static float sharp_share(const BlurStack::Mix& mix) { return mix.lower == 0 ? 1 - mix.upper_share : 0; }

    // Each layer takes the lens area that it arrives with, or the area that is left.
    Rgba composite(const Workspace& w, int x, int y) const {
        Rgba sum;
        float free = 1;
        const auto take = [&](Rgba light, float covered) {
            if (covered <= kLeastBlurred) return;
            const float taken = std::min(covered, free);
            sum += (taken / covered) * light;
            free -= taken;
        };
        const auto take_layers = [&](const std::vector<const BlurReader*>& layers) {
            for (const BlurReader* layer : layers)
                if (layer->is_lit(x) && free > 0) take(layer->light(x), layer->covered(x));
        };
        take_layers(w.near);
        plan_.for_each_sample(x, y, [&](const LayeredSample& s) {
            const float sharp = sharp_share(s.mix);
            take(sharp * s.light, sharp * s.covered);
        });
        take_layers(w.far);
        return free < 1 - kLeastBlurred ? sum * (1 / (1 - free)) : plan_.colour(x, y);
    }

    // Mixes two pictures by the pixel's weights, or takes one of them.
    Rgba mixed(const std::vector<BlurReader>& blurs, int x, int y) const {
        const Rgba sharp = plan_.colour(x, y);
        switch (plan_.view) {
            case GaussianView::BlurSmall:
                return blurs[GaussianPlan::kSmall].light(x);
            case GaussianView::BlurLarge:
            case GaussianView::BlurRows:
                return blurs[GaussianPlan::kLarge].light(x);
            case GaussianView::FocusIndex: {
                const float index = plan_.focus_index(x, y);
                return {index, index, index, 1};
            }
            default:
                break;
        }
        if (plan_.law == GaussianPlan::Law::ByDepth) {
            const MixWeights w = plan_.depth(x, y);
            return w.sharp == 1 ? sharp
                                : w.sharp * sharp + w.small * blurs[GaussianPlan::kSmall].light(x) +
                                      w.large * blurs[GaussianPlan::kLarge].light(x);
        }
        const BlurStack::Mix mix = plan_.far(std::abs(plan_.coc_px(x, y)));
        const auto picture = [&](int k) { return k == 0 ? sharp : blurs[plan_.far_blur(k)].light(x); };
        const Rgba lower = picture(mix.lower);
        return mix.upper_share > 0 ? lower + mix.upper_share * (picture(mix.lower + 1) - lower) : lower;
    }

    const GaussianPlan& plan_;
    Workers& workers_;
    const Passed& passed_;
    int width_, height_;
    std::vector<BlurLayer> layers_;           // as the plan's blurs
    std::vector<CellSplines> across_, down_;  // their grids
};

}  // namespace

void mix_blurs(const GaussianPlan& plan, View<Rgba> out, const Control& control) {
    Mixer(plan, control).run(out);
}

}  // namespace petzval::device
