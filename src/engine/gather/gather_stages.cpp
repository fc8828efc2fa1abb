#include "engine/gather/gather_stages.h"

#include "base/parallel.h"
#include "engine/gather/gather_taps_figure.h"
#include "engine/waist/stopwatch.h"

#include <algorithm>
#include <cmath>

namespace petzval::engine {
namespace {

// Radii from which the article's picture, and its far part, are fully blurred by default, px.
constexpr float kBlurredPx = 1, kFarBlurredPx = 1.2f;

// In much of a picture |CoC| is that of infinity, and equals the distance of the outermost taps to the bit.
// These taps count, however both are rounded (the article's half floats are coarser than this).
constexpr float kTie = 1 - 1e-4f;

float smoothstep(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

Rgba mixed(Rgba a, Rgba b, float share_of_b) { return a + share_of_b * (b - a); }

struct Place {
    float x, y;
};

// A centre and rings of n, 2n, 3n … points in the unit disc, ring k of R at (k + 1/n) / (R + 1/n): 16 is
// 1 + 5 + 10 with the inner ring at 0.545; 22, 43 and 71 have rings of multiples of 7.
std::vector<Place> disc_of(int taps) {
    const int first = taps == 16 ? 5 : 7;
    std::vector<Place> places{{0, 0}};
    int rings = 0;
    for (int total = 1; total < taps; total += first * rings) ++rings;
    for (int ring = 1; ring <= rings; ++ring) {
        const double radius = (ring + 1.0 / first) / (rings + 1.0 / first);
        for (int i = 0; i < first * ring; ++i) {
            const double angle = 2 * M_PI * i / (first * ring);
            places.push_back({float(radius * std::cos(angle)), float(radius * std::sin(angle))});
        }
    }
    return places;
}

// Colour and radius at half resolution; radii stay in pixels of the whole picture.
struct HalfPicture {
    Picture colour;
    Plane coc_px;
};

// Reads like a texture unit: bilinear, clamped; (x, y) in cells, centres at whole numbers.
template <typename Read>
auto bilinear(float x, float y, const Read& read) {
    const int u = int(std::floor(x)), v = int(std::floor(y));
    const float right = x - float(u), below = y - float(v);
    return (1 - below) * ((1 - right) * read(u, v) + right * read(u + 1, v)) +
           below * ((1 - right) * read(u, v + 1) + right * read(u + 1, v + 1));
}

class Article {
public:
    explicit Article(const EngineView& input)
        : in_(input), disc_(disc_of(input.options.of<GatherOwn>().gather.taps)) {
        // CoC = clamp(1 - F/z, -1, 1) * largest: with `largest` the radius at infinity that is the metric
        // one, except for objects closer than half the focus distance.
        largest_px_ = input.lens.radius_at_infinity_px;
        if (largest_px_ <= 0)
            largest_px_ = std::max(-input.samples.nearest_coc_px, input.samples.farthest_coc_px);
    }

    // The picture of the last stage that was drawn, with its time.
    Picture stage(Stopwatch watch) const {
        const GatherStage stage = in_.options.of<GatherOwn>().gather.stage;
        const auto timed = [&](const char* pass, auto made) {
            watch.lap(pass);
            return made;
        };
        if (stage == GatherStage::Coc)
            return timed("radii", each([&](int x, int y) {
                             const float c = coc(x, y);
                             return Rgba{c, c, c, 1};
                         }));
        const HalfPicture half = timed("half size", prefiltered());
        if (stage == GatherStage::Prefilter) return timed("enlarged", enlarged(half.colour));
        if (stage == GatherStage::Taps)
            return timed("taps drawn", drawn(figure(half), *in_.services.workers));
        const bool apart = stage == GatherStage::NearFar || stage == GatherStage::Cure;
        const bool blind = stage == GatherStage::Disc || stage == GatherStage::DiscBlur;
        const Picture bokeh = timed(apart ? "near and far" : "disc", gathered(half, blind, apart));
        if (stage == GatherStage::Disc || stage == GatherStage::HardTest || stage == GatherStage::NearFar)
            return timed("enlarged", enlarged(bokeh));
        const Picture soft = timed("four-tap blur", blurred(bokeh));
        Picture large = timed("enlarged", enlarged(soft));
        if (stage == GatherStage::DiscBlur || stage == GatherStage::Blur) return large;
        return timed("combined", combined(large, apart));
    }

private:
    float coc(int x, int y) const {
        return std::clamp(in_.samples.coc_px.clamped(x, y), -largest_px_, largest_px_);
    }

    template <typename Make>
    Picture each(const Make& make) const {
        return each(in_.width(), in_.height(), make);
    }
    template <typename Make>
    Picture each(int width, int height, const Make& make) const {
        Picture picture = Picture::uninitialised(width, height);
        parallel_for(height, *in_.services.workers, [&](int y) {
            for (int x = 0; x < width; ++x) picture(x, y) = make(x, y);
        });
        return picture;
    }

    HalfPicture prefiltered() const {
        const int width = (in_.width() + 1) / 2, height = (in_.height() + 1) / 2;
        HalfPicture half{Picture(width, height), Plane(width, height)};
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
                    half.colour(x, y) += 0.25f * in_.samples.colour.clamped(2 * x + dx, 2 * y + dy);
                    const float c = coc(2 * x + dx, 2 * y + dy);
                    float& kept = half.coc_px(x, y);
                    if (!in_.options.of<GatherOwn>().gather.extreme_coc)
                        kept += 0.25f * c;
                    else if (std::abs(c) > std::abs(kept))
                        kept = c;
                }
        return half;
    }

    struct Read {
        Rgba colour;
        float coc_px;
    };
    // Reads a place of the disc around a cell, (x, y) in cells.
    Read read(const HalfPicture& half, float x, float y, const Place& p) const {
        const View<const Rgba> colour = half.colour;
        const View<const float> radii = half.coc_px;
        const float u = x + largest_px_ / 2 * p.x, v = y + largest_px_ / 2 * p.y;
        return {bilinear(u, v, [&](int i, int j) { return colour.clamped(i, j); }),
                bilinear(u, v, [&](int i, int j) { return radii.clamped(i, j); })};
    }
    float distance_px(const Place& p) const { return largest_px_ * std::hypot(p.x, p.y); }
    bool passes(float coc_px, const Place& p) const { return std::abs(coc_px) >= kTie * distance_px(p); }

    TapsFigure figure(const HalfPicture& half) const {
        const auto cell = [](int pixel) { return std::floor(float(pixel) / 2); };
        return {each([&](int x, int y) { return in_.samples.colour(x, y); }),
                [&half, cell, this](int x, int y, float u, float v) {
                    return read(half, cell(x), cell(y), {u, v}).colour;
                },
                [&half, cell, this](int x, int y) {
                    std::vector<DrawnTap> taps;
                    for (const Place& p : disc_) {
                        const float r = read(half, cell(x), cell(y), p).coc_px;
                        const float reach = largest_px_ > 0 ? std::abs(r) / largest_px_ : 0;
                        taps.push_back({p.x, p.y, reach, r > 0, passes(r, p)});
                    }
                    return taps;
                }};
    }

    // blind: every tap counts. apart: near and far by saturate(-+CoC - distance); else by |CoC| >= distance.
    Picture gathered(const HalfPicture& half, bool blind, bool apart) const {
        const View<const Rgba> colour = half.colour;
        return each(colour.width(), colour.height(), [&](int x, int y) {
            Rgba sum, near;
            float weight = 0, near_weight = 0;
            for (const Place& p : disc_) {
                const auto [c, r] = read(half, float(x), float(y), p);
                const float distance = distance_px(p);
                const float w = blind   ? 1.0f
                                : apart ? std::clamp(r - distance, 0.0f, 1.0f)
                                        : float(passes(r, p));
                sum += w * c, weight += w;
                const float n = apart ? std::clamp(-r - distance, 0.0f, 1.0f) : 0;
                near += n * c, near_weight += n;
            }
            const auto mean = [](Rgba total, float w) { return w > 0 ? total * (1 / w) : Rgba{}; };
            if (!apart) return weight > 0 ? mean(sum, weight) : colour(x, y);
            const float alpha = std::min(1.0f, near_weight);
            Rgba result = mixed(mean(sum, weight), mean(near, near_weight), alpha);
            result.a = alpha;
            return result;
        });
    }

    // Four taps at the same offset on both axes. At half a cell, bilinear reads make them a tent of 3 x 3
    // cells; at a whole cell, as published, they read only the corners of that square.
    Picture blurred(const Picture& half) const {
        const View<const Rgba> from = half;
        const float off = float(in_.options.of<GatherOwn>().gather.tap_offset);
        return each(half.width(), half.height(), [&](int x, int y) {
            Rgba sum;
            for (const float dx : {-off, off})
                for (const float dy : {-off, off})
                    sum += 0.25f * bilinear(float(x) + dx, float(y) + dy,
                                            [&](int i, int j) { return from.clamped(i, j); });
            return sum;
        });
    }

    Picture enlarged(const Picture& half) const {
        const View<const Rgba> from = half;
        return each([&](int x, int y) {
            return bilinear((float(x) + 0.5f) / 2 - 0.5f, (float(y) + 0.5f) / 2 - 0.5f,
                            [&](int i, int j) { return from.clamped(i, j); });
        });
    }

    Picture combined(const Picture& bokeh, bool apart) const {
        const float sharp_px = float(in_.options.of<GatherOwn>().gather.pixel_size_px);
        const float blurred_px =
            float(in_.options.of<GatherOwn>().gather.blurred_px.value_or(apart ? kFarBlurredPx : kBlurredPx));
        return each([&](int x, int y) {
            const Rgba sharp = in_.samples.colour(x, y);
            Rgba soft = bokeh(x, y);
            const float near = soft.a;
            if (apart) soft.a = sharp.a;
            if (!apart) return mixed(sharp, soft, smoothstep(sharp_px, blurred_px, std::abs(coc(x, y))));
            const Rgba with_far = mixed(sharp, soft, smoothstep(sharp_px, blurred_px, coc(x, y)));
            return mixed(with_far, soft, near);
        });
    }

    const EngineView& in_;
    std::vector<Place> disc_;
    float largest_px_ = 0;
};

}  // namespace

Result<Output> run_gather_stage(const EngineView& input) {
    Output output;
    output.image = Article(input).stage(Stopwatch(output.stages));
    output.warnings.emplace_back("this picture is a stage of the published gather method, not a result");
    return output;
}

}  // namespace petzval::engine
