// Lamps that a silhouette cuts: their light, and the shape of their visible parts.
#pragma once

#include "engine/samples/completion_model.h"
#include "engine/samples/hidden.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace petzval::engine {

struct LampPixel {
    int x, y;
};

// Light of lamps on the farthest surface in a pixel, and the surface in front of it.
class LampLight {
public:
    LampLight(const LitPicture& picture, View<const float> coc, const Mixtures& mixtures)
        : picture_(picture), coc_(coc), mixtures_(mixtures) {}
    bool contains(int x, int y) const { return coc_.rect().contains(x, y); }
    Rgba at(int x, int y) const {
        if (!contains(x, y)) return {};
        if (const Mixture* m = mixtures_.at(x, y)) return m->far_light;
        return picture_.colour(x, y) - picture_.dim(x, y);
    }
    float coc_px(int x, int y) const {
        const Mixture* m = mixtures_.at(x, y);
        return !m ? coc_(x, y) : m->far_light != Rgba{} ? m->lamp_coc_px : m->far_coc_px;
    }
    // Degree to which a lamp of this radius is hidden there, 0…1: an occluder that does not hide it
    // completely leaves it visible.
    float hides(int x, int y, float lamp_px) const {
        if (!contains(x, y)) return 0;
        const Mixture* m = mixtures_.at(x, y);
        if ((m ? m->near_coc_px : coc_(x, y)) >= lamp_px - completion_model.step_px) return 0;
        if (!m) return 1;
        const float nothing = completion_model.covers;
        return m->shows_far || m->far_light != Rgba{}
                   ? 0
                   : std::max(0.0f, (m->near_share - nothing) / (1 - nothing));
    }
    // Light between the middles of four pixels.
    Rgba at(float x, float y) const {
        const int u = int(std::floor(x)), v = int(std::floor(y));
        const float s = x - float(u), t = y - float(v);
        return (1 - t) * ((1 - s) * at(u, v) + s * at(u + 1, v)) +
               t * ((1 - s) * at(u, v + 1) + s * at(u + 1, v + 1));
    }

private:
    const LitPicture& picture_;
    View<const float> coc_;
    const Mixtures& mixtures_;
};

// The visible part of a lamp.
struct Lamp {
    std::vector<LampPixel> pixels;
    Rect bounds;
    float coc_px = 0, peak = 0;             // of the lamp's brightest pixel
    double cut_x = 0, cut_y = 0, cuts = 0;  // sums over the occluder's pixels right beside the lamp
    double lit_x = 0, lit_y = 0, lit = 0;   // sums over the lamp's pixels, weighted by light
};

class LampFinder {
public:
    explicit LampFinder(const LampLight& light, Rect picture)
        : light_(light), seen_(picture.width(), picture.height(), 0) {}

    // The lamp that lights (x, y); each lamp is returned once. A lamp wider than lit_widest_px has no pixels.
    Lamp lamp_at(int x, int y);

private:
    void add(LampPixel p, Lamp& lamp) const;
    void visit(LampPixel p, float coc, Lamp& lamp, std::vector<LampPixel>& open);

    const LampLight& light_;
    Image<unsigned char> seen_;
};

}  // namespace petzval::engine
