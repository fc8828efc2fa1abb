#include "shot/landing.h"

#include "shot/following.h"
#include "shot/optical_flow.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace petzval::shot {
namespace {

constexpr double kShareThatFits = 0.5;  // of two pictures of the same things
// Vectors by which so much less looks the same than by cameras are not what they are taken for.
constexpr double kWorseByMotion = 0.05;
// If little stands still, this share must look the same by vectors: neighbouring frames of tumbling objects
// see surfaces that are covered now, and may not know the covering ones.
constexpr double kShareThatIsFollowed = 0.7;

Error cannot(const Shot& shot, const std::string& what) {
    return {ErrorCode::InvalidArgument, shot.path + ": " + what};
}

// Row vectors times matrices, as OpenEXR has them.
using Matrix = std::array<double, 16>;

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix c{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t k = 0; k < 4; ++k) c[4 * i + j] += a[4 * i + k] * b[4 * k + j];
    return c;
}

// Inverse of a matrix that rotates and moves (and may mirror and scale): its 3 x 3 part by Cramer's rule.
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

// Directions of a camera's x and z.
struct Axes {
    double x = 1, z = 1;
};

// Projection of a camera: pixels of the display window per tangent, and the middle of the picture.
struct Eye {
    Matrix camera_from_world;
    double across = 0, down = 0, middle_x = 0, middle_y = 0, unit_m = 1;
};

Result<Eye> eye_of(const Shot& shot) {
    if (Status fine = check_depth(shot); !fine) return fine.error();
    const FoundCamera& found = shot.camera;
    if (!found.camera_from_world) return cannot(shot, "no worldToCamera");
    if (!found.focal_length_mm || !found.sensor_width_mm)
        return cannot(shot, "no focal length or no sensor width");
    Eye eye{.camera_from_world = *found.camera_from_world, .unit_m = shot.unit_scale_m};
    const Rect& window = shot.place.display_window;
    eye.across = window.width() * found.focal_length_mm->value / found.sensor_width_mm->value;
    if (shot.image_scale == ImageScale::ThinLens && found.focus_distance_m)
        eye.across /= 1 - found.focal_length_mm->value / (1000 * found.focus_distance_m->value);
    eye.down = eye.across * shot.place.pixel_aspect;
    eye.middle_x = window.x0 + 0.5 * window.width(), eye.middle_y = window.y0 + 0.5 * window.height();
    return eye;
}

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
    Eye from_, to_;
    Matrix turn_;
    Axes axes_;
    Rect from_window_, to_window_;
};

// The share of some pixels of `other` that land on the shot's own surface.
template <typename Land>
double fit_of(const Shot& other, const Land& land, const Bounds& bounds) {
    constexpr int kStep = 7;
    const View<const float> depth = other.depth_plane();
    int agree = 0, all = 0;
    for (int y = kStep / 2; y < depth.height(); y += kStep)
        for (int x = kStep / 2; x < depth.width(); x += kStep) {
            const Verdict verdict = verdict_of(land(x, y), bounds);
            if (verdict == Verdict::Unknown || std::isinf(depth(x, y))) continue;
            ++all, agree += verdict == Verdict::Agrees;
        }
    return all > 0 ? double(agree) / all : 0;
}

// A way by cameras, and how much of the picture fits by it.
struct CameraWay {
    Way way;
    double fit = 0;
};

Result<CameraWay> way_by_cameras(const Shot& other, const Shot& shot, const Bounds& bounds) {
    const auto eye = eye_of(shot), theirs = eye_of(other);
    if (!eye || !theirs) return !eye ? eye.error() : theirs.error();
    const auto world_from_theirs = inverse(theirs->camera_from_world);
    if (!world_from_theirs) return cannot(other, "its worldToCamera has no inverse");
    const Matrix turn = product(*world_from_theirs, eye->camera_from_world);
    std::optional<CameraWay> best;
    for (const Axes axes : {Axes{1, 1}, Axes{1, -1}, Axes{-1, 1}, Axes{-1, -1}}) {
        const Way way(other, *theirs, shot, *eye, turn, axes);
        const View<const float> depth = other.depth_plane();
        const double fit = fit_of(
            other, [&](int x, int y) { return way(x, y, depth(x, y)); }, bounds);
        if (!best || fit > best->fit) best.emplace(CameraWay{way, fit});
    }
    return *best;
}

Image<Landing> all_by_cameras(const Shot& other, const Way& way, Workers& workers) {
    const View<const float> depth = other.depth_plane();
    auto landings = Image<Landing>::uninitialised(depth.width(), depth.height());
    for_rows(depth.height(), workers, [&](int y) {
        for (int x = 0; x < depth.width(); ++x) landings(x, y) = way(x, y, depth(x, y));
    });
    return landings;
}

// Depth changes as the cameras say, where they say anything.
Image<Landing> all_by_motion(const OtherPicture& other, std::span<const OtherPicture> all, const Shot& shot,
                             const Way* way, Workers& workers) {
    const View<const float> depth = other.shot->depth_plane();
    const Steps steps = steps_of(other, all);
    auto landings = Image<Landing>::uninitialised(depth.width(), depth.height());
    for_rows(depth.height(), workers, [&](int y) {
        for (int x = 0; x < depth.width(); ++x) {
            Landing& at = landings(x, y);
            const Landing by_camera = way ? (*way)(x, y, depth(x, y)) : Landing{};
            at = carried(steps, x, y, shot.place.data_window);
            if (way && (!(at.depth_m > 0) || std::isinf(at.depth_m))) at = by_camera;
            if (way && at.depth_m > 0 && by_camera.depth_m > 0) at.depth_m = by_camera.depth_m;
        }
    });
    return landings;
}

// Without motion vectors: each pixel stays where it is, or moves as the pictures and their depths say.
Image<Landing> all_by_estimate(const OtherPicture& other, const Shot& shot, Workers& workers) {
    const Shot& theirs = *other.shot;
    const View<const float> depth = theirs.depth_plane();
    const Rect &from = theirs.place.data_window, &to = shot.place.data_window;
    Image<PixelMove> moves(depth.width(), depth.height());
    if (other.motion_from == MotionReading::From::Flow)
        moves = optical_flow({theirs.colour, depth, from}, {shot.colour, shot.depth_plane(), to}, workers);
    auto landings = Image<Landing>::uninitialised(depth.width(), depth.height());
    for_rows(depth.height(), workers, [&](int y) {
        for (int x = 0; x < depth.width(); ++x) {
            const PixelMove& move = moves(x, y);
            landings(x, y) = std::isnan(move.x)
                                 ? Landing{}
                                 : Landing{float(from.x0 + x - to.x0) + 0.5f + move.x,
                                           float(from.y0 + y - to.y0) + 0.5f + move.y, depth(x, y)};
        }
    });
    return landings;
}

// The share of some pixels of `other` that look as the shot does where they land.
double likeness(const Shot& other, const Shot& shot, const Image<Landing>& landings) {
    constexpr int kStep = 3;
    const View<const float> theirs = other.depth_plane();
    int alike = 0, all = 0;
    for (int y = kStep / 2; y < theirs.height(); y += kStep)
        for (int x = kStep / 2; x < theirs.width(); x += kStep) {
            const Landing& at = landings(x, y);
            if (std::isinf(theirs(x, y)) || !lands_within(at, shot.depth_plane())) continue;
            ++all;
            alike += lands_alike(other, x, y, shot, at);
        }
    return all > 0 ? double(alike) / all : 0;
}

// In a message: how a picture's motion is known.
std::string name_of(const OtherPicture& other) {
    if (!other.shot->motion.empty()) return "by its motion vectors";
    return other.motion_from == MotionReading::From::Still ? "with a still camera" : "by optical flow";
}

}  // namespace

std::string percent(double share) { return std::to_string(int(std::lround(100 * share))) + " %"; }

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

Verdict verdict_of(const Landing& at, const Bounds& bounds) {
    if (!(at.depth_m > 0)) return Verdict::Unknown;
    const float u = std::floor(at.x), v = std::floor(at.y);
    if (!(u >= 0 && v >= 0 && u < float(bounds.nearest.width()) && v < float(bounds.nearest.height())))
        return Verdict::Unknown;
    const int x = int(u), y = int(v);
    if (at.depth_m > kSilhouette * bounds.farthest(x, y)) return Verdict::Hidden;
    if (at.depth_m > bounds.farthest(x, y)) return Verdict::JustBehind;
    if (at.depth_m >= bounds.nearest(x, y)) return Verdict::Agrees;
    // Beside a silhouette half a pixel decides.
    for (int j = std::max(0, y - 1); j <= std::min(bounds.nearest.height() - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(bounds.nearest.width() - 1, x + 1); ++i)
            if (at.depth_m >= bounds.nearest(i, j)) return Verdict::Unknown;
    return Verdict::InFront;
}

bool look_alike(const Shot& other, int x, int y, const Shot& shot, const Landing& at) {
    constexpr float kLikeness = 0.1f, kDark = 0.01f;
    const Rgba a = other.colour(x, y), b = shot.colour(int(at.x), int(at.y));
    const auto near = [&](float p, float q) {
        return std::abs(p - q) <= kLikeness * std::max(std::abs(p), std::abs(q)) + kDark;
    };
    return near(a.r, b.r) && near(a.g, b.g) && near(a.b, b.b);
}

bool lands_alike(const Shot& other, int x, int y, const Shot& shot, const Landing& at) {
    const float depth = shot.depth_plane()(int(at.x), int(at.y));
    return std::max(depth, at.depth_m) <= kSilhouette * std::min(depth, at.depth_m) &&
           look_alike(other, x, y, shot, at);
}

bool lands_within(const Landing& at, View<const float> depth) {
    const float u = std::floor(at.x), v = std::floor(at.y);
    return at.depth_m > 0 && u >= 0 && v >= 0 && u < float(depth.width()) && v < float(depth.height());
}

Status check_depth(const Shot& shot) {
    if (!std::holds_alternative<DepthMetres>(shot.depth)) return cannot(shot, "no depth in metres");
    return Done{};
}

Status check_eye(const Shot& shot) {
    const auto eye = eye_of(shot);
    return eye ? Status(Done{}) : Status(eye.error());
}

Result<Landings> landings_of(const OtherPicture& other, std::span<const OtherPicture> all, const Shot& shot,
                             const Bounds& bounds, Workers& workers) {
    const Shot& theirs = *other.shot;
    if (Status fine = check_depth(theirs); !fine) return fine.error();
    const auto by_cameras = way_by_cameras(theirs, shot, bounds);
    const bool has_camera = by_cameras && by_cameras->fit >= kShareThatFits;
    Landings landings;
    if (has_camera) landings.of_pixels = all_by_cameras(theirs, by_cameras->way, workers);
    const double standing = has_camera ? likeness(theirs, shot, landings.of_pixels) : 0;
    const bool has_vectors = !theirs.motion.empty();
    if (other.frames_later != 0 && (has_vectors || other.motion_from != MotionReading::From::File)) {
        auto moved = has_vectors
                         ? all_by_motion(other, all, shot, has_camera ? &by_cameras->way : nullptr, workers)
                         : all_by_estimate(other, shot, workers);
        const double alike = likeness(theirs, shot, moved);
        landings.by_motion = alike >= standing - kWorseByMotion &&
                             (standing >= kShareThatFits || alike >= kShareThatIsFollowed);
        if (landings.by_motion) {
            landings.of_pixels = std::move(moved);
            if (has_vectors) landings.warning = note_of_signs(other, all, shot);
            return landings;
        }
        landings.warning =
            theirs.path + ": " + name_of(other) + ' ' + percent(alike) + " of the picture look the same" +
            (has_camera ? ", by its camera " + percent(standing) : "") +
            (has_vectors ? ": the vectors are not used; too much moves, or read.motion.scale is wrong"
                         : ": too much moves, so the estimated motion is not used");
        if (standing < kShareThatFits) return Error{ErrorCode::InvalidArgument, landings.warning};
    }
    if (!by_cameras) return by_cameras.error();
    if (!has_camera) return cannot(theirs, "its camera and depth show other surfaces than this frame");
    if (standing < kShareThatFits)
        return cannot(theirs, "most of it moves or looks different: by its camera " + percent(standing) +
                                  " of the picture look the same");
    return landings;
}

}  // namespace petzval::shot
