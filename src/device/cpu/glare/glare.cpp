#include "device/cpu/glare/glare.h"

#include "base/parallel.h"
#include "device/cpu/glare/bloom.h"
#include "device/cpu/glare/convolve.h"
#include "device/cpu/glare/streaks.h"

#include <cmath>
#include <cstddef>

namespace petzval::device {

using glare::GlarePlan;
using glare::usable;

namespace {

Picture usable_light(View<const Rgba> picture, Workers& workers) {
    Picture light = Picture::uninitialised(picture.width(), picture.height());
    parallel_for(light.height(), workers, [&](int y) {
        for (int x = 0; x < light.width(); ++x) light(x, y) = usable(picture(x, y));
    });
    return light;
}

// Makes colours finite and subtracts the light that each part of glare takes. `bright` and `bloom_light` may
// be empty: then nothing is taken of them.
void take(View<Rgba> picture, View<const Rgba> bright, View<const Rgba> bloom_light, const GlarePlan& plan,
          Workers& workers) {
    parallel_for(picture.height(), workers, [&](int y) {
        for (int x = 0; x < picture.width(); ++x) {
            const Rgba c = picture(x, y);
            const auto finite = [](float v) { return std::isfinite(v) ? v : 0.0f; };
            Rgba left = Rgba{finite(c.r), finite(c.g), finite(c.b), 0} - plan.of_all * usable(c);
            if (!bright.empty()) left -= plan.of_highlights * bright(x, y);
            if (!bloom_light.empty()) left -= plan.of_bloom_light * bloom_light(x, y);
            picture(x, y) = {left.r, left.g, left.b, c.a};
        }
    });
}

// Adds to colour; alpha stays.
void add(View<Rgba> picture, View<const Rgba> light, float amount, Workers& workers) {
    parallel_for(picture.height(), workers, [&](int y) {
        for (int x = 0; x < picture.width(); ++x) {
            const Rgba c = amount * light(x, y);
            picture(x, y) += Rgba{c.r, c.g, c.b, 0};
        }
    });
}

void add_veil(View<Rgba> picture, const Picture& light, float amount, Workers& workers) {
    double r = 0, g = 0, b = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const Rgba& c = light.pixels()[i];
        r += double(c.r), g += double(c.g), b += double(c.b);
    }
    const double n = double(light.size());
    const Rgba mean = amount * Rgba{float(r / n), float(g / n), float(b / n), 0};
    parallel_for(picture.height(), workers, [&](int y) {
        for (int x = 0; x < picture.width(); ++x) picture(x, y) += mean;
    });
}

}  // namespace

Picture highlights(View<const Rgba> picture, float threshold, Workers& workers) {
    Picture bright = Picture::uninitialised(picture.width(), picture.height());
    parallel_for(bright.height(), workers, [&](int y) {
        for (int x = 0; x < bright.width(); ++x) bright(x, y) = glare::highlight(picture(x, y), threshold);
    });
    return bright;
}

void add_planned_glare(const GlarePlan& plan, View<Rgba> picture, Workers& workers, const Passed& passed) {
    const auto done = [&](const char* part) {
        if (passed) passed(part);
    };
    const Picture light = usable_light(picture, workers);
    Picture bright, bloom_light;
    if (plan.of_highlights > 0) bright = highlights(light, plan.threshold, workers);
    if (plan.of_bloom_light > 0) bloom_light = highlights(light, plan.bloom_threshold, workers);
    take(picture, bright, bloom_light, plan, workers);
    done("highlights of glare");
    if (plan.bloom > 0) {
        add(picture, bloom(bloom_light.empty() ? light : bloom_light, plan.bloom_layers, workers), plan.bloom,
            workers);
        done("bloom");
    }
    if (!plan.streaks.empty()) add_streaks(picture, bright, plan.streaks, plan.star, workers);
    if (plan.filter) add_convolved(picture, bright, *plan.filter, plan.star, workers);
    if (plan.star > 0) done("star");
    if (plan.ghosts > 0) add(picture, plan.ghost_light, plan.ghosts, workers), done("ghosts");
    if (plan.veil > 0) add_veil(picture, light, plan.veil, workers), done("veil");
}

}  // namespace petzval::device
