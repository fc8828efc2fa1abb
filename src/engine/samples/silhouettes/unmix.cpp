#include "base/parallel.h"
#include "engine/samples/behind/known_surfaces.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/hidden.h"
#include "engine/samples/outlines/outline.h"
#include "engine/samples/silhouettes/bridges.h"
#include "engine/samples/silhouettes/strands.h"
#include "engine/samples/silhouettes/two_surfaces.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace petzval::engine {
namespace {

constexpr float kDark = 1e-3f;  // keeps reciprocals finite

// Bits of a pixel: it touches a silhouette, and lamps light it or one beside it.
enum Touching : unsigned char { kTouches = 1, kLit = 2 };

bool touches_silhouette(View<const unsigned char> connected, int x, int y) {
    const auto at = [&](int u, int v) {
        return connected.rect().contains(u, v) ? int(connected(u, v)) : int(kAll);
    };
    // Diagonal: a side neighbour is cut from the diagonal pixel.
    constexpr int kVertical = kUp | kDown, kHorizontal = kLeft | kRight;
    return connected(x, y) != kAll || (at(x - 1, y) & at(x + 1, y) & kVertical) != kVertical ||
           (at(x, y - 1) & at(x, y + 1) & kHorizontal) != kHorizontal;
}

// The same as touches_silhouette(), for a whole row at once; most pixels touch no silhouette.
void find_touching(View<const unsigned char> connected, int y, View<unsigned char> touching) {
    const int width = connected.width();
    if (y == 0 || y + 1 == connected.height() || width < 3) {
        for (int x = 0; x < width; ++x) touching(x, y) = touches_silhouette(connected, x, y);
        return;
    }
    touching(0, y) = touches_silhouette(connected, 0, y);
    touching(width - 1, y) = touches_silhouette(connected, width - 1, y);
    const unsigned char *above = connected.row(y - 1), *own = connected.row(y), *below = connected.row(y + 1);
    unsigned char* const out = touching.row(y);
    for (int x = 1; x + 1 < width; ++x) {
        const unsigned beside = own[x - 1] & own[x + 1] & (kUp | kDown);
        const unsigned over = above[x] & below[x] & (kLeft | kRight);
        out[x] = (own[x] & (beside | over)) != kAll;
    }
}

// True if lamps light the pixel or one beside it: less light of theirs than makes a lamp may fall on it.
bool lit_around(const LitPicture& picture, int x, int y) {
    if (!picture.dim_of) return false;
    const Rect window = Rect{x - 1, y - 1, x + 2, y + 2}.intersected(picture.colour.rect());
    for (int v = window.y0; v < window.y1; ++v)
        for (int u = window.x0; u < window.x1; ++u)
            if (picture.dim(u, v) != picture.colour(u, v)) return true;
    return false;
}

// The two surfaces that meet at a silhouette's pixel, from its neighbourhood.
struct Sides {
    Pool near_clean, far_clean, far_mixed;
    float near_coc = 0, far_coc = 0;  // radius of the closest pixel on that side
    float near_closest = 1e9f, far_closest = 1e9f;
    float near_share_by_shape = 0;
};

Sides look_around(const LitPicture& picture, View<const float> coc, View<const float> stated,
                  View<const unsigned char> touching, int x, int y, float threshold, const UnmixRule& rule) {
    Sides s;
    const int reach = rule.clean_within_px;
    const Rect window = Rect{x - reach, y - reach, x + reach + 1, y + reach + 1}.intersected(coc.rect());
    const float own_light = std::max(0.0f, luminance(picture.dim(x, y))) + kDark;
    const float third = third_surface_px(coc(x, y), threshold);
    for (int v = window.y0; v < window.y1; ++v)
        for (int u = window.x0; u < window.x1; ++u) {
            if (coc(u, v) > third) continue;
            const float d2 = float((u - x) * (u - x) + (v - y) * (v - y));
            const bool near = coc(u, v) <= threshold;
            const Rgba colour = picture.dim(u, v);
            // Far pixels count little, and pixels much brighter than this one too: a lamp nearby is not this
            // surface.
            const float weight = 1 / ((1 + d2 * d2) * (own_light + std::max(0.0f, luminance(colour))));
            if (near) {
                if (!touching(u, v)) s.near_clean.add(colour, weight);
                if (d2 < s.near_closest) s.near_closest = d2, s.near_coc = coc(u, v);
            } else {
                (touching(u, v) ? s.far_mixed : s.far_clean).add(colour, weight);
                if (d2 < s.far_closest) s.far_closest = d2, s.far_coc = coc(u, v);
            }
        }
    s.near_share_by_shape = Outline(stated, x, y, threshold).near_share(rule.along_outline);
    return s;
}

// The colour of a thin thing that has no clean pixel: its pixels nearby count as they differ from the far
// side. Those that lamps light count only where there are no others: some of that light is left in them.
Guess least_like(Rgba far_colour, const LitPicture& picture, View<const float> coc,
                 View<const unsigned char> touching, int x, int y, float threshold) {
    const int reach = int(completion_model.thin_within_px);
    Pool unlit, lit;
    for (int v = std::max(0, y - reach); v <= std::min(coc.height() - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(coc.width() - 1, x + reach); ++u) {
            if (coc(u, v) > threshold) continue;
            const Rgba colour = picture.dim(u, v);
            ((touching(u, v) & kLit) != 0 ? lit : unlit)
                .add(colour, distance2(comparable(colour), far_colour) + 1e-9f);
        }
    return (unlit.empty() ? lit : unlit).guess();
}

// Lamps behind the nearer surface, from the pixels around one: their share of the lamp light in it, and their
// radius.
struct LampsBehind {
    float share = 0, coc_px = 0;
};

// A pixel, by the light of lamps in it; clean: it touches no silhouette.
struct LitPixel {
    float light = 0, coc_px = 0;
    bool clean = false;
};

// Likeness of two lights in colour, 0…1: red and white are hardly alike.
float alike(Rgba a, Rgba b) {
    const float cosine2 = dot(a, b) * dot(a, b) / std::max(1e-12f, dot(a, a) * dot(b, b));
    return cosine2 * cosine2 * cosine2 * cosine2;
}

// True if the pixel at `lit_px` lies before unlit ones from first_px to last_px as no slope of theirs
// explains. The pixel then shows a lamp's own body: light from behind an edge makes depths farther, not
// nearer.
bool stands_before(float lit_px, float first_px, float last_px) {
    const float slope = last_px - first_px;
    return laws::is_in_front(lit_px, first_px, std::max(laws::kHiddenSheet.step_px, slope));
}

// Certainty that a lamp which lights the nearer side belongs to the surface of its brightest pixel. A lamp
// that lights only a few pixels of that surface, and none that touches no silhouette, shines past its edge.
float share_of_surface(const std::vector<LitPixel>& nearer) {
    const float few_lit = completion_model.few_lit, many_lit = completion_model.many_lit;
    const auto brightest = std::max_element(nearer.begin(), nearer.end(),
                                            [](const auto& a, const auto& b) { return a.light < b.light; });
    if (brightest == nearer.end()) return 1;
    int pixels = 0, lit = 0;
    float nearest_unlit = std::numeric_limits<float>::infinity(), farthest_unlit = -nearest_unlit;
    for (const LitPixel& p : nearer) {
        if (std::abs(p.coc_px - brightest->coc_px) > completion_model.step_px) continue;
        if (p.light > 0 && p.clean) return 1;
        ++pixels, lit += p.light > 0;
        if (p.light > 0) continue;
        nearest_unlit = std::min(nearest_unlit, p.coc_px);
        farthest_unlit = std::max(farthest_unlit, p.coc_px);
    }
    if (lit < pixels && stands_before(brightest->coc_px, nearest_unlit, farthest_unlit)) return 1;
    return std::clamp((float(lit) / float(pixels) - few_lit) / (many_lit - few_lit), few_lit, 1.0f);
}

// The side whose pixels nearby are lit brighter, in the pixel's own colour, has the lamp. far_coc: of the
// farther side.
LampsBehind find_lamps(const LitPicture& picture, View<const float> coc, View<const unsigned char> touching,
                       int x, int y, float threshold, float far_coc) {
    const int reach = int(completion_model.thin_within_px);
    const Rect window = Rect{x - reach, y - reach, x + reach + 1, y + reach + 1}.intersected(coc.rect());
    Rgba own = picture.colour(x, y) - picture.dim(x, y);
    if (own == Rgba{}) own = picture.colour(x, y);
    float near = 0, far = 0;
    std::vector<LitPixel> nearer;
    for (int v = window.y0; v < window.y1; ++v)
        for (int u = window.x0; u < window.x1; ++u) {
            const Rgba lamp = picture.colour(u, v) - picture.dim(u, v);
            const float light = luminance(lamp) * alike(lamp, own);
            if (coc(u, v) <= threshold) {
                nearer.push_back({light, coc(u, v), !touching(u, v)});
                near = std::max(near, light);
            } else if (light > far) {
                far = light, far_coc = coc(u, v);
            }
        }
    // A lamp behind may light only the pixels of the edge that it shines past.
    const float sure = share_of_surface(nearer);
    far = std::max(far, completion_model.unseen_lamp * (1 - sure) * near);
    near *= sure;
    const float side = completion_model.lamp_side;
    const float t = std::clamp((far / std::max(1e-9f, near + far) - side) / (1 - 2 * side), 0.0f, 1.0f);
    return {t * t * (3 - 2 * t), far_coc};
}

// Light that the nearer surface's own colour does not explain belongs to the lamps behind, if these light the
// pixel.
void give_to_lamps(Mixture& m) {
    if (m.lamps_behind <= 0) return;
    const Rgba more =
        light_only(m.near_colour - (completion_model.lamp_excess * m.near_share) * m.near_clean);
    const Rgba given = m.lamps_behind * Rgba{more.r, more.g, more.b, 0};
    m.near_colour -= given, m.far_light += given;
}

Mixture taken_apart(const LitPicture& picture, View<const float> coc, View<const float> stated,
                    View<const unsigned char> touching, int x, int y, const UnmixRule& rule) {
    float low = coc(x, y), high = coc(x, y);
    for (int v = std::max(0, y - 1); v <= std::min(coc.height() - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(coc.width() - 1, x + 1); ++u)
            low = std::min(low, coc(u, v)), high = std::max(high, coc(u, v));
    const float threshold = 0.5f * (low + high);
    const Sides s = look_around(picture, coc, stated, touching, x, y, threshold, rule);
    const Guess far = (s.far_clean.empty() ? s.far_mixed : s.far_clean).guess();
    const Guess near = s.near_clean.empty() ? least_like(far.colour, picture, coc, touching, x, y, threshold)
                                            : s.near_clean.guess();
    Mixture m;
    m.shows_far = coc(x, y) > threshold;
    m.near_coc_px = s.near_coc, m.far_coc_px = s.far_coc;
    m.far_colour = far.colour;
    m.near_clean = near.colour, m.near_variance = near.variance, m.share_by_shape = s.near_share_by_shape;
    m.lit = (touching(x, y) & kLit) != 0;
    m.thin = s.near_clean.empty() && !m.lit;
    if (m.thin) return m;  // unmix_strands()
    const Rgba c = picture.dim(x, y);
    const Rgba lamps = picture.colour(x, y) - c;
    if (m.lit) {
        const LampsBehind behind = find_lamps(picture, coc, touching, x, y, threshold, s.far_coc);
        m.far_light = behind.share * lamps, m.lamp_coc_px = behind.coc_px;
        m.lights_near = lamps != Rgba{} && behind.share < 1, m.lamps_behind = behind.share;
    }
    if (!m.shows_far) return m;
    const Explained e = expected(comparable(c), near, far, s.near_share_by_shape, m.errors());
    m.take_apart(c, e.near_share, e.far_colour);
    const Rgba lamps_before = lamps - m.far_light;
    give_to_lamps(m);
    m.near_colour += lamps_before;
    return m;
}

// Colour of hidden samples composited over each other, without their occluder.
Rgba composited(std::span<const Hidden> hidden) {
    Rgba sum;
    float open = 1;
    for (const Hidden& h : hidden) sum += open * h.colour, open *= 1 - h.share;
    return sum;
}

}  // namespace

Mixtures unmix_silhouettes(const LitPicture& picture, View<const float> coc_px,
                           View<const unsigned char> connected, Workers& workers, const UnmixRule& rule) {
    const Plane bridged = bridged_strands(picture, coc_px, connected, workers);
    const View<const float> coc = bridged.width() > 0 ? View<const float>(bridged) : coc_px;
    Image<unsigned char> again;
    if (bridged.width() > 0) again = connections(coc, workers);
    const View<const unsigned char> joined =
        bridged.width() > 0 ? View<const unsigned char>(again) : connected;
    const int width = coc.width(), height = coc.height();
    auto touching = Image<unsigned char>::uninitialised(width, height);
    parallel_for(height, workers, [&](int y) {
        find_touching(joined, y, touching);
        for (int x = 0; x < width; ++x)
            if (touching(x, y) && lit_around(picture, x, y)) touching(x, y) |= kLit;
    });
    Mixtures mixtures{width, height, workers, [&](int y, const auto& emit) {
                          for (int x = 0; x < width; ++x)
                              if (touching(x, y))
                                  emit(x, taken_apart(picture, coc, coc_px, touching, x, y, rule));
                      }};
    unmix_strands(mixtures, picture, coc_px, workers, rule);
    return mixtures;
}

void unmix_nearer(Mixtures& mixtures, const LitPicture& picture, const HiddenLayers& hidden,
                  Workers& workers) {
    const View<const Rgba> colour = picture.colour;
    parallel_for(colour.height(), workers, [&](int y) {
        mixtures.for_each_in_row(y, [&](int x, Mixture& m) {
            if (m.shows_far) return;
            if (const auto behind = hidden.at(x, y); !behind.empty()) m.far_colour = composited(behind);
            const Rgba dim = picture.dim(x, y);
            m.near_share = share_before(dim, {m.near_clean, m.near_variance}, m.far_colour, m.share_by_shape,
                                        m.errors());
            m.near_colour = light_only(dim - (1 - m.near_share) * m.far_colour);
            const Rgba lamps = colour(x, y) - dim, lamps_before = lamps - m.far_light;
            give_to_lamps(m);
            m.near_colour += lamps_before;
        });
    });
}

}  // namespace petzval::engine
