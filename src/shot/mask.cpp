// A mask from a separate file, which limits the effect.
#include "shot/file_of_shot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <utility>

namespace petzval {

FileChannel file_channel(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    std::error_code missing;
    if (colon == std::string::npos || colon == 0 || colon + 1 == text.size() ||
        text.find('/', colon) != std::string::npos || std::filesystem::exists(text, missing))
        return {text, ""};
    return {text.substr(0, colon), text.substr(colon + 1)};
}

namespace shot {
namespace {

// Values over a window.
struct Values {
    Plane plane;
    Rect window;
    std::string what;  // for the log
};

template <typename Of>
Plane plane_of(const Picture& colour, const Of& of) {
    Plane plane = Plane::uninitialised(colour.width(), colour.height());
    for (std::size_t i = 0; i < plane.size(); ++i) plane.pixels()[i] = of(colour.pixels()[i]);
    return plane;
}

// The mask's values if no channel was named.
Values usual_values(const Frame& frame) {
    const Picture& colour = frame.colour;
    const bool uses_alpha = frame.has_alpha && std::any_of(colour.pixels(), colour.pixels() + colour.size(),
                                                           [](const Rgba& c) { return c.a != 1; });
    if (uses_alpha)
        return {plane_of(colour, [](const Rgba& c) { return c.a; }), frame.place.data_window, "its alpha"};
    return {plane_of(colour, [](const Rgba& c) { return luminance(c); }), frame.place.data_window,
            "its luminance"};
}

bool is_exr(const Frame& header) {
    const std::string& type = header.parts.front().type;
    return type != "png" && type != "jpeg" && type != "tiff";
}

Result<Values> one_colour(const Frame& frame, const FileChannel& from) {
    static const std::string kColours = "RGBA";
    const std::size_t which = from.channel.size() == 1 ? kColours.find(from.channel) : std::string::npos;
    if (which == std::string::npos || (which == 3 && !frame.has_alpha))
        return Error{ErrorCode::InvalidArgument, from.file + ": has no channel '" + from.channel +
                                                     "'; it has R, G, B" + (frame.has_alpha ? " and A" : "")};
    const auto value = [&](const Rgba& c) {
        const float of[] = {c.r, c.g, c.b};
        return which == 3 ? c.a : c.a > 0 ? of[which] / c.a : 0;  // as stored: not premultiplied
    };
    return Values{plane_of(frame.colour, value), frame.place.data_window, from.channel};
}

// One channel of an EXR over the frame, read like depth from a separate file.
Result<Values> one_channel(const FileChannel& from, ReadOptions options, const Place& place) {
    options.depth_file = from.file, options.depth_channel = from.channel;
    Place frame = place;
    frame.data_window = place.display_window;
    auto read = read_depth_file(options, frame);
    if (!read) return read.error();
    return Values{std::move(read->depth), place.display_window,
                  from.channel.empty() ? "its only channel" : from.channel};
}

Result<Values> read_values(const Reading& r, const FileChannel& from) {
    ReadOptions options;
    options.workers = &r.workers;
    options.need_depth = false;
    options.transfer = Transfer::Linear;  // shares, no light
    options.max_memory_bytes = r.source.read.max_memory_bytes;
    const auto header = read_frame_header(from.file, options);
    if (!header) return header.error();
    if (Status same = same_frame(r, *header, "shot.mask " + from.file); !same) return same.error();
    if (!from.channel.empty() && is_exr(*header)) return one_channel(from, options, r.shot.place);
    auto frame = read_frame(from.file, options);
    if (!frame && is_exr(*header))  // without colour
        if (auto only = one_channel(from, options, r.shot.place)) return only;
    if (!frame) return frame.error();
    return from.channel.empty() ? usual_values(*frame) : one_colour(*frame, from);
}

// A value outside of 0…1 is the nearer end; what a file does not cover is infinite, and nothing.
float share(float value) { return value > 0 && std::isfinite(value) ? std::min(value, 1.0f) : 0.0f; }

// A PNG of the codes 0 and 1, or a matte in codes of 8 bits as floats, is hardly meant.
void warn_of_range(const Plane& values, std::vector<std::string>& warnings) {
    constexpr float kNothing = 0.02f;
    float least = std::numeric_limits<float>::infinity(), most = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const float value = values.pixels()[i];
        if (!std::isfinite(value)) continue;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    std::array<char, 120> text{};
    if (most < kNothing)
        std::snprintf(text.data(), text.size(), "mask: is at most %.3g, so the picture hardly changes", most);
    else if (least < -kNothing || most > 1 + kNothing)
        std::snprintf(text.data(), text.size(), "mask: has values from %.3g to %.3g: it is cut to 0 to 1",
                      least, most);
    if (text[0] != 0) warnings.emplace_back(text.data());
}

}  // namespace

Status read_mask(Reading& r) {
    const FileChannel from = file_channel(r.source.mask);
    const auto values = read_values(r, from);
    if (!values) return values.error();
    const Place& place = r.shot.place;
    r.shot.mask_window = place.display_window;
    r.shot.mask = Plane(place.display_window.width(), place.display_window.height(), 0.0f);
    const Rect both = values->window.intersected(place.display_window);
    for (int y = both.y0; y < both.y1; ++y)
        for (int x = both.x0; x < both.x1; ++x)
            r.shot.mask(x - place.display_window.x0, y - place.display_window.y0) =
                share(values->plane(x - values->window.x0, y - values->window.y0));
    extend_mask(r.shot, place.data_window);
    r.shot.detected.push_back("mask: " + from.file + ", " + values->what);
    warn_of_range(values->plane, r.shot.warnings);
    return Done{};
}

void extend_mask(Shot& shot, const Rect& window) {
    const Rect old = shot.mask_window, wider = around(old, window);
    if (shot.mask.empty() || wider == old) return;
    Plane plane = Plane::uninitialised(wider.width(), wider.height());
    for (int y = wider.y0; y < wider.y1; ++y)
        for (int x = wider.x0; x < wider.x1; ++x)
            plane(x - wider.x0, y - wider.y0) = shot.mask(std::clamp(x, old.x0, old.x1 - 1) - old.x0,
                                                          std::clamp(y, old.y0, old.y1 - 1) - old.y0);
    shot.mask = std::move(plane), shot.mask_window = wider;
}

}  // namespace shot
}  // namespace petzval
