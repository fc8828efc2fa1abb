#include "petzval/depth.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace petzval {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kMissFrom = 1e10f;       // Blender and others write 1e10 where a ray hit nothing
constexpr float kHalfMaximum = 65504.f;  // what 1e10 or infinity becomes in a half-float channel

// True if values are 0…1 between the ends of a range.
bool is_ranged(const DepthSettings& s) {
    return s.kind == DepthKind::Normalized || s.kind == DepthKind::Device || is_mist(s.kind) ||
           (s.kind == DepthKind::Inverse && s.range_near && s.range_far);
}
bool needs_angles(DepthKind kind) { return kind == DepthKind::Ray || is_mist(kind); }
// Ends may be infinite where values are linear in 1/z.
bool is_by_inverse(DepthKind kind) { return kind == DepthKind::Device || kind == DepthKind::Inverse; }

// A value that means "nothing there" whatever its sign. 0 is one, except where it is the end of a range.
bool is_miss(float stored, bool ranged) {
    const float size = std::abs(stored);
    return !std::isfinite(stored) || size >= kMissFrom || size == kHalfMaximum || (size == 0 && !ranged);
}

Status check(const DepthSettings& s) {
    // Messages begin with the field.
    const auto refuse = [](const std::string& message) {
        return Error{ErrorCode::InvalidArgument, message, message.substr(0, message.find(' '))};
    };
    const auto words = [](double v) { return (std::ostringstream() << v).str(); };
    const auto got = [&](double v) { return ", got " + words(v); };
    if (s.kind == DepthKind::CocPx)
        return refuse("depth.kind coc-px holds circle-of-confusion radii, not distances in metres");
    if (!(s.unit_scale_m > 0) || !std::isfinite(s.unit_scale_m))
        return refuse("depth.unit_scale_m must be > 0 metres per unit" + got(s.unit_scale_m));
    if (needs_angles(s.kind)) {
        if (!s.focal_length_mm || !s.sensor_width_mm)
            return refuse(
                "depth.kind ray and mist need camera.focal_length_mm and camera.sensor_width_mm: the angle "
                "of "
                "each pixel");
        if (!(*s.focal_length_mm > 0) || !std::isfinite(*s.focal_length_mm))
            return refuse("camera.focal_length_mm must be > 0 mm" + got(*s.focal_length_mm));
        if (!(*s.sensor_width_mm > 0) || !std::isfinite(*s.sensor_width_mm))
            return refuse("camera.sensor_width_mm must be > 0 mm" + got(*s.sensor_width_mm));
    }
    if (is_ranged(s)) {
        if (!s.range_near || !s.range_far)
            return refuse("depth.kind normalized, device and mist need depth.range NEAR,FAR");
        const double near = *s.range_near, far = *s.range_far;
        const bool inverse = is_by_inverse(s.kind);
        if (!(near > 0 || (near == 0 && !inverse)) || !(far > 0 || (far == 0 && !inverse)) || near == far)
            return refuse("depth.range needs two different distances > 0" + got(near) + "," + words(far));
        if ((std::isinf(near) || std::isinf(far)) && !inverse)
            return refuse("depth.range may be infinite only for depth.kind device and inverse");
    }
    return Done{};
}

// Turns one stored value into planar metres: what the kind says, without misses and signs.
class Converter {
public:
    Converter(const Place& place, const DepthSettings& s)
        : kind_(s.kind), ranged_(is_ranged(s)), scale_m_(s.unit_scale_m) {
        if (s.range_near) near_ = *s.range_near;
        if (s.range_far) far_ = *s.range_far;
        if (needs_angles(kind_)) {
            const Rect& display = place.display_window;
            tan_per_px_x_ = *s.sensor_width_mm / *s.focal_length_mm / display.width();
            tan_per_px_y_ = tan_per_px_x_ / place.pixel_aspect;
            axis_x_ = 0.5 * (double(display.x0) + display.x1);
            axis_y_ = 0.5 * (double(display.y0) + display.y1);
        }
    }

    // `x`, `y`: the pixel in the frame of the display window.
    float metres(double stored, int x, int y) const { return float(scale_m_ * planar(stored, x, y)); }
    // Inverse and reversed kinds turn near into far: deep samples must be ordered again.
    bool reverses_order() const { return (kind_ == DepthKind::Inverse) != (ranged_ && near_ > far_); }
    bool is_miss(float stored) const { return petzval::is_miss(stored, ranged_); }

private:
    // The share of the way between both ends that a value of mist stands for.
    double mist_way(double stored) const {
        if (kind_ == DepthKind::MistLinear) return stored;
        return kind_ == DepthKind::MistInverse ? stored * stored : std::sqrt(stored);
    }

    double planar(double stored, int x, int y) const {
        switch (kind_) {
            case DepthKind::Ray:
                return stored * cosine(x, y);
            case DepthKind::Inverse:
                return ranged_ ? device(1 - stored) : 1 / stored;
            case DepthKind::Mist:
            case DepthKind::MistLinear:
            case DepthKind::MistInverse:
                return (near_ + mist_way(std::max(stored, 0.0)) * (far_ - near_)) * cosine(x, y);
            case DepthKind::Normalized:
                return near_ + stored * (far_ - near_);
            case DepthKind::Device:
                return device(stored);
            default:
                return stored;
        }
    }

    // A perspective z-buffer is linear in 1/z: 1/z = (1 - d)/near + d/far. Exact for an infinite end as well.
    double device(double d) const {
        const double inverse = (1 - d) / near_ + d / far_;
        return inverse == 0 ? kInfinity : 1 / inverse;
    }

    // Cosine of the angle between the axis and the ray through the centre of pixel (x, y).
    double cosine(int x, int y) const {
        const double tan_x = (x + 0.5 - axis_x_) * tan_per_px_x_;
        const double tan_y = (y + 0.5 - axis_y_) * tan_per_px_y_;
        return 1 / std::sqrt(1 + tan_x * tan_x + tan_y * tan_y);
    }

    DepthKind kind_;
    bool ranged_;
    double scale_m_, near_ = 0, far_ = 1;
    double tan_per_px_x_ = 0, tan_per_px_y_ = 0, axis_x_ = 0, axis_y_ = 0;
};

// Counts of a row's values; rows are counted separately and then added, so threads cannot change the result.
struct Tally {
    std::size_t non_finite = 0, negative = 0, positive = 0, misses = 0;
    float nearest = kInfinity, farthest = 0;
    bool beyond_1 = false;

    void look_at(float stored, const Converter& to) {
        if (!std::isfinite(stored)) ++non_finite;
        if (to.is_miss(stored)) return;
        beyond_1 = beyond_1 || stored > 1;
        if (stored < 0) ++negative;
        if (stored > 0) ++positive;
    }
    void count(float depth_m) {
        if (std::isinf(depth_m)) {
            ++misses;
            return;
        }
        nearest = std::min(nearest, depth_m);
        farthest = std::max(farthest, depth_m);
    }
    void add(const Tally& o) {
        non_finite += o.non_finite, negative += o.negative, positive += o.positive, misses += o.misses;
        beyond_1 = beyond_1 || o.beyond_1;
        nearest = std::min(nearest, o.nearest), farthest = std::max(farthest, o.farthest);
    }
};

template <typename Body>  // body(y, tally)
Tally tally_rows(int rows, Workers& workers, const Body& body) {
    std::vector<Tally> of_row(std::size_t(std::max(rows, 0)));
    parallel_for(rows, workers, [&](int y) { body(y, of_row[std::size_t(y)]); });
    Tally sum;
    for (const Tally& t : of_row) sum.add(t);
    return sum;
}

// Planar metres of one stored value, +infinity for a miss. `sign` is -1 where the file counts downwards.
float converted(const Converter& to, float stored, float sign, int x, int y) {
    if (to.is_miss(stored) || sign * stored < 0) return kInfinity;
    const float depth_m = to.metres(double(sign) * double(stored), x, y);
    return depth_m > 0 ? depth_m : kInfinity;
}

DepthReport report_of(const Tally& before, const Tally& after, const DepthSettings& settings) {
    DepthReport report;
    report.non_finite = before.non_finite;
    report.misses = after.misses;
    const bool any = after.nearest <= after.farthest;
    report.nearest_m = any ? after.nearest : 0;
    report.farthest_finite_m = any ? after.farthest : 0;
    if (before.negative > 0)
        report.warnings.push_back(before.positive == 0
                                      ? "every depth is negative; the absolute values are used"
                                      : std::to_string(before.negative) +
                                            " negative depths count as infinitely far");
    if (before.beyond_1 && is_ranged(settings))
        report.warnings.emplace_back("depth has values above 1, beyond the ends of depth.range");
    if (!any) report.warnings.emplace_back("no pixel has a finite depth: everything is infinitely far");
    return report;
}

Status check_place(int width, int height, const Place& place) {
    const Rect& data = place.data_window;
    if (!place.fits(width, height))
        return Error{ErrorCode::InvalidArgument, "depth is " + std::to_string(width) + "x" +
                                                     std::to_string(height) + " but its data window is " +
                                                     std::to_string(data.width()) + "x" +
                                                     std::to_string(data.height())};
    return check(place);
}

}  // namespace

Result<DepthReport> depth_to_planar_metres(View<float> depth, const Place& place,
                                           const DepthSettings& settings) {
    if (Status s = check(settings); !s) return s.error();
    if (Status s = check_place(depth.width(), depth.height(), place); !s) return s.error();
    const Converter to(place, settings);
    const std::shared_ptr<Workers> workers = workers_of(settings.threads, settings.workers);
    const Tally before = tally_rows(depth.height(), *workers, [&](int y, Tally& tally) {
        for (int x = 0; x < depth.width(); ++x) tally.look_at(depth(x, y), to);
    });
    const float sign = before.negative > 0 && before.positive == 0 ? -1.f : 1.f;
    const Rect& data = place.data_window;
    const Tally after = tally_rows(depth.height(), *workers, [&](int y, Tally& tally) {
        for (int x = 0; x < depth.width(); ++x) {
            float& d = depth(x, y);
            d = converted(to, d, sign, data.x0 + x, data.y0 + y);
            tally.count(d);
        }
    });
    return report_of(before, after, settings);
}

Result<DepthReport> deep_to_planar_metres(DeepPicture& deep, const Place& place,
                                          const DepthSettings& settings) {
    if (Status s = check(settings); !s) return s.error();
    if (Status s = check_place(deep.width(), deep.height(), place); !s) return s.error();
    const Converter to(place, settings);
    const std::shared_ptr<Workers> workers = workers_of(settings.threads, settings.workers);
    const auto row = [&](int y) {
        const std::size_t first = std::size_t(y) * std::size_t(deep.width());
        const std::size_t from = deep.first()[first];
        return deep.samples().subspan(from, deep.first()[first + std::size_t(deep.width())] - from);
    };
    const Tally before = tally_rows(deep.height(), *workers, [&](int y, Tally& tally) {
        for (const DeepSample& s : row(y)) tally.look_at(s.depth, to);
    });
    const float sign = before.negative > 0 && before.positive == 0 ? -1.f : 1.f;
    const Rect& data = place.data_window;
    const bool reorder = to.reverses_order() || sign < 0;
    const Tally after = tally_rows(deep.height(), *workers, [&](int y, Tally& tally) {
        for (int x = 0; x < deep.width(); ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(deep.width()) + std::size_t(x);
            const auto pixel = deep.samples().subspan(deep.first()[i], deep.first()[i + 1] - deep.first()[i]);
            for (DeepSample& s : pixel) {
                const float a = converted(to, s.depth, sign, data.x0 + x, data.y0 + y);
                const float b = converted(to, s.depth_back, sign, data.x0 + x, data.y0 + y);
                s.depth = std::min(a, b), s.depth_back = std::max(a, b);
                tally.count(s.depth);
            }
            if (reorder)
                std::stable_sort(pixel.begin(), pixel.end(),
                                 [](const DeepSample& p, const DeepSample& q) { return p.depth < q.depth; });
        }
    });
    return report_of(before, after, settings);
}

}  // namespace petzval
