#include "engine/samples/lamps.h"

#include "base/parallel.h"
#include "engine/samples/completion_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace petzval::engine {
namespace {

struct Pixel {
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
    std::vector<Pixel> pixels;
    Rect bounds;
    float coc_px = 0, peak = 0;             // of the lamp's brightest pixel
    double cut_x = 0, cut_y = 0, cuts = 0;  // sums over the occluder's pixels right beside the lamp
    double lit_x = 0, lit_y = 0, lit = 0;   // sums over the lamp's pixels, weighted by light
};

class LampFinder {
public:
    explicit LampFinder(const LampLight& light, Rect picture)
        : light_(light), seen_(picture.width(), picture.height(), 0) {}

    // The lamp that lights (x, y); each lamp is returned once. A lamp wider than kWidestLampPx has no
    // pixels.
    Lamp lamp_at(int x, int y) {
        Lamp lamp;
        if (seen_(x, y)) return lamp;
        lamp.bounds = {x, y, x + 1, y + 1};
        std::vector<Pixel> open{{x, y}};
        seen_(x, y) = 1;
        while (!open.empty()) {
            const Pixel p = open.back();
            open.pop_back();
            add(p, lamp);
            for (int v = p.y - 1; v <= p.y + 1; ++v)
                for (int u = p.x - 1; u <= p.x + 1; ++u) visit({u, v}, light_.coc_px(p.x, p.y), lamp, open);
        }
        if (float(std::max(lamp.bounds.width(), lamp.bounds.height())) > completion_model.lit_widest_px)
            lamp.pixels.clear();
        return lamp;
    }

private:
    void add(Pixel p, Lamp& lamp) const {
        const float light = luminance(light_.at(p.x, p.y));
        lamp.pixels.push_back(p);
        lamp.bounds = {std::min(lamp.bounds.x0, p.x), std::min(lamp.bounds.y0, p.y),
                       std::max(lamp.bounds.x1, p.x + 1), std::max(lamp.bounds.y1, p.y + 1)};
        lamp.lit += double(light), lamp.lit_x += double(light) * p.x, lamp.lit_y += double(light) * p.y;
        if (light > lamp.peak) lamp.peak = light, lamp.coc_px = light_.coc_px(p.x, p.y);
    }
    // Visits a pixel from a neighbour of this radius.
    void visit(Pixel p, float coc, Lamp& lamp, std::vector<Pixel>& open) {
        if (!light_.contains(p.x, p.y)) return;
        if (const float hides = light_.hides(p.x, p.y, coc); hides > 0) {
            lamp.cuts += double(hides), lamp.cut_x += double(hides) * p.x, lamp.cut_y += double(hides) * p.y;
            return;
        }
        if (seen_(p.x, p.y) || light_.at(p.x, p.y) == Rgba{}) return;
        const float other = light_.coc_px(p.x, p.y);
        if (std::abs(other - coc) > 1.5f + 0.1f * std::abs(coc)) return;
        seen_(p.x, p.y) = 1;
        open.push_back(p);
    }

    const LampLight& light_;
    Image<unsigned char> seen_;
};

// Extent of the lamp along a direction; a pixel that is lit less reaches less far.
std::pair<float, float> extent(const Lamp& lamp, const LampLight& light, float dx, float dy) {
    float low = 1e30f, high = -1e30f;
    for (const Pixel p : lamp.pixels) {
        const float at = dx * float(p.x) + dy * float(p.y);
        const float reach = std::min(1.0f, luminance(light.at(p.x, p.y)) / lamp.peak) - 0.5f;
        low = std::min(low, at - reach), high = std::max(high, at + reach);
    }
    return {low, high};
}

// Calls visit(x, y, light) for each hidden pixel of a lamp.
template <typename Visit>
void complete(const Lamp& lamp, const LampLight& light, const Visit& visit) {
    if (lamp.pixels.empty() || lamp.cuts <= 0 || lamp.lit <= 0) return;
    // Direction across the edge, from the visible part to the occluder.
    float nx = float(lamp.cut_x / lamp.cuts - lamp.lit_x / lamp.lit),
          ny = float(lamp.cut_y / lamp.cuts - lamp.lit_y / lamp.lit);
    const float length = std::hypot(nx, ny);
    if (length < 0.1f) return;
    nx /= length;
    ny /= length;
    const auto [begin, end] = extent(lamp, light, nx, ny);
    const auto [left, right] = extent(lamp, light, -ny, nx);
    const float shows = end - begin, hidden = std::min(right - left - shows, shows);
    if (hidden <= 0) return;
    const float across = begin + 0.5f * (shows + hidden), along = 0.5f * (left + right);
    const float centre_x = across * nx - along * ny, centre_y = across * ny + along * nx;
    const int reach = int(std::ceil(hidden)) + 1;
    const Rect around = lamp.bounds.grown(reach);
    for (int y = around.y0; y < around.y1; ++y)
        for (int x = around.x0; x < around.x1; ++x)
            if (const float hides = light.hides(x, y, lamp.coc_px); hides > 0) {
                const Rgba mirrored = hides * light.at(2 * centre_x - float(x), 2 * centre_y - float(y));
                if (mirrored != Rgba{}) visit(x, y, mirrored);
            }
}

}  // namespace

HiddenLamps lamps_behind(const LitPicture& picture, View<const float> coc, const Mixtures& mixtures,
                         Workers& workers) {
    std::vector<std::vector<Pixel>> seeds(static_cast<std::size_t>(coc.height()));
    parallel_for(coc.height(), workers, [&](int y) {
        for (int x = 0; x < coc.width(); ++x)
            if (const Mixture* m = mixtures.at(x, y); m && m->far_light != Rgba{})
                seeds[std::size_t(y)].push_back({x, y});
    });
    HiddenLamps lamps;
    if (std::all_of(seeds.begin(), seeds.end(), [](const auto& row) { return row.empty(); })) return lamps;
    lamps.rows.resize(seeds.size());
    const LampLight light(picture, coc, mixtures);
    LampFinder finder(light, coc.rect());
    for (const auto& row : seeds)
        for (const Pixel p : row) {
            const Lamp lamp = finder.lamp_at(p.x, p.y);
            complete(lamp, light, [&](int x, int y, Rgba lit) {
                lamps.rows[std::size_t(y)].push_back({x, lamp.coc_px, {lit.r, lit.g, lit.b, 0}});
            });
        }
    // Two lamps that meet behind an edge may be two parts of one: the brighter one counts.
    parallel_for(coc.height(), workers, [&](int y) {
        std::vector<HiddenLamp>& row = lamps.rows[std::size_t(y)];
        std::sort(row.begin(), row.end(), [](const HiddenLamp& a, const HiddenLamp& b) {
            return a.x != b.x ? a.x < b.x : luminance(a.light) > luminance(b.light);
        });
        row.erase(std::unique(row.begin(), row.end(),
                              [](const HiddenLamp& a, const HiddenLamp& b) { return a.x == b.x; }),
                  row.end());
    });
    return lamps;
}

}  // namespace petzval::engine
