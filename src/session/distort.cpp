#include "session/distort.h"

#include "base/parallel.h"
#include "optics/distortion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace petzval {
namespace {

// A row or a column of the data window.
struct Side {
    int size = 0;
    bool begins_inside = false, ends_inside = false;  // of the frame: nothing lies beyond

    // The pixel that stands for one, -1 for none.
    int standing_for(int at) const {
        if ((at < 0 && begins_inside) || (at >= size && ends_inside)) return -1;
        if (at < 0) at = -1 - at;
        if (at >= size) at = 2 * size - 1 - at;
        return std::clamp(at, 0, size - 1);
    }
};
struct Sides {
    Side x, y;

    explicit Sides(const Place& p)
        : x{p.data_window.width(), p.data_window.x0 > p.display_window.x0,
            p.data_window.x1 < p.display_window.x1},
          y{p.data_window.height(), p.data_window.y0 > p.display_window.y0,
            p.data_window.y1 < p.display_window.y1} {}
};

// Between pixels by cubic lines (E. Catmull, R. Rom, 1974), kept within the four nearest pixels: what is
// bright throws no dark rings.
Rgba sampled(const Picture& picture, const Rect& seen, const Sides& sides, double x, double y) {
    const int left = int(std::floor(x)), top = int(std::floor(y));
    const auto weights = [](double at) {
        const float t = float(at), u = 1 - t;
        return std::array{-0.5f * t * u * u, 1 - 2.5f * t * t + 1.5f * t * t * t,
                          1 - 2.5f * u * u + 1.5f * u * u * u, -0.5f * u * t * t};
    };
    const auto across = weights(x - left), down = weights(y - top);
    Rgba sum, least, most;
    bool first = true;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
            const int px = sides.x.standing_for(left - 1 + i), py = sides.y.standing_for(top - 1 + j);
            const Rgba p = px < 0 || py < 0 ? Rgba{}
                                            : picture(std::clamp(px - seen.x0, 0, picture.width() - 1),
                                                      std::clamp(py - seen.y0, 0, picture.height() - 1));
            sum += p * (across[std::size_t(i)] * down[std::size_t(j)]);
            if (i == 0 || i == 3 || j == 0 || j == 3) continue;
            least = first ? p
                          : Rgba{std::min(least.r, p.r), std::min(least.g, p.g), std::min(least.b, p.b),
                                 std::min(least.a, p.a)};
            most = first ? p
                         : Rgba{std::max(most.r, p.r), std::max(most.g, p.g), std::max(most.b, p.b),
                                std::max(most.a, p.a)};
            first = false;
        }
    return {std::clamp(sum.r, least.r, most.r), std::clamp(sum.g, least.g, most.g),
            std::clamp(sum.b, least.b, most.b), std::clamp(sum.a, least.a, most.a)};
}

// Where what is seen at (x, y) comes from, in pixels; nothing where nothing is seen.
struct Origin {
    double x = 0, y = 0;
};
std::optional<Origin> origin_of(int x, int y, const PixelField& field, double amount) {
    const double right = x + 0.5 - field.field_centre_x;
    const double down = (y + 0.5 - field.field_centre_y) / field.pixel_aspect;
    const double target = field.field_per_px * std::hypot(right, down);
    const auto from = optics::undistorted(target, amount);
    if (!from) return std::nullopt;
    const double scale = target > 0 ? *from / target : 1;
    return Origin{field.field_centre_x + scale * right - 0.5,
                  field.field_centre_y + scale * down * field.pixel_aspect - 0.5};
}

// The least rectangle that the border of some pixels shows: what lies inside of a border stays inside of it.
// Nothing where a part of the border shows nothing.
std::optional<Rect> shown_by(const Rect& pixels, const PixelField& field, double amount) {
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    bool all = true;
    const auto include = [&](int x, int y) {
        const auto from = origin_of(x, y, field, amount);
        all = all && from;
        if (!from) return;
        left = std::min(left, from->x), right = std::max(right, from->x);
        top = std::min(top, from->y), bottom = std::max(bottom, from->y);
    };
    for (int x = pixels.x0; x < pixels.x1; ++x) include(x, pixels.y0), include(x, pixels.y1 - 1);
    for (int y = pixels.y0; y < pixels.y1; ++y) include(pixels.x0, y), include(pixels.x1 - 1, y);
    if (!all) return std::nullopt;
    return Rect{int(std::floor(left)), int(std::floor(top)), int(std::ceil(right)) + 1,
                int(std::ceil(bottom)) + 1};
}

// With the pixels whose mirror images lie beyond the ends of a side.
void reflect(int& first, int& end, int size) {
    const int low = first, high = end;
    if (low < 0) end = std::max(end, -low);
    if (high > size) first = std::min(first, 2 * size - high);
    first = std::clamp(first, 0, size), end = std::clamp(end, 0, size);
}

}  // namespace

Picture distorted(const Picture& picture, const Rect& seen, const Place& place, double amount,
                  Workers& workers) {
    const PixelField field = place.field();
    const Sides sides(place);
    Picture result = Picture::uninitialised(picture.width(), picture.height());
    parallel_for(picture.height(), workers, [&](int y) {
        for (int x = 0; x < picture.width(); ++x) {
            const auto from = origin_of(seen.x0 + x, seen.y0 + y, field, amount);
            result(x, y) = from ? sampled(picture, seen, sides, from->x, from->y) : Rgba{};
        }
    });
    return result;
}

Rect before_distortion(const Rect& pixels, const Place& place, double amount) {
    constexpr int kBetween = 3;  // pixels that sampled() looks at, and one
    const auto border = shown_by(pixels, place.field(), amount);
    if (!border) return {0, 0, place.data_window.width(), place.data_window.height()};
    Rect shown = border->grown(kBetween);
    reflect(shown.x0, shown.x1, place.data_window.width());
    reflect(shown.y0, shown.y1, place.data_window.height());
    return shown;
}

int missing_beyond_px(const Place& place, double amount) {
    if (amount >= 0) return 0;
    const Sides sides(place);
    const Rect frame = place.display_window.moved(-place.data_window.x0, -place.data_window.y0);
    // Where the frame's corners show nothing, all around it is seen as far as distortion reaches.
    const Rect shown =
        shown_by(frame, place.field(), amount).value_or(frame.grown(distortion_reach_px(place, amount)));
    int most = 0;
    if (!sides.x.begins_inside) most = std::max(most, -shown.x0);
    if (!sides.y.begins_inside) most = std::max(most, -shown.y0);
    if (!sides.x.ends_inside) most = std::max(most, shown.x1 - sides.x.size);
    if (!sides.y.ends_inside) most = std::max(most, shown.y1 - sides.y.size);
    return most;
}

}  // namespace petzval
