#include "session/matte_range.h"

#include <algorithm>
#include <array>
#include <atomic>

namespace petzval {
namespace {

constexpr std::array kChannels{&Rgba::r, &Rgba::g, &Rgba::b};

bool is_within(View<const Rgba> picture, float Rgba::*channel, Workers& workers) {
    std::atomic<bool> within = true;
    parallel_for(picture.height(), workers, [&](int y) {
        const Rgba* const row = picture.row(y);
        if (!std::all_of(row, row + picture.width(),
                         [&](const Rgba& c) { return c.*channel >= 0 && c.*channel <= 1; }))
            within = false;
    });
    return within;
}

}  // namespace

void keep_matte_range(DefocusReport& report, const Rendered& rendered, Workers& workers) {
    for (std::size_t i = 0; i < report.layers.size(); ++i) {
        if (rendered.layers[i].is_light) continue;
        Picture& blurred = report.layers[i];
        for (float Rgba::*const channel : kChannels) {
            if (!is_within(rendered.layers[i].colour, channel, workers)) continue;
            parallel_for(blurred.height(), workers, [&](int y) {
                for (int x = 0; x < blurred.width(); ++x) {
                    float& value = blurred(x, y).*channel;
                    value = std::clamp(value, 0.0f, 1.0f);
                }
            });
        }
    }
}

}  // namespace petzval
