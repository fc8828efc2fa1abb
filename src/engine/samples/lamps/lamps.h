// Lamps that an edge cuts: the visible part continues behind the edge by the lamp's own shape.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "engine/samples/hidden.h"

#include <span>
#include <vector>

namespace petzval::engine {

// Light of a lamp that a nearer surface hides.
struct HiddenLamp {
    int x = 0;
    float coc_px = 0;
    Rgba light;  // a is 0
};

// Hidden parts of lamps, by rows of the picture, ascending x, at most one per pixel.
struct HiddenLamps {
    std::vector<std::vector<HiddenLamp>> rows;
    std::span<const HiddenLamp> row(int y) const {
        return rows.empty() ? std::span<const HiddenLamp>{} : rows[std::size_t(y)];
    }
    std::size_t bytes() const {
        std::size_t bytes = rows.size() * sizeof(std::vector<HiddenLamp>);
        for (const auto& row : rows) bytes += row.size() * sizeof(HiddenLamp);
        return bytes;
    }
};

// Upper limit of lit_widest_px: lamps are searched no farther from the edge that cuts them.
constexpr int kWidestLampPx = 64;

// A lamp is assumed to be as deep, across the edge that cuts it, as it is wide along the edge, and
// point-symmetric: its hidden end is the mirror image of the visible one. So it never holds more than twice
// the visible light, and fades as it slips behind the edge. `mixtures` as unmix_nearer() leaves them.
HiddenLamps lamps_behind(const LitPicture& picture, View<const float> coc_px, const Mixtures& mixtures,
                         Workers& workers);

}  // namespace petzval::engine
