#include "engine/gather/gather_cells.h"

#include "base/parallel.h"
#include "engine/waist/cells.h"

#include <algorithm>

namespace petzval::engine {
namespace {

CellLight& of_entry(std::vector<CellLight>& lights, std::size_t begin, int entry) {
    for (std::size_t i = begin; i < lights.size(); ++i)
        if (lights[i].entry == entry) return lights[i];
    lights.push_back({});
    lights.back().entry = entry;
    return lights.back();
}

// Makes a row of cells: sums each column of pixels, then the columns of each cell.
class RowOfCells {
public:
    RowOfCells(const EngineView& input, const FlatSurfaces& surfaces, const RingSizes& sizes,
               const CellAxis& across, const CellAxis& down)
        : input_(input),
          surfaces_(surfaces),
          sizes_(sizes),
          across_(across),
          down_(down),
          may_hold_(sizes.light_of(across.level())) {}

    void make(int cy, std::vector<std::size_t>& first, std::vector<CellLight>& lights) {
        find_columns(cy);
        first.reserve(std::size_t(across_.cells()) + 1);
        for (int cx = 0; cx < across_.cells(); ++cx) {
            const std::size_t begin = lights.size();
            first.push_back(begin);
            if (first_[std::size_t(across_.begin(cx))] == first_[std::size_t(across_.end(cx))]) continue;
            for (int x = across_.begin(cx); x < across_.end(cx); ++x) {
                const float share = across_.share(x, cx);
                for (std::size_t i = first_[std::size_t(x)]; i < first_[std::size_t(x) + 1]; ++i) {
                    CellLight& light = of_entry(lights, begin, lights_[i].entry);
                    light.colour += share * lights_[i].colour;
                    light.covered += share * lights_[i].covered, light.beyond += share * lights_[i].beyond;
                }
            }
        }
        first.push_back(lights.size());
    }

private:
    void find_columns(int cy) {
        const int columns = across_.end(across_.cells() - 1);
        find_lit(columns, cy);
        first_.reserve(std::size_t(columns) + 1);
        for (int x = 0; x < columns; ++x) {
            const std::size_t begin = lights_.size();
            first_.push_back(begin);
            if (!is_lit_[std::size_t(x)]) continue;
            for (int y = down_.begin(cy); y < down_.end(cy); ++y) add_pixel(x, y, down_.share(y, cy), begin);
        }
        first_.push_back(lights_.size());
    }

    // Finds the columns with light of this level: most have none.
    void find_lit(int columns, int cy) {
        const int width = input_.width();
        is_lit_.assign(std::size_t(columns), input_.samples.deep.empty() ? 0 : 1);
        if (!input_.samples.deep.empty()) return;
        const float above_px = may_hold_.above_px, below_px = may_hold_.below_px;
        const auto note = [&](int x, float coc_px) { is_lit_[std::size_t(x)] |= may_hold_.contains(coc_px); };
        for (int y = down_.begin(cy); y < std::min(down_.end(cy), input_.height()); ++y) {
            const float* const coc_px = input_.samples.coc_px.row(y);
            unsigned char* const is_lit = is_lit_.data();
            for (int x = 0; x < width; ++x) {
                const float size_px = std::abs(coc_px[x]);
                is_lit[x] |= (unsigned char)((size_px > above_px) & (size_px < below_px));
            }
            surfaces_.mixtures.for_each_in_row(
                y, [&](int x, const Mixture& m) { note(x, m.near_coc_px), note(x, m.far_coc_px); });
            surfaces_.hidden.ranges.for_each_in_row(y, [&](int x, const HiddenLayers::Range&) {
                for (const Hidden& h : surfaces_.hidden.at(x, y)) note(x, h.coc_px);
            });
        }
        std::fill(is_lit_.begin() + width, is_lit_.end(), is_lit_[std::size_t(width) - 1]);
    }

    // Pixels beyond the picture continue its border in an unknown colour, or are empty.
    void add_pixel(int x, int y, float weight, std::size_t begin) {
        const int u = std::min(x, input_.width() - 1), v = std::min(y, input_.height() - 1);
        const bool outside_x = u != x, outside_y = v != y, outside = outside_x || outside_y;
        const bool open =
            (!outside_x || input_.window.open_edges.right) && (!outside_y || input_.window.open_edges.bottom);
        for_each_sample(input_, surfaces_, sizes_.farthest_px(), u, v,
                        [&](Rgba colour, float coc_px, float covered, bool hidden) {
                            if (!may_hold_.contains(coc_px)) return;
                            const auto add = [&](int turn, float share) {
                                const int entry = sizes_.entry_at(turn, across_.level());
                                if (entry < 0) return;
                                CellLight& light = of_entry(lights_, begin, entry);
                                if (!outside) light.colour += share * weight * colour;
                                (outside && open ? light.beyond : light.covered) += share * weight * covered;
                            };
                            sizes_.hand_out(coc_px, hidden, add);
                            sizes_.hand_out_to_seam(coc_px, add);
                        });
    }

    const EngineView& input_;
    const FlatSurfaces& surfaces_;
    const RingSizes& sizes_;
    const CellAxis &across_, &down_;
    RingSizes::Sizes may_hold_;
    std::vector<unsigned char> is_lit_;  // by column of pixels
    std::vector<std::size_t> first_;     // of each column of pixels
    std::vector<CellLight> lights_;
};

}  // namespace

CellLevel::CellLevel(const EngineView& input, const FlatSurfaces& surfaces, const RingSizes& sizes, int level)
    : width_((input.width() + (1 << level) - 1) >> level),
      height_((input.height() + (1 << level) - 1) >> level),
      rows_(std::size_t(height_)) {
    const CellAxis across(level, width_), down(level, height_);
    parallel_for(height_, *input.services.workers, [&](int cy) {
        Row& row = rows_[std::size_t(cy)];
        RowOfCells(input, surfaces, sizes, across, down).make(cy, row.first, row.lights);
    });
}

}  // namespace petzval::engine
