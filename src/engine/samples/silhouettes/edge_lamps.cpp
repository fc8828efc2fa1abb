#include "engine/samples/silhouettes/edge_lamps.h"

#include "engine/samples/completion_model.h"
#include "laws/surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace petzval::engine {
namespace {

// A pixel and its place, by the light of lamps in it and by all that it shows; clean: it touches no
// silhouette.
struct LitPixel {
    float light = 0, shown = 0, coc_px = 0;
    bool clean = false;
    int x = 0, y = 0;
};

// Likeness of two lights in colour, 0…1: red and white are hardly alike.
float alike(Rgba a, Rgba b) {
    const float cosine2 = dot(a, b) * dot(a, b) / std::max(1e-20f, dot(a, a) * dot(b, b));
    return cosine2 * cosine2 * cosine2 * cosine2;
}

// True if the pixel at `lit_px` lies before unlit ones from first_px to last_px as no slope of theirs
// explains. The pixel then shows a lamp's own body: light from behind an edge makes depths farther, not
// nearer. (Rounding of depth moves radii by less than kBodyPx: files of half floats by 0.005 px at 10 px.)
bool stands_before(float lit_px, float first_px, float last_px) {
    constexpr float kBodyPx = 0.05f;
    const float slope = last_px - first_px;
    return laws::is_in_front(lit_px, first_px, std::max(kBodyPx, slope));
}

// True if a clean pixel right beside the lit one is less than a tenth as bright: a lamp on the surface would
// light it too, so this one is cut off by the edge. (Lit edges of the surface itself are less bright.)
bool is_cut_off(const LitPixel& lit, const LitPixel& beside) {
    constexpr float kBrighter = 10;
    return beside.clean && std::abs(beside.x - lit.x) + std::abs(beside.y - lit.y) == 1 &&
           lit.light > kBrighter * beside.shown;
}

// Certainty that a lamp which lights the nearer side belongs to the surface of its brightest pixel. A lamp
// that lights only a few pixels of that surface, and none that touches no silhouette, shines past its edge.
float share_of_surface(const std::vector<LitPixel>& nearer) {
    const float few_lit = completion_model.few_lit, many_lit = completion_model.many_lit;
    const auto brightest = std::max_element(nearer.begin(), nearer.end(),
                                            [](const auto& a, const auto& b) { return a.light < b.light; });
    if (brightest == nearer.end()) return 1;
    int pixels = 0, lit = 0;
    bool cut_off = false;
    float nearest_unlit = std::numeric_limits<float>::infinity(), farthest_unlit = -nearest_unlit;
    for (const LitPixel& p : nearer) {
        if (std::abs(p.coc_px - brightest->coc_px) > completion_model.step_px) continue;
        if (p.light > 0 && p.clean) return 1;
        ++pixels, lit += p.light > 0;
        cut_off = cut_off || is_cut_off(*brightest, p);
        if (p.light > 0) continue;
        nearest_unlit = std::min(nearest_unlit, p.coc_px);
        farthest_unlit = std::max(farthest_unlit, p.coc_px);
    }
    if (lit < pixels && stands_before(brightest->coc_px, nearest_unlit, farthest_unlit)) return 1;
    if (cut_off) return few_lit;
    return std::clamp((float(lit) / float(pixels) - few_lit) / (many_lit - few_lit), few_lit, 1.0f);
}

// True if a lamp lights farther pixels on opposite sides of the nearer one at (x, y), at least half as bright
// as the brightest `near` light: it shines past a strand. A lamp on the strand would cover less than half of
// those pixels, or they would be near too.
bool shines_past(const LitPicture& picture, View<const float> coc, int x, int y, float threshold,
                 float near) {
    const auto lit = [&](int dx, int dy) {
        const int u = x + dx, v = y + dy;
        return coc.rect().contains(u, v) && coc(u, v) > threshold &&
               luminance(picture.colour(u, v) - picture.dim(u, v)) >= 0.5f * near;
    };
    const auto on_both_sides = [&](int dx, int dy) { return lit(dx, dy) && lit(-dx, -dy); };
    return on_both_sides(1, 0) || on_both_sides(0, 1) || on_both_sides(1, 1) || on_both_sides(1, -1);
}

}  // namespace

LampsBehind find_lamps(const LitPicture& picture, View<const float> coc, View<const unsigned char> touching,
                       int x, int y, float threshold, float far_coc) {
    const int reach = int(completion_model.thin_within_px);
    const Rect window = Rect{x - reach, y - reach, x + reach + 1, y + reach + 1}.intersected(coc.rect());
    Rgba own = picture.colour(x, y) - picture.dim(x, y);
    if (own == Rgba{}) own = picture.colour(x, y);
    own.a = 0;  // colour alone
    float near = 0, far = 0;
    std::vector<LitPixel> nearer;
    for (int v = window.y0; v < window.y1; ++v)
        for (int u = window.x0; u < window.x1; ++u) {
            const Rgba lamp = picture.colour(u, v) - picture.dim(u, v);
            const float light = luminance(lamp) * alike(lamp, own);
            if (coc(u, v) <= threshold) {
                nearer.push_back({light, luminance(picture.colour(u, v)), coc(u, v), !touching(u, v), u, v});
                near = std::max(near, light);
            } else if (light > far) {
                far = light, far_coc = coc(u, v);
            }
        }
    const bool past_strand = std::any_of(nearer.begin(), nearer.end(), [&](const LitPixel& p) {
        return p.light > 0 && shines_past(picture, coc, p.x, p.y, threshold, near);
    });
    // A lamp behind may light only the pixels of the edge that it shines past.
    const float sure = past_strand ? 0 : share_of_surface(nearer);
    far = std::max(far, completion_model.unseen_lamp * (1 - sure) * near);
    near *= sure;
    const float side = completion_model.lamp_side;
    const float t = std::clamp((far / std::max(1e-20f, near + far) - side) / (1 - 2 * side), 0.0f, 1.0f);
    return {t * t * (3 - 2 * t), far_coc};
}

}  // namespace petzval::engine
