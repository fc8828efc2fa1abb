// The lights that are spread on their own, each with its complete kernel and with the shadows of nearer
// things inside it: flat data, no pixels of the result.
#pragma once

#include "device/kernels.h"
#include "device/memory.h"
#include "engine/lights/highlight_kernels.h"
#include "engine/lights/highlights.h"
#include "engine/lights/shadow_casters.h"
#include "engine/waist/engine.h"
#include "laws/tiles.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace petzval::engine {

// The origin of a search for shadows: the middle of a highlight, or of a square of pixels that share one.
struct Viewpoint {
    float x = 0, y = 0;  // in pixels; the middle of pixel 0 is 0
    float coc_px = 0;
    int size = 1;              // of the highlight
    float own_surface_px = 0;  // what is nearer by less is the highlight's own surface
    bool is_shown = false;     // of a highlight of one pixel: as there

    // Offset of the first tap of its disc from a highlight's first pixel.
    int first_tap() const {
        return size / 2 - (size % 2 == 0 ? 1 : 0) - int(std::floor(std::abs(coc_px) + 0.5f));
    }
};

// Visibility (1) and occlusion (0) on a grid over the pupil's square, -1…1 on both axes, row by row. One bit
// per point: there may be ten million lights.
struct PupilMask {
    static constexpr int kSide = laws::kMaskSide;
    std::uint64_t seen = ~std::uint64_t(0);
    bool is_open() const { return seen == ~std::uint64_t(0); }
    bool is_closed() const { return seen == 0; }
    std::uint8_t row(int y) const { return std::uint8_t(seen >> (y * kSide)); }
};

// A light to draw: cell (x, y) of its kernel's level, and its disc's radius there; the indices of its
// viewpoint or mask, and of its kernel, in the plan's lists.
struct PlannedLight {
    Highlight highlight;
    std::uint32_t viewpoint = 0, kernel = 0;
};

// Pixels of the result that are drawn together, and where in the plan's `order` their lights begin; they end
// where those of the next tile begin.
struct LightsTile {
    Rect pixels;
    std::size_t first_light;
};

// A tap is dimmed by the share of its rays that nearer samples stop: the pixel q of a sample at radius c_q
// lies on the ray from the highlight (s, c) through pupil point u = (q - s)/(c - c_q), so every nearer sample
// darkens a square of that side around u in the pupil. Few lights leave that to the device: it finds the
// casters of each viewpoint, tap by tap. Of very many it was found beforehand, as masks; these are stamped on
// the levels of their kernels, tile by tile, and enlarged bilinearly.
struct LightsPlan {
    Rect rows;                         // pixels to be drawn
    int first_row = 0;                 // row of the frame that is row 0
    std::vector<PlannedLight> lights;  // without tiles: added in this order
    std::vector<Viewpoint> viewpoints;
    const ShadowCasters* casters = nullptr;
    std::shared_ptr<const device::Kept>* kept =
        nullptr;                       // of these casters, from plan to plan; null: nothing
    Rect picture;                      // that of the casters…
    OpenEdges open_edges;              // …which continue beyond these edges of it
    std::vector<PupilMask> masks;      // in place of viewpoints and casters
    std::vector<LightsTile> tiles;     // with masks; one more closes the list
    std::vector<std::uint32_t> order;  // of the lights of each tile: those of one kernel follow each other
    float stretch = 1;                 // of the pupil, vertically, by pixels that are not square
    CocSamplesView holdout;            // Samples::holdout
    device::KernelSet kernels;
};

// Plans the lights of a strip in batches whose kernels and shadows fit into memory together.
class LightsPlanner {
public:
    // `casters` are what may stand in the way; `white` as in HighlightSplit; rows: the pixels to be drawn.
    // The others outlive this.
    // asked_by: the same highlights with the light that decides how finely kernels are made; null: their own.
    LightsPlanner(const EngineView& strip, const HighlightKernels& kernels, const ShadowCasters& casters,
                  const std::vector<Highlight>& highlights, float white, const Rect& rows, int first_row,
                  const std::vector<Highlight>* asked_by = nullptr);
    // False: there is nothing left to be drawn.
    bool next(LightsPlan& plan);

private:
    device::KernelAsk ask(const Highlight& h) const;
    void find_viewpoints();
    void add(std::size_t highlight, LightsPlan& plan) const;

    const EngineView& input_;
    const HighlightKernels& kernels_;
    const std::vector<Highlight>& highlights_;
    const std::vector<Highlight>& asked_by_;
    const ShadowCasters& casters_;
    float bright_disc_;  // a disc brighter than this shows a radius that is off by little
    Rect rows_, sending_;
    int first_row_;
    std::vector<Viewpoint> viewpoints_;
    std::vector<std::size_t> viewpoint_of_;  // by highlight
    std::size_t next_ = 0;
    std::shared_ptr<const device::Kept> kept_;
};

}  // namespace petzval::engine
