#include "engine/gather/gather_cells.h"

#include "base/parallel.h"
#include "engine/waist/cells.h"

#include <algorithm>

namespace petzval::engine {
namespace {

CellLight& of_turn(std::vector<CellLight>& lights, std::size_t begin, int turn) {
    for (std::size_t i = begin; i < lights.size(); ++i)
        if (lights[i].turn == turn) return lights[i];
    lights.push_back({});
    lights.back().turn = turn;
    return lights.back();
}

// A row of cells: first every column of pixels by itself, then the columns of each cell.
class RowOfCells {
public:
    RowOfCells(const Input& input, const Guessed& guessed, const RingSizes& sizes, const CellAxis& across,
               const CellAxis& down)
        : input_(input),
          guessed_(guessed),
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
            for (int x = across_.begin(cx); x < across_.end(cx); ++x) {
                const float share = across_.share(x, cx);
                for (std::size_t i = first_[std::size_t(x)]; i < first_[std::size_t(x) + 1]; ++i) {
                    CellLight& light = of_turn(lights, begin, lights_[i].turn);
                    light.colour += share * lights_[i].colour;
                    light.covered += share * lights_[i].covered, light.beyond += share * lights_[i].beyond;
                }
            }
        }
        first.push_back(lights.size());
    }

private:
    void find_columns(int cy) {
        for (int x = 0; x < across_.end(across_.cells() - 1); ++x) {
            const std::size_t begin = lights_.size();
            first_.push_back(begin);
            for (int y = down_.begin(cy); y < down_.end(cy); ++y) add_pixel(x, y, down_.share(y, cy), begin);
        }
        first_.push_back(lights_.size());
    }

    // Beyond the picture its border goes on, in a colour that is not known; or there is nothing.
    void add_pixel(int x, int y, float weight, std::size_t begin) {
        const int u = std::min(x, input_.width() - 1), v = std::min(y, input_.height() - 1);
        const bool outside_x = u != x, outside_y = v != y, outside = outside_x || outside_y;
        const bool open = (!outside_x || input_.open_edges.right) && (!outside_y || input_.open_edges.bottom);
        for_each_sample(input_, guessed_, u, v, [&](Rgba colour, float coc_px, float covered, bool hidden) {
            if (!may_hold_.contains(coc_px)) return;
            sizes_.hand_out(coc_px, hidden, [&](int turn, float share) {
                if (sizes_.level_of_turn(turn) != across_.level()) return;
                CellLight& light = of_turn(lights_, begin, turn);
                if (!outside) light.colour += share * weight * colour;
                (outside && open ? light.beyond : light.covered) += share * weight * covered;
            });
        });
    }

    const Input& input_;
    const Guessed& guessed_;
    const RingSizes& sizes_;
    const CellAxis &across_, &down_;
    RingSizes::Sizes may_hold_;
    std::vector<std::size_t> first_;  // of each column of pixels
    std::vector<CellLight> lights_;
};

}  // namespace

CellLevel::CellLevel(const Input& input, const Guessed& guessed, const RingSizes& sizes, int level)
    : width_((input.width() + (1 << level) - 1) >> level),
      height_((input.height() + (1 << level) - 1) >> level),
      rows_(std::size_t(height_)) {
    const CellAxis across(level, width_), down(level, height_);
    parallel_for(height_, *input.workers, [&](int cy) {
        Row& row = rows_[std::size_t(cy)];
        RowOfCells(input, guessed, sizes, across, down).make(cy, row.first, row.lights);
    });
}

}  // namespace petzval::engine
