// The surfaces of a flat picture: separated silhouettes, and estimated hidden surfaces.
#pragma once

#include "engine/samples/behind/plate.h"
#include "engine/samples/hidden.h"
#include "engine/waist/engine.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <cstddef>
#include <memory>

namespace petzval::engine {

struct FlatSurfaces {
    Mixtures mixtures;      // pixels at silhouettes, separated
    HiddenLayers hidden;    // what lies behind the visible surfaces
    CleanPlate plate = {};  // patches replace what is hidden in their pixels; empty: there is none
    std::shared_ptr<const FlatSurfaces> of_plate = {};  // of one that covers the frame

    // The surfaces of pixel (x, y) from the nearest, as emit(colour, coc_px, share): colour is premultiplied
    // by share, the part of the pixel that the surface takes up. share_alone: of a pixel that shows a single
    // surface. Light of lamps behind a silhouette comes last, with share 0.
    template <typename Emit>
    void visit(View<const Rgba> colour, View<const float> coc_px, int x, int y, float share_alone,
               Emit&& emit) const {
        visit(*this, colour, coc_px, x, y, share_alone, emit);
    }
    // The same with the plate, which shows through the uncovered part of the picture.
    template <typename Emit>
    void visit_with_plate(View<const Rgba> colour, View<const float> coc_px, int x, int y,
                          Emit&& emit) const {
        if (!is_before(x, y)) return visit(colour, coc_px, x, y, 1, emit);
        const float plate_px = plate.coc_px(x, y);
        visit(colour, coc_px, x, y, colour(x, y).a, [&](Rgba c, float coc, float share) {
            if (is_before_plate(coc, plate_px)) emit(c, coc, share);
        });
        if (plate.is_out_of_sight(x, y)) return;
        if (of_plate)
            of_plate->visit(plate.colour, plate.coc_px, x, y, 1, emit);
        else
            emit(plate.colour(x, y), plate_px, 1.0f);
    }
    // The same, but a translucent surface in front of one that covers more is a pane. It covers no more than
    // its alpha, and the emptiness that shows through it has the radius of that other surface. Elsewhere a
    // translucent surface is part of a picture that fades: emptiness follows right behind it.
    template <typename Emit>
    void visit_through_panes(View<const Rgba> colour, View<const float> coc_px, int x, int y,
                             Emit&& emit) const {
        if (is_before(x, y)) return visit_with_plate(colour, coc_px, x, y, emit);  // the plate shows through
        float room = 1, empty = 0, beyond_px = 0;  // room, empty: shares of the pixel
        visit(colour, coc_px, x, y, 1, [&](Rgba c, float coc, float share) {
            if (share <= 0) return emit(c, coc, share);  // light of lamps
            if (room <= 0) return;
            const Pane pane = pane_at(x, y, c.a / share);
            const float takes = room * (share - pane.is * (share - c.a));
            if (takes > 0 || c != Rgba{}) emit(room * c, coc, takes);
            if (pane.is <= 0) return;
            const float open = room * pane.is * share;
            empty += open, room -= open, beyond_px = pane.beyond_px;
        });
        if (empty > 0) emit(Rgba{}, beyond_px, empty);
    }
    // A pixel is a pane to the degree, 0…1, to which a surface behind it covers more than it does, or to
    // which it is glow, which hides nothing. beyond_px: the radius of that surface.
    struct Pane {
        float is = 0, beyond_px = 0;
    };
    Pane pane_at(int x, int y, float alpha) const {
        if (alpha >= laws::kOpaqueLayer) return {};
        constexpr float kFades =
            0.1f;  // of the open part; along a picture that fades, alpha may change so much
        constexpr float kHidesNothing = 0.02f;  // alpha far below this
        float most = -1;
        Pane pane;
        for (const Hidden& h : hidden.at(x, y))
            if (h.share > 0 && h.colour.a / h.share > most)
                most = h.colour.a / h.share, pane.beyond_px = h.coc_px;
        if (most < 0) return {};
        const float glows = 1 - alpha / kHidesNothing;
        pane.is = std::clamp(std::max(glows, (most - alpha) / (1 - alpha) / kFades - 1), 0.0f, 1.0f);
        return pane;
    }
    // The same as visit(); what the emitted references change is changed here. Pixels may share hidden
    // surfaces.
    template <typename Emit>
    void change(View<const Rgba> colour, View<const float> coc_px, int x, int y, Emit&& emit) {
        visit(*this, colour, coc_px, x, y, 1, emit);
    }

    // Adds a plate, unless it is empty, and separates again the silhouettes in front of it.
    void add_plate(const CleanPlate& added, const LitPicture& picture, View<const float> coc_px,
                   Workers& workers);
    // True unless the plate hides a surface of the picture at this radius.
    bool is_seen(int x, int y, float radius_px) const {
        if (of_plate) return !plate.is_out_of_sight(x, y);
        return !is_before(x, y) || is_before_plate(radius_px, plate.coc_px(x, y));
    }
    // True if the plate shows what lies behind (x, y).
    bool is_before(int x, int y) const { return of_plate || (!plate.empty() && plate.is_stated(x, y)); }
    // True if the nearer surface takes up a part of the pixel worth drawing.
    static bool shows_near(const Mixture& m) { return m.near_share > 1e-3f || m.lights_near; }

    // The hidden surface that shows most of itself behind the pixel; null: none was found.
    const Hidden* most_hidden(int x, int y) const {
        const Hidden* most = nullptr;
        float open = 1, most_shows = 0;
        for (const Hidden& h : hidden.at(x, y)) {
            const float shows = open * h.share;
            if (shows > most_shows) most = &h, most_shows = shows;
            open -= shows;
        }
        return most;
    }
    bool empty() const { return mixtures.empty() && hidden.ranges.empty(); }
    // Samples of a picture of so many pixels, at most.
    std::size_t sample_count(std::size_t pixels) const;
    std::size_t bytes() const;
    // Bytes that giving them the light of a layer takes for a while.
    std::size_t bytes_of_layer(std::size_t pixels) const;

private:
    template <typename Self, typename Emit>
    static void visit(Self& self, View<const Rgba> colour, View<const float> coc_px, int x, int y,
                      float share_alone, Emit& emit) {
        auto* const m = self.mixtures.at(x, y);
        const auto behind = self.hidden.at(x, y);
        if (Rgba alone = colour(x, y); !m) emit(alone, coc_px(x, y), share_alone);
        if (m && shows_near(*m)) emit(m->near_colour, m->near_coc_px, m->near_share);
        if (m && (m->shows_far || behind.empty())) emit(m->far_colour, m->far_coc_px, 1.0f);
        for (auto& h : behind) emit(h.colour, h.coc_px, h.share);
        if (m && m->far_light != Rgba{}) emit(m->far_light, m->lamp_coc_px, 0.0f);
    }
};

// The surfaces of a picture as previews draw them: the estimate of hidden.h with a short search
// (FillRule::preview). Nothing is estimated behind surfaces in focus or beyond it: rings of kernels mix the
// light of near radii, so it would shine through them. If input.samples.colour is a layer: its part of the
// picture's surfaces. fills: false estimates nothing.
std::shared_ptr<const FlatSurfaces> preview_surfaces(const EngineView& input, bool fills);

// Rows around a row that may change its surfaces.
int preview_reach_px(const EngineView& input);

}  // namespace petzval::engine
