#include "session/rendered/distort.h"

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

// Sixteen pixels around a place between four of them, and their weights by cubic lines (E. Catmull, R. Rom,
// 1974) and by straight ones.
class Neighbours {
public:
    Neighbours(const Rect& seen, const Sides& sides, double x, double y) {
        const int left = int(std::floor(x)), top = int(std::floor(y));
        right_ = float(x - left), below_ = float(y - top);
        across_ = cubic_weights(right_), down_ = cubic_weights(below_);
        for (std::size_t i = 0; i < 4; ++i) {
            columns_[i] = sides.x.standing_for(left - 1 + int(i));
            rows_[i] = sides.y.standing_for(top - 1 + int(i));
            if (columns_[i] >= 0) columns_[i] = std::clamp(columns_[i] - seen.x0, 0, seen.width() - 1);
            if (rows_[i] >= 0) rows_[i] = std::clamp(rows_[i] - seen.y0, 0, seen.height() - 1);
        }
    }

    Rgba cubic(const Picture& picture) const {
        Rgba sum;
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t i = 0; i < 4; ++i) sum += at(picture, i, j) * (across_[i] * down_[j]);
        return sum;
    }
    // The four nearest.
    std::array<Rgba, 4> nearest(const Picture& picture) const {
        return {at(picture, 1, 1), at(picture, 2, 1), at(picture, 1, 2), at(picture, 2, 2)};
    }
    Rgba straight(const std::array<Rgba, 4>& near) const {
        return (near[0] * (1 - right_) + near[1] * right_) * (1 - below_) +
               (near[2] * (1 - right_) + near[3] * right_) * below_;
    }

private:
    static std::array<float, 4> cubic_weights(float t) {
        const float u = 1 - t;
        return {-0.5f * t * u * u, 1 - 2.5f * t * t + 1.5f * t * t * t, 1 - 2.5f * u * u + 1.5f * u * u * u,
                -0.5f * u * t * t};
    }
    Rgba at(const Picture& picture, std::size_t i, std::size_t j) const {
        return columns_[i] < 0 || rows_[j] < 0 ? Rgba{} : picture(columns_[i], rows_[j]);
    }

    std::array<int, 4> columns_{}, rows_{};  // -1: emptiness
    std::array<float, 4> across_{}, down_{};
    float right_ = 0, below_ = 0;
};

template <typename Pick>  // pick(std::array<float, 4>) of each channel
Rgba of_channels(const std::array<Rgba, 4>& p, const Pick& pick) {
    return {
        pick(std::array{p[0].r, p[1].r, p[2].r, p[3].r}), pick(std::array{p[0].g, p[1].g, p[2].g, p[3].g}),
        pick(std::array{p[0].b, p[1].b, p[2].b, p[3].b}), pick(std::array{p[0].a, p[1].a, p[2].a, p[3].a})};
}
Rgba least_of(const std::array<Rgba, 4>& p) {
    return of_channels(p, [](const auto& v) { return *std::min_element(v.begin(), v.end()); });
}
Rgba most_of(const std::array<Rgba, 4>& p) {
    return of_channels(p, [](const auto& v) { return *std::max_element(v.begin(), v.end()); });
}

// Cubic, kept within the four nearest pixels: what is bright throws no dark rings.
Rgba sampled(const Picture& picture, const Neighbours& around) {
    const auto near = around.nearest(picture);
    const Rgba sum = around.cubic(picture), least = least_of(near), most = most_of(near);
    return {std::clamp(sum.r, least.r, most.r), std::clamp(sum.g, least.g, most.g),
            std::clamp(sum.b, least.b, most.b), std::clamp(sum.a, least.a, most.a)};
}

// Weight of the cubic mean against the linear one in sampled(), 0…1 by channel.
Rgba share_of_cubic(const Picture& picture, const Neighbours& around) {
    const auto near = around.nearest(picture);
    const Rgba cubic = around.cubic(picture), straight = around.straight(near), least = least_of(near),
               most = most_of(near);
    const auto share = [](float to, float from, float low, float high) {
        const float end = std::clamp(to, low, high);
        return end == to ? 1.0f : std::clamp((end - from) / (to - from), 0.0f, 1.0f);
    };
    return {share(cubic.r, straight.r, least.r, most.r), share(cubic.g, straight.g, least.g, most.g),
            share(cubic.b, straight.b, least.b, most.b), share(cubic.a, straight.a, least.a, most.a)};
}

// Source position of the image at (x, y), in pixels; nothing if nothing is visible there.
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

// sample(Neighbours) at the origin of every pixel.
template <typename Sample>
Picture moved(const Rect& seen, const Place& place, double amount, Workers& workers, const Sample& sample) {
    const PixelField field = place.field();
    const Sides sides(place);
    Picture result = Picture::uninitialised(seen.width(), seen.height());
    parallel_for(seen.height(), workers, [&](int y) {
        for (int x = 0; x < seen.width(); ++x) {
            const auto from = origin_of(seen.x0 + x, seen.y0 + y, field, amount);
            result(x, y) = from ? sample(Neighbours(seen, sides, from->x, from->y)) : Rgba{};
        }
    });
    return result;
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
    return moved(seen, place, amount, workers,
                 [&](const Neighbours& around) { return sampled(picture, around); });
}

Picture distorted_beside(const Picture& picture, const Picture& layer, bool is_light, const Rect& seen,
                         const Place& place, double amount, Workers& workers) {
    return moved(seen, place, amount, workers, [&](const Neighbours& around) {
        const Rgba share = share_of_cubic(picture, around);
        const Rgba of = is_light ? share : Rgba{share.a, share.a, share.a, share.a};
        const Rgba straight = around.straight(around.nearest(layer));
        Rgba sum = straight + (around.cubic(layer) - straight) * of;
        sum.a = sampled(layer, around).a;
        return sum;
    });
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
    // If the frame's corners show nothing, everything around it is seen as far as distortion reaches.
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
