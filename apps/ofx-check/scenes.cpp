#include "scenes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace ofx_check {

Picture scene(const ofx::RectI& bounds, int channels, unsigned seed) {
    Picture picture(bounds, channels);
    for (int y = bounds.y1; y < bounds.y2; ++y)
        for (int x = bounds.x1; x < bounds.x2; ++x) {
            const int u = x - bounds.x1, v = y - bounds.y1;
            // Blocks of a few values between 1/8 and 1, one bright point for every 16 x 16 pixels.
            const unsigned block = (unsigned(u / 12) * 7u + unsigned(v / 12) * 13u + seed * 5u) % 8u;
            const bool is_point = u % 16 == 5 && v % 16 == 9;
            for (int c = 0; c < channels; ++c) {
                const float ramp = float(u + 2 * v) / float(3 * (picture.width() + picture.height()));
                const float value = float(block + 1) / 8 * (c == 1 ? 0.7f : 1.0f) * (0.7f + ramp);
                picture.at(x, y, c) =
                    c == 3 ? 1.0f : std::min(value, 1.0f) * (is_point && seed == 0 ? 4.0f : 1.0f);
            }
        }
    return picture;
}

ofx::RectI scaled(const ofx::RectI& b, ofx::Point scale) {
    return {int(std::floor(b.x1 * scale.x)), int(std::floor(b.y1 * scale.y)), int(std::ceil(b.x2 * scale.x)),
            int(std::ceil(b.y2 * scale.y))};
}

// Means of the pixels below each; scales of 1 and of 1 over a whole number.
Picture scaled(const Picture& picture, ofx::Point scale) {
    if (scale.x == 1 && scale.y == 1) return picture;
    Picture small(scaled(picture.bounds, scale), picture.channels);
    const int across = int(std::lround(1 / scale.x)), down = int(std::lround(1 / scale.y));
    for (int y = small.bounds.y1; y < small.bounds.y2; ++y)
        for (int x = small.bounds.x1; x < small.bounds.x2; ++x)
            for (int c = 0; c < small.channels; ++c) {
                double sum = 0;
                int count = 0;
                for (int j = y * down; j < (y + 1) * down; ++j)
                    for (int i = x * across; i < (x + 1) * across; ++i)
                        if (picture.holds(i, j)) sum += double(picture.at(i, j, c)), ++count;
                small.at(x, y, c) = count ? float(sum / count) : 0.0f;
            }
    return small;
}

ofx::RectI scaled_region(const ofx::Effect& effect, const ofx::Clip& clip) {
    if (clip.name == ofx::kOutput) {
        const ofx::Clip* source = effect.find(ofx::kSource);
        return source ? scaled(source->picture.bounds, state_of(effect).request.scale)
                      : state_of(effect).output_bounds;
    }
    return scaled(clip.picture.bounds, state_of(effect).request.scale);
}

Picture input_of(const ofx::Effect& effect, const ofx::Clip& clip) {
    Picture picture = scaled(clip.picture, state_of(effect).request.scale);
    const FrameState& frame = state_of(effect);
    const auto needed = frame.needed.find(&clip);
    if (!frame.request.only_needed || needed == frame.needed.end() || needed->second.x2 <= needed->second.x1)
        return picture;
    const ofx::RectI &b = picture.bounds, &n = needed->second;
    const ofx::RectI part{std::max(b.x1, n.x1), std::max(b.y1, n.y1), std::min(b.x2, n.x2),
                          std::min(b.y2, n.y2)};
    return part.x2 > part.x1 && part.y2 > part.y1 ? part_of(picture, part) : picture;
}

int output_channels(const ofx::Effect& effect) {
    const ofx::Clip* output = effect.find(ofx::kOutput);
    const std::string components = output ? output->properties.text(ofx::kComponents) : ofx::kRgba;
    if (components == ofx::kAlpha) return 1;
    return components == ofx::kRgb ? 3 : 4;
}

Depth depth_of(const ofx::Effect& effect) {
    const ofx::Clip* output = effect.find(ofx::kOutput);
    const std::string depth = output ? output->properties.text(ofx::kPixelDepth) : ofx::kFloat;
    if (depth == ofx::kByte) return Depth::Byte;
    return depth == ofx::kShort ? Depth::Short : Depth::Float;
}

const char* components_name(int channels) {
    if (channels == 1) return ofx::kAlpha;
    return channels == 3 ? ofx::kRgb : ofx::kRgba;
}

Picture part_of(const Picture& picture, const ofx::RectI& part) {
    Picture cut(part, picture.channels);
    for (int y = part.y1; y < part.y2; ++y)
        for (int x = part.x1; x < part.x2; ++x)
            for (int c = 0; c < picture.channels && picture.holds(x, y); ++c)
                cut.at(x, y, c) = picture.at(x, y, c);
    return cut;
}

namespace {

bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

}  // namespace

bool same(const Picture& a, const Picture& b) {
    return a.values.size() == b.values.size() &&
           std::equal(a.values.begin(), a.values.end(), b.values.begin(), same_bits);
}

std::string first_difference(const Picture& a, const Picture& b) {
    if (a.values.size() != b.values.size()) return "another size";
    std::size_t count = 0, first = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        if (!same_bits(a.values[i], b.values[i]) && count++ == 0) first = i;
    const std::size_t pixel = first / std::size_t(a.channels);
    const std::size_t width = std::size_t(a.width());
    return std::to_string(count) + " of " + std::to_string(a.values.size()) +
           " values differ, the first at pixel " + std::to_string(a.bounds.x1 + int(pixel % width)) + "," +
           std::to_string(a.bounds.y1 + int(pixel / width)) + ": " + std::to_string(a.values[first]) +
           " and " + std::to_string(b.values[first]);
}

double mean_difference(const Picture& a, const Picture& b) {
    if (a.values.empty() || a.values.size() != b.values.size()) return INFINITY;
    double sum = 0;
    for (std::size_t i = 0; i < a.values.size(); ++i)
        sum += std::abs(double(a.values[i]) - double(b.values[i]));
    return sum / double(a.values.size());
}

}  // namespace ofx_check
