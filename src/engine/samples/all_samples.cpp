#include "engine/samples/all_samples.h"

#include "laws/surfaces.h"

#include <span>

namespace petzval::engine {
namespace {

// Right behind another surface no ray gets in between: of a pixel's samples from `first` on, each translucent
// one keeps the room that those less than laws::kOwnSurfacePx in front of it leave. An opaque one stays,
// because it hides what lies farther behind.
void hide_what_is_covered(BigVector<CocSample>& samples, std::size_t first) {
    for (std::size_t k = samples.size(); k-- > first + 1;) {
        CocSample& s = samples[k];
        if (s.colour.a >= laws::kOpaqueLayer && k + 1 < samples.size()) continue;
        float room = 1;
        for (std::size_t j = k; j-- > first && s.coc_px - samples[j].coc_px < laws::kOwnSurfacePx;)
            if (samples[j].coc_px < s.coc_px) room -= samples[j].colour.a;
        if (s.colour.a > room) s.colour = s.colour * (std::max(0.0f, room) / s.colour.a);
    }
    samples.erase(std::remove_if(samples.begin() + std::ptrdiff_t(first), samples.end(),
                                 [](const CocSample& s) { return s.colour == Rgba{}; }),
                  samples.end());
}

constexpr float kTogetherPx = 0.5f, kApartPx = 1;

float difference(Rgba a, Rgba b) { return std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b); }

// Looks for the sample behind those from `first` on whose light makes the picture as bright as it is. Then
// the ones in front may cover less together than they state, because the coverage of a sample includes parts
// that others hide, but no less than the largest of them does. False: none explains it. Unless the picture is
// far brighter than they are, it is explained only if nearly all of the difference goes.
bool is_from_behind(BigVector<CocSample>& samples, std::size_t first, Rgba picture, bool far_brighter) {
    constexpr float kLeft = 0.1f;  // of the difference
    const float bright = luminance(picture);
    Rgba front;
    float largest = 0;
    for (std::size_t k = first; k < samples.size(); ++k) {
        const float behind = luminance(samples[k].colour), dark = luminance(front) / front.a;
        const float apart_px = samples[k].coc_px - samples[first].coc_px;
        if (front.a > 0 && apart_px > kTogetherPx && dark < bright && bright < behind) {
            const float covers = std::max(largest, (behind - bright) / (behind - dark));
            const float scale = largest > laws::kOpaque ? 1 : std::min(1.0f, covers / front.a);
            const auto wrong_by = [&](float times) {
                const float open = std::max(0.0f, 1 - times * front.a);
                return difference(times * front + open * samples[k].colour, picture);
            };
            const bool explains = scale < 1 && wrong_by(scale) <= kLeft * wrong_by(1);
            if (explains || (far_brighter && (scale < 1 || apart_px > 2 * kApartPx))) {
                for (std::size_t m = first; m < k; ++m) samples[m].colour = scale * samples[m].colour;
                return true;
            }
            if (!far_brighter) return false;
        }
        largest = std::max(largest, samples[k].colour.a);
        front += samples[k].colour;
    }
    return false;
}

// True if a sample no more than kTogetherPx behind the first one is as bright as the picture. Where surfaces
// run into each other, such as hair and a scalp, the mean depths of samples in a pixel do not say which one
// shows.
bool is_of_those_together(const BigVector<CocSample>& samples, std::size_t first, Rgba picture) {
    for (std::size_t k = first; k < samples.size(); ++k) {
        if (samples[k].coc_px - samples[first].coc_px > kTogetherPx) return false;
        if (luminance(samples[k].colour) >= samples[k].colour.a * luminance(picture)) return true;
    }
    return false;
}

// A stated sample is the mean of its surface over the pixel. The visible parts of samples from `first` on are
// scaled to sum to the picture's colour, if they lie so close together that no lens sees past one of them to
// the next, and if the picture is not brighter than they are because of light from behind.
void match_what_shows(BigVector<CocSample>& samples, std::size_t first, Rgba picture) {
    constexpr float kCovered = 1 - 1e-6f, kDark = 1e-9f, kBrighter = 1.25f, kFarBrighter = 4;
    float covered = 0, in_front = 0, span_px = 0;
    Rgba shown;
    std::size_t end = first;
    for (; end < samples.size(); ++end) {
        const CocSample& s = samples[end];
        if (end > first && s.coc_px > samples[end - 1].coc_px) in_front = covered;
        if (in_front > kCovered) break;
        covered += s.colour.a;
        span_px = s.coc_px - samples[first].coc_px;
        if (s.colour.a > 0) shown += std::min(1.0f, (1 - in_front) / s.colour.a) * s.colour;
    }
    const float brighter = luminance(picture) / std::max(luminance(shown), kDark);
    const bool far_brighter = brighter > kFarBrighter && !is_of_those_together(samples, first, picture);
    if (brighter > kBrighter && is_from_behind(samples, first, picture, far_brighter)) return;
    const float together = std::clamp((kApartPx - span_px) / (kApartPx - kTogetherPx), 0.0f, 1.0f);
    const auto times = [&](float is, float want) { return is > kDark ? 1 + together * (want / is - 1) : 1; };
    const float r = times(shown.r, picture.r), g = times(shown.g, picture.g), b = times(shown.b, picture.b);
    for (std::size_t k = first; k < end; ++k)
        samples[k].colour.r *= r, samples[k].colour.g *= g, samples[k].colour.b *= b;
}

}  // namespace

bool is_same_or_in_front(const StatedPicture& p, float depth, float visible) {
    return p.radius_px(depth) <= p.radius_px(visible) + laws::kSameStatedPx &&
           (is_in_radii(p.meaning) ||
            finite_depth(double(depth)) <= finite_depth(double(visible)) * laws::kSameStatedRatio);
}

CocSamples all_samples(const StatedPicture& p, Workers& workers) {
    CocSamples all;
    if (p.deep && !p.deep->empty()) return deep_samples(*p.deep, p.meaning, workers);
    const View<const Rgba> colour = p.colour;
    all.width = colour.width();
    const DeepPicture* const extra = p.behind;
    if (!extra || extra->empty()) return all;
    all.first.reserve(extra->first().size());
    all.samples.reserve(extra->sample_count() + std::size_t(colour.width()) * std::size_t(colour.height()));
    for (int y = 0; y < colour.height(); ++y)
        for (int x = 0; x < colour.width(); ++x) {
            all.first.push_back(all.samples.size());
            const std::span<const DeepSample> samples = extra->at(x, y);
            const float visible = p.radius_px(p.depth(x, y));
            const bool complete =
                !samples.empty() && is_same_or_in_front(p, samples.front().depth, p.depth(x, y));
            if (!complete) all.samples.push_back({colour(x, y), visible, visible});
            for (const DeepSample& s : samples)
                all.samples.push_back(
                    {finite_colour(s.colour), p.radius_px(s.depth), p.radius_px(s.depth_back)});
            std::stable_sort(all.samples.begin() + std::ptrdiff_t(all.first.back()), all.samples.end(),
                             [](const CocSample& a, const CocSample& b) { return a.coc_px < b.coc_px; });
            hide_what_is_covered(all.samples, all.first.back());
            // Through an empty pixel of an element, the plate is seen as it is.
            const bool is_empty = colour(x, y) == Rgba{};
            if (complete && !is_empty) match_what_shows(all.samples, all.first.back(), colour(x, y));
        }
    all.first.push_back(all.samples.size());
    return all;
}

}  // namespace petzval::engine
