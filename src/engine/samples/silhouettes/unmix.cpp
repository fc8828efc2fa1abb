#include "base/parallel.h"
#include "engine/samples/completion_model.h"
#include "engine/samples/hidden.h"
#include "engine/samples/silhouettes/bridges.h"
#include "engine/samples/silhouettes/connectivity.h"
#include "engine/samples/silhouettes/edge_lamps.h"
#include "engine/samples/silhouettes/sides.h"
#include "engine/samples/silhouettes/strands.h"
#include "engine/samples/silhouettes/touching.h"
#include "engine/samples/silhouettes/two_surfaces.h"

#include <algorithm>
#include <utility>

namespace petzval::engine {
namespace {

// Light that the nearer surface's own colour does not explain belongs to the lamps behind, if these light the
// pixel.
void give_to_lamps(Mixture& m) {
    if (m.lamps_behind <= 0) return;
    const Rgba more =
        light_only(m.near_colour - (completion_model.lamp_excess * m.near_share) * m.near_clean);
    const Rgba given = m.lamps_behind * Rgba{more.r, more.g, more.b, 0};
    m.near_colour -= given, m.far_light += given;
}

// 0…1: the share of unexplained light in a pixel that shows the farther surface and belongs to that: a detail
// which no clean pixel shows, such as the end of a lit sign beside a wire.
float own_detail(Rgba c, const Guess& near, const Guess& far, const Sides& s) {
    if (s.near_clean.empty()) return 0;
    // A pixel of the nearer surface that is twice as bright may shine into this one: renderers filter colour,
    // not depth.
    const float spills = std::clamp(s.near_brightest / std::max(1e-20f, luminance(c)) - 1, 0.0f, 1.0f);
    return (1 - spills) * unexplained(c, near.colour, far.colour);
}

// `more`, in each channel at most `most`, or `least` if that is brighter.
Rgba limited(Rgba more, Rgba most, Rgba least) {
    return {std::min(more.r, std::max(most.r, least.r)), std::min(more.g, std::max(most.g, least.g)),
            std::min(more.b, std::max(most.b, least.b)), more.a};
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
    m.far_variance = far.variance;
    m.far_most = s.far_most;
    m.lit = (touching(x, y) & kLit) != 0;
    m.thin = s.near_clean.empty() && !m.lit;
    m.enclosed = m.shows_far && !s.near_clean.empty() && s.far_clean.empty() && !m.lit;
    if (m.thin || m.enclosed) return m;  // unmix_strands()
    const Rgba c = picture.dim(x, y);
    const Rgba lamps = picture.colour(x, y) - c;
    if (m.lit) {
        const LampsBehind behind = find_lamps(picture, coc, touching, x, y, threshold, s.far_coc);
        m.far_light = behind.share * lamps, m.lamp_coc_px = behind.coc_px;
        m.lights_near = lamps != Rgba{} && behind.share < 1, m.lamps_behind = behind.share;
    }
    if (!m.shows_far) return m;
    const auto explained = [&](float far_gains) {
        return expected(comparable(c), near, far, s.near_share_by_shape, m.errors(picture), far_gains);
    };
    Explained e = explained(0);
    if (const float gains = own_detail(comparable(c), near, far, s); gains > 0)
        e.far_colour = limited(explained(gains).far_colour, s.far_most, e.far_colour);
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

// 0…1: how well another shade of the nearer surface explains light c, in front of this background.
float is_shade(Rgba c, float near_share, Rgba near, Rgba behind) {
    constexpr float kOther = 0.1f;  // of the squared light: another colour
    Rgba own = light_only(c - (1 - near_share) * behind);
    own.a = near.a = 0;
    return std::max(0.0f, 1 - unmixed2(own, kMostLight * near, {}) / (kOther * light2(own) + 1e-16f));
}

// The two surfaces in a pixel of colour c. Clean pixels of the nearer one lie at least two pixels away, so
// its colour here may be another shade; but it is no less certain than that of the farther one. A shade that
// no mixture of the two gives, such as the lit edge of a rail, says nothing about their shares, so that the
// silhouette's shape decides.
Explained explained_before(const Mixture& m, const LitPicture& picture, Rgba c) {
    const float shade = completion_model.near_shade * luminance(m.near_clean);
    const Guess near{m.near_clean, m.near_variance + std::min(shade * shade, m.far_variance)};
    const Guess far{comparable(m.far_colour), m.far_variance};
    ModelErrors errors = m.errors(picture);
    errors.unmixed2 = is_shade(comparable(c), m.share_by_shape, near.colour, far.colour) *
                      std::max(0.0f, unmixed2(comparable(c), near.colour, far.colour) - 3 * far.variance);
    Explained e = expected(comparable(c), near, far, m.share_by_shape, errors);
    e.far_colour = limited(e.far_colour, m.far_most, m.far_colour);
    e.far_colour.a = m.far_colour.a;
    e.near_share = least_share_before(c, e.near_share, e.far_colour);
    return e;
}

void add_light(std::span<Hidden> hidden, Rgba more) {
    for (Hidden& h : hidden) {
        const float alpha = h.colour.a;
        h.colour = light_only(h.colour + h.share * more);
        h.colour.a = alpha;
    }
}

void separate_nearer(Mixture& m, const LitPicture& picture, HiddenLayers& hidden, int x, int y) {
    const auto behind = std::as_const(hidden).at(x, y);
    if (!behind.empty()) m.far_colour = composited(behind);
    const Rgba c = picture.dim(x, y);
    if (m.thin || m.lit) {
        m.near_share = share_before(c, {m.near_clean, m.near_variance}, m.far_colour, m.share_by_shape,
                                    m.errors(picture));
    } else {
        const Explained e = explained_before(m, picture, c);
        m.near_share = e.near_share;
        if (!behind.empty()) add_light(hidden.own(x, y), e.far_colour - m.far_colour);
        m.far_colour = e.far_colour;
    }
    m.near_colour = light_only(c - (1 - m.near_share) * m.far_colour);
    const Rgba lamps = picture.colour(x, y) - c, lamps_before = lamps - m.far_light;
    give_to_lamps(m);
    m.near_colour += lamps_before;
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
    const Image<unsigned char> touching = touching_silhouettes(picture, joined, workers);
    Mixtures mixtures{width, height, workers, [&](int y, const auto& emit) {
                          for (int x = 0; x < width; ++x)
                              if (touching(x, y))
                                  emit(x, taken_apart(picture, coc, coc_px, touching, x, y, rule));
                      }};
    unmix_strands(mixtures, picture, coc_px, workers, rule);
    return mixtures;
}

void unmix_nearer(Mixtures& mixtures, const LitPicture& picture, HiddenLayers& hidden, Workers& workers) {
    constexpr int kBand = HiddenLayers::kBand;
    const int height = picture.colour.height();
    parallel_for((height + kBand - 1) / kBand, workers, [&](int band) {
        for (int y = band * kBand; y < std::min(height, (band + 1) * kBand); ++y)
            mixtures.for_each_in_row(y, [&](int x, Mixture& m) {
                if (!m.shows_far) separate_nearer(m, picture, hidden, x, y);
            });
    });
}

}  // namespace petzval::engine
