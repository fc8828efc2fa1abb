#include "petzval/seen_elsewhere.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace petzval {
namespace {

constexpr float kOneDepth = 1.02f;   // of one surface, seen from two places
constexpr float kOneSurface = 1.1f;  // from pixel to pixel
constexpr float kSilhouette = 1.3f;  // within 3 x 3 pixels
constexpr float kOpaque = 0.99f;
constexpr double kShareThatAgrees = 0.9;  // of a surface that stands still
constexpr double kShareThatFits = 0.5;    // of two pictures of the same things
constexpr std::uint64_t kNobody = std::numeric_limits<std::uint64_t>::max();

// Row vectors times matrices, as OpenEXR has them.
using Matrix = std::array<double, 16>;

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t k = 0; k < 4; ++k) c[4 * i + j] += a[4 * i + k] * b[4 * k + j];
    return c;
}

// Of a matrix that turns and moves (and may mirror and scale): its 3 x 3 part by Cramer's rule.
std::optional<Matrix> inverse(const Matrix& m) {
    const auto at = [&](std::size_t i, std::size_t j) { return m[4 * (i % 3) + j % 3]; };
    const auto minor = [&](std::size_t i, std::size_t j) {
        return at(i + 1, j + 1) * at(i + 2, j + 2) - at(i + 1, j + 2) * at(i + 2, j + 1);
    };
    const double determinant = at(0, 0) * minor(0, 0) + at(0, 1) * minor(0, 1) + at(0, 2) * minor(0, 2);
    if (!(std::abs(determinant) > 0) || !std::isfinite(determinant)) return std::nullopt;
    Matrix inverted{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) inverted[4 * i + j] = minor(j, i) / determinant;
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) inverted[12 + j] -= m[12 + k] * inverted[4 * k + j];
    inverted[15] = 1;
    return inverted;
}

// Which way a camera's x and z point.
struct Axes {
    double x = 1, z = 1;
};

// How a camera sees: pixels of the display window per tangent, and the middle of the picture.
struct Eye {
    Matrix camera_from_world;
    double across = 0, down = 0, middle_x = 0, middle_y = 0, unit_m = 1;
};

Result<Eye> eye_of(const Shot& shot) {
    const auto lacks = [&](const char* what) {
        return Error{ErrorCode::InvalidArgument, shot.path + ": " + what};
    };
    if (!std::holds_alternative<DepthMetres>(shot.depth)) return lacks("no depth in metres");
    const FoundCamera& found = shot.camera;
    if (!found.camera_from_world) return lacks("no worldToCamera");
    if (!found.focal_length_mm || !found.sensor_width_mm) return lacks("no focal length or no sensor width");
    Eye eye{.camera_from_world = *found.camera_from_world, .unit_m = shot.unit_scale_m};
    const Rect& window = shot.place.display_window;
    eye.across = window.width() * found.focal_length_mm->value / found.sensor_width_mm->value;
    if (shot.image_scale == ImageScale::ThinLens && found.focus_distance_m)
        eye.across /= 1 - found.focal_length_mm->value / (1000 * found.focus_distance_m->value);
    eye.down = eye.across * shot.place.pixel_aspect;
    eye.middle_x = window.x0 + 0.5 * window.width(), eye.middle_y = window.y0 + 0.5 * window.height();
    return eye;
}

// Where a pixel of one picture lies in another.
struct Landing {
    float x = 0, y = 0, depth_m = 0;  // in pixels of the data window; depth_m <= 0: behind the camera
};

class Way {
public:
    Way(const Shot& from, const Eye& from_eye, const Shot& to, const Eye& to_eye, const Matrix& turn,
        Axes axes)
        : from_(from_eye),
          to_(to_eye),
          turn_(turn),
          axes_(axes),
          from_window_(from.place.data_window),
          to_window_(to.place.data_window) {}

    Landing operator()(int x, int y, float depth_m) const {
        // A miss lies in a direction: it turns with the camera and does not move.
        const bool far = std::isinf(depth_m);
        const double z = far ? 1 : double(depth_m);
        const double px = axes_.x * (from_window_.x0 + x + 0.5 - from_.middle_x) / from_.across * z;
        const double py = -(from_window_.y0 + y + 0.5 - from_.middle_y) / from_.down * z;
        const double pz = axes_.z * z, unit = far ? 0 : from_.unit_m;
        const auto column = [&](std::size_t k) {
            return px * turn_[k] + py * turn_[4 + k] + pz * turn_[8 + k] + unit * turn_[12 + k];
        };
        const double depth = axes_.z * column(2);
        if (!(depth > 0)) return {};
        return {float(to_.middle_x + axes_.x * column(0) / depth * to_.across - to_window_.x0),
                float(to_.middle_y - column(1) / depth * to_.down - to_window_.y0),
                far ? std::numeric_limits<float>::infinity() : float(depth)};
    }

private:
    const Eye &from_, &to_;
    Matrix turn_;
    Axes axes_;
    Rect from_window_, to_window_;
};

// Between which depths a pixel's own surface lies: inside a surface those around it, at a silhouette its own.
struct Bounds {
    Plane nearest, farthest;
};

template <typename Body>
void for_rows(int rows, Workers& workers, const Body& body) {
    constexpr int kRows = 16;
    parallel_for((rows + kRows - 1) / kRows, workers, [&](int block) {
        for (int y = block * kRows; y < std::min(rows, (block + 1) * kRows); ++y) body(y);
    });
}

Bounds bounds_of(View<const float> depth, Workers& workers) {
    Bounds bounds{Plane(depth.width(), depth.height()), Plane(depth.width(), depth.height())};
    for_rows(depth.height(), workers, [&](int y) {
        for (int x = 0; x < depth.width(); ++x) {
            float nearest = depth(x, y), farthest = nearest;
            for (int v = std::max(0, y - 1); v <= std::min(depth.height() - 1, y + 1); ++v)
                for (int u = std::max(0, x - 1); u <= std::min(depth.width() - 1, x + 1); ++u)
                    nearest = std::min(nearest, depth(u, v)), farthest = std::max(farthest, depth(u, v));
            if (!(farthest <= kSilhouette * nearest)) nearest = farthest = depth(x, y);
            bounds.nearest(x, y) = nearest / kOneDepth, bounds.farthest(x, y) = farthest * kOneDepth;
        }
    });
    return bounds;
}

enum class Verdict : std::uint8_t { Unknown, Agrees, InFront, Hidden };

Verdict verdict_of(const Landing& at, const Bounds& bounds) {
    if (!(at.depth_m > 0)) return Verdict::Unknown;
    const float u = std::floor(at.x), v = std::floor(at.y);
    if (!(u >= 0 && v >= 0 && u < float(bounds.nearest.width()) && v < float(bounds.nearest.height())))
        return Verdict::Unknown;
    const int x = int(u), y = int(v);
    if (at.depth_m > bounds.farthest(x, y)) return Verdict::Hidden;
    if (at.depth_m >= bounds.nearest(x, y)) return Verdict::Agrees;
    // Beside a silhouette half a pixel decides.
    for (int j = std::max(0, y - 1); j <= std::min(bounds.nearest.height() - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(bounds.nearest.width() - 1, x + 1); ++i)
            if (at.depth_m >= bounds.nearest(i, j)) return Verdict::Unknown;
    return Verdict::InFront;
}

// Surfaces of a picture: pixels that touch and lie at one depth, by union and find.
class Surfaces {
public:
    explicit Surfaces(const Shot& shot)
        : depth_(shot.depth_plane()), usable_(depth_.width(), depth_.height()) {
        for (int y = 0; y < depth_.height(); ++y)
            for (int x = 0; x < depth_.width(); ++x) usable_(x, y) = is_usable(shot, x, y);
        parent_.resize(usable_.size());
        std::iota(parent_.begin(), parent_.end(), 0u);
        for (int y = 0; y < depth_.height(); ++y)
            for (int x = 0; x < depth_.width(); ++x) {
                if (x > 0 && touch(x, y, x - 1, y)) join(index(x, y), index(x - 1, y));
                if (y > 0 && touch(x, y, x, y - 1)) join(index(x, y), index(x, y - 1));
            }
    }

    bool usable(int x, int y) const { return usable_(x, y) != 0; }
    std::uint32_t of(int x, int y) { return root(index(x, y)); }
    // Whether the square to the right and below of a pixel lies on one surface.
    bool is_whole(int x, int y) const {
        return touch(x, y, x + 1, y) && touch(x, y, x, y + 1) && touch(x + 1, y + 1, x + 1, y) &&
               touch(x + 1, y + 1, x, y + 1);
    }

private:
    // Opaque, and not beside what is nearer, whose light it would hold a part of.
    bool is_usable(const Shot& shot, int x, int y) const {
        const float own = depth_(x, y);
        if (!(own > 0) || shot.colour(x, y).a < kOpaque) return false;
        for (int v = std::max(0, y - 1); v <= std::min(depth_.height() - 1, y + 1); ++v)
            for (int u = std::max(0, x - 1); u <= std::min(depth_.width() - 1, x + 1); ++u)
                if (own > kSilhouette * depth_(u, v)) return false;
        return true;
    }
    bool touch(int x, int y, int u, int v) const {
        const float a = depth_(x, y), b = depth_(u, v);
        return usable(x, y) && usable(u, v) && (a == b || std::max(a, b) <= kOneSurface * std::min(a, b));
    }
    std::uint32_t index(int x, int y) const {
        return std::uint32_t(y) * std::uint32_t(depth_.width()) + std::uint32_t(x);
    }
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a), b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

    View<const float> depth_;
    Image<std::uint8_t> usable_;
    std::vector<std::uint32_t> parent_;
};

// The square of four pixels at x, y of another picture, where it lands.
struct Square {
    std::array<Landing, 4> corners;  // top left, top right, bottom left, bottom right
};

// Shares of the four corners at a point of the square; empty outside of it. Its two triangles share the
// diagonal from top right to bottom left.
std::optional<std::array<float, 4>> shares_at(const Square& s, float x, float y) {
    for (const auto& [a, b, c] : {std::array<std::size_t, 3>{0, 1, 2}, {3, 2, 1}}) {
        const Landing &p = s.corners[a], &q = s.corners[b], &r = s.corners[c];
        const float area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        if (area == 0) continue;
        const float of_b = ((x - p.x) * (r.y - p.y) - (y - p.y) * (r.x - p.x)) / area;
        const float of_c = ((q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x)) / area;
        if (of_b < 0 || of_c < 0 || of_b + of_c > 1) continue;
        std::array<float, 4> shares{};
        shares[a] = 1 - of_b - of_c, shares[b] = of_b, shares[c] = of_c;
        return shares;
    }
    return std::nullopt;
}

float depth_at(const Square& s, const std::array<float, 4>& shares) {
    float nearness = 0;  // 1/depth is what lies on a plane
    for (std::size_t i = 0; i < 4; ++i) nearness += shares[i] / s.corners[i].depth_m;
    return nearness > 0 ? 1 / nearness : std::numeric_limits<float>::infinity();
}

// One other picture on its way to where the shot sees it.
class Other {
public:
    Other(const Shot& other, const Way& way, const Bounds& bounds, Workers& workers)
        : other_(other),
          depth_(other.depth_plane()),
          way_(way),
          bounds_(bounds),
          workers_(workers),
          surfaces_(other),
          verdicts_(depth_.width(), depth_.height()) {
        for_rows(depth_.height(), workers_, [&](int y) {
            for (int x = 0; x < depth_.width(); ++x)
                if (surfaces_.usable(x, y)) verdicts_(x, y) = verdict_of(landing(x, y), bounds_);
        });
        find_what_stands();
    }

    // The nearest of what is hidden, for pixels that know nothing yet.
    void add_to(std::vector<DeepSample>& known) const {
        std::vector<std::uint64_t> nearest(known.size(), kNobody);
        for_rows(depth_.height() - 1, workers_, [&](int y) {
            for (int x = 0; x + 1 < depth_.width(); ++x)
                if (shows_hidden(x, y)) draw(x, y, known, nearest);
        });
        for_rows(height(), workers_, [&](int y) {
            for (int x = 0; x < width(); ++x) {
                const std::size_t i = std::size_t(y) * std::size_t(width()) + std::size_t(x);
                if (nearest[i] != kNobody) known[i] = sample(std::uint32_t(nearest[i]), x, y);
            }
        });
    }

private:
    int width() const { return bounds_.nearest.width(); }
    int height() const { return bounds_.nearest.height(); }
    Landing landing(int x, int y) const { return way_(x, y, depth_(x, y)); }
    Square square(int x, int y) const {
        return {{landing(x, y), landing(x + 1, y), landing(x, y + 1), landing(x + 1, y + 1)}};
    }

    void find_what_stands() {
        std::vector<std::array<std::uint32_t, 2>> counts(verdicts_.size());  // agrees, in front
        stands_ = Image<std::uint8_t>(depth_.width(), depth_.height());
        for (int y = 0; y < depth_.height(); ++y)
            for (int x = 0; x < depth_.width(); ++x) {
                if (verdicts_(x, y) == Verdict::Agrees) ++counts[surfaces_.of(x, y)][0];
                if (verdicts_(x, y) == Verdict::InFront) ++counts[surfaces_.of(x, y)][1];
            }
        for (int y = 0; y < depth_.height(); ++y)
            for (int x = 0; x < depth_.width(); ++x) {
                const auto& [agree, in_front] = counts[surfaces_.of(x, y)];
                stands_(x, y) = double(agree) >= kShareThatAgrees * double(agree + in_front);
            }
    }

    bool shows_hidden(int x, int y) const {
        if (!stands_(x, y) || !surfaces_.is_whole(x, y)) return false;
        for (const int v : {y, y + 1})
            for (const int u : {x, x + 1})
                if (verdicts_(u, v) == Verdict::Hidden) return true;
        return false;
    }

    void draw(int x, int y, const std::vector<DeepSample>& known, std::vector<std::uint64_t>& nearest) const {
        constexpr float kLargestSquarePx = 8;
        const Square s = square(x, y);
        float x0 = s.corners[0].x, x1 = x0, y0 = s.corners[0].y, y1 = y0;
        for (const Landing& c : s.corners) {
            if (!(c.depth_m > 0)) return;
            x0 = std::min(x0, c.x), x1 = std::max(x1, c.x), y0 = std::min(y0, c.y), y1 = std::max(y1, c.y);
        }
        if (!(x1 - x0 < kLargestSquarePx && y1 - y0 < kLargestSquarePx)) return;
        for (int v = std::max(0, int(std::ceil(y0 - 0.5f))); v < height() && float(v) + 0.5f <= y1; ++v)
            for (int u = std::max(0, int(std::ceil(x0 - 0.5f))); u < width() && float(u) + 0.5f <= x1; ++u) {
                const std::size_t i = std::size_t(v) * std::size_t(width()) + std::size_t(u);
                if (known[i].colour.a > 0) continue;
                const auto shares = shares_at(s, float(u) + 0.5f, float(v) + 0.5f);
                if (!shares) continue;
                if (const float depth = depth_at(s, *shares); depth > bounds_.farthest(u, v))
                    offer(nearest[i], depth, x, y);
            }
    }

    // The nearest wins, of equals the first: in whatever order they come.
    void offer(std::uint64_t& place, float depth, int x, int y) const {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &depth, sizeof bits);  // of positive floats the larger has the larger bits
        const std::uint64_t own =
            std::uint64_t(bits) << 32 | (std::uint32_t(y) * std::uint32_t(depth_.width()) + std::uint32_t(x));
        std::atomic_ref<std::uint64_t> shared(place);
        std::uint64_t there = shared.load(std::memory_order_relaxed);
        while (own < there && !shared.compare_exchange_weak(there, own, std::memory_order_relaxed)) {
        }
    }

    DeepSample sample(std::uint32_t of, int u, int v) const {
        const int x = int(of % std::uint32_t(depth_.width())), y = int(of / std::uint32_t(depth_.width()));
        const Square s = square(x, y);
        const auto shares = shares_at(s, float(u) + 0.5f, float(v) + 0.5f);
        const float depth = depth_at(s, *shares);
        Rgba colour;
        for (std::size_t i = 0; i < 4; ++i)
            colour += (*shares)[i] * other_.colour(x + int(i % 2), y + int(i / 2));
        colour.a = 1;
        return {colour, depth, depth};
    }

    const Shot& other_;
    View<const float> depth_;
    const Way& way_;
    const Bounds& bounds_;
    Workers& workers_;
    Surfaces surfaces_;
    Image<Verdict> verdicts_;
    Image<std::uint8_t> stands_;
};

// The share of some pixels of `other` that land on the shot's own surface.
double fit_of(const Shot& other, const Way& way, const Bounds& bounds) {
    constexpr int kStep = 7;
    const View<const float> depth = other.depth_plane();
    int agree = 0, all = 0;
    for (int y = kStep / 2; y < depth.height(); y += kStep)
        for (int x = kStep / 2; x < depth.width(); x += kStep) {
            const Verdict verdict = verdict_of(way(x, y, depth(x, y)), bounds);
            if (verdict == Verdict::Unknown || std::isinf(depth(x, y))) continue;
            ++all, agree += verdict == Verdict::Agrees;
        }
    return all > 0 ? double(agree) / all : 0;
}

}  // namespace

Result<SeenElsewhere> seen_elsewhere(const Shot& shot, std::span<const Shot* const> others,
                                     Workers& workers) {
    const auto eye = eye_of(shot);
    if (!eye) return eye.error();
    const View<const float> depth = shot.depth_plane();
    const Bounds bounds = bounds_of(depth, workers);
    std::vector<DeepSample> known(std::size_t(depth.width()) * std::size_t(depth.height()));
    SeenElsewhere found;
    for (const Shot* other : others) {
        const auto theirs = eye_of(*other);
        if (!theirs) {
            found.left_out.push_back(theirs.error().message);
            continue;
        }
        const auto world_from_theirs = inverse(theirs->camera_from_world);
        if (!world_from_theirs) {
            found.left_out.push_back(other->path + ": its worldToCamera has no inverse");
            continue;
        }
        const Matrix turn = product(*world_from_theirs, eye->camera_from_world);
        Axes best;
        double fit = -1;
        for (const Axes axes : {Axes{1, 1}, Axes{1, -1}, Axes{-1, 1}, Axes{-1, -1}})
            if (const double share = fit_of(*other, Way(*other, *theirs, shot, *eye, turn, axes), bounds);
                share > fit)
                fit = share, best = axes;
        if (fit < kShareThatFits) {
            found.left_out.push_back(other->path +
                                     ": by its camera and depth it does not show the same things");
            continue;
        }
        const Way way(*other, *theirs, shot, *eye, turn, best);
        Other(*other, way, bounds, workers).add_to(known);
    }
    for (const DeepSample& s : known) found.pixels += s.colour.a > 0;
    if (found.pixels > 0)
        found.behind = DeepPicture::made_of(depth.width(), depth.height(), [&](int x, int y, auto& samples) {
            const DeepSample& s = known[std::size_t(y) * std::size_t(depth.width()) + std::size_t(x)];
            if (s.colour.a > 0) samples.push_back(s);
        });
    return found;
}

std::vector<SeenElsewhere> seen_by_each_other(std::span<const Shot* const> views, Workers& workers) {
    std::vector<SeenElsewhere> all(views.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
        if (!views[i]->deep.empty() || !views[i]->behind.empty()) continue;
        std::vector<const Shot*> others;
        for (const Shot* other : views)
            if (other->deep.empty() && other->camera.camera_from_world != views[i]->camera.camera_from_world)
                others.push_back(other);
        if (others.empty()) continue;
        if (auto seen = seen_elsewhere(*views[i], others, workers)) all[i] = std::move(*seen);
    }
    return all;
}

}  // namespace petzval
