#include "kernel/draw/transmission.h"

#include "kernel/model/random.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

namespace petzval::kernel {
namespace {

constexpr int kSide = 768;  // pixels of a drawn texture: 1/384 of the pupil's radius
constexpr double kTurn = 2 * std::numbers::pi;

// Place on the unit disc of a pixel's centre along one axis.
double place(int pixel) { return (pixel + 0.5) * 2 / kSide - 1; }

// Draws from one seed, one after the other.
class Draw {
public:
    Draw(std::uint64_t seed, std::uint64_t what) : seed_(seed * 16 + what) {}
    double operator()() { return unit_random(seed_, next_++); }
    double between(double low, double high) { return low + (high - low) * (*this)(); }

private:
    std::uint64_t seed_, next_ = 0;
};

// Multiplies by 1 - opacity, soft over the last third of the radius.
void add_speck(Plane& plane, Point middle, double radius, double opacity) {
    const auto pixel = [](double at) { return std::clamp(int((at + 1) * 0.5 * kSide), 0, kSide - 1); };
    for (int y = pixel(middle.y - radius); y <= pixel(middle.y + radius); ++y)
        for (int x = pixel(middle.x - radius); x <= pixel(middle.x + radius); ++x) {
            const double r = std::hypot(place(x) - middle.x, place(y) - middle.y) / radius;
            const double inside = std::clamp(3 * (1 - r), 0.0, 1.0);
            plane(x, y) *= float(1 - opacity * inside * inside * (3 - 2 * inside));
        }
}

void add_dust(Plane& plane, double strength, std::uint64_t seed) {
    Draw draw(seed, 1);
    const int count = int(std::lround(160 * strength));
    for (int i = 0; i < count; ++i) {
        const double angle = kTurn * draw(), from_middle = std::sqrt(draw());
        // Sizes over a decade, small ones most: a power law.
        const double radius = 0.006 * std::pow(10, std::pow(draw(), 3));
        add_speck(plane, from_middle * Point{std::cos(angle), std::sin(angle)}, radius,
                  draw.between(0.25, 0.85));
    }
}

void add_scratches(Plane& plane, double strength, std::uint64_t seed) {
    Draw draw(seed, 2);
    const int count = int(std::lround(24 * strength));
    for (int i = 0; i < count; ++i) {
        const double where = kTurn * draw(), from_middle = std::sqrt(draw());
        Point at = from_middle * Point{std::cos(where), std::sin(where)};
        double heading = kTurn * draw();
        const double turn = draw.between(-1.5, 1.5), length = draw.between(0.15, 1.1);
        const double width = draw.between(0.003, 0.007), opacity = draw.between(0.15, 0.6);
        Plane line(kSide, kSide, 1.0f);
        const double step = 0.5 * width;
        for (double along = 0; along < length; along += step) {
            // Thin at both ends.
            const double share = std::sin(std::numbers::pi * along / length);
            add_speck(line, at, width * (0.4 + share), 1);
            at = at + step * Point{std::cos(heading), std::sin(heading)};
            heading += turn * step;
        }
        for (std::size_t k = 0; k < plane.size(); ++k)
            plane.pixels()[k] *= 1 - float(opacity) * (1 - line.pixels()[k]);
    }
}

void add_onion_rings(Plane& plane, double strength, std::uint64_t seed) {
    // Waves of a few close periods beat: rings of uneven distance and depth.
    Draw draw(seed, 3);
    struct Wave {
        double rings, phase, depth;
    };
    std::vector<Wave> waves;
    double whole = 0;
    for (int i = 0; i < 5; ++i) {
        waves.push_back({draw.between(9, 26), kTurn * draw(), draw.between(0.4, 1)});
        whole += waves.back().depth;
    }
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const double r = std::hypot(place(x), place(y));
            double sum = 0;
            for (const Wave& w : waves) sum += w.depth * std::sin(kTurn * w.rings * r + w.phase);
            plane(x, y) *= float(1 - 0.5 * strength * (0.5 + 0.5 * sum / whole));
        }
}

}  // namespace

PupilImage::PupilImage(View<const float> values)
    : width_(values.width()),
      height_(values.height()),
      sums_(std::size_t(width_ + 1) * std::size_t(height_ + 1), 0.0) {
    const std::size_t stride = std::size_t(width_) + 1;
    for (int y = 0; y < height_; ++y) {
        double row = 0;
        for (int x = 0; x < width_; ++x) {
            const double value = double(values(x, y));
            if (std::isfinite(value) && value > 0) row += value;
            const std::size_t at = std::size_t(y + 1) * stride + std::size_t(x) + 1;
            sums_[at] = sums_[at - stride] + row;
        }
    }
}

// x, y in pixels.
double PupilImage::sum_up_to(double x, double y) const {
    x = std::clamp(x, 0.0, double(width_)), y = std::clamp(y, 0.0, double(height_));
    const int i = std::min(int(x), width_ - 1), j = std::min(int(y), height_ - 1);
    const double u = x - i, v = y - j;
    const std::size_t stride = std::size_t(width_) + 1, at = std::size_t(j) * stride + std::size_t(i);
    return (1 - v) * ((1 - u) * sums_[at] + u * sums_[at + 1]) +
           v * ((1 - u) * sums_[at + stride] + u * sums_[at + stride + 1]);
}

double PupilImage::mean(Point middle, double half_width, double half_height) const {
    const double x = (middle.x + 1) * 0.5 * width_, y = (middle.y + 1) * 0.5 * height_;
    const double w = half_width * 0.5 * width_, h = half_height * 0.5 * height_;
    const double sum =
        sum_up_to(x + w, y + h) - sum_up_to(x - w, y + h) - sum_up_to(x + w, y - h) + sum_up_to(x - w, y - h);
    return std::max(0.0, sum / (4 * w * h));
}

double PupilImage::mean_inside(Point middle, double half_width, double half_height) const {
    const auto overlap = [](double at, double half) {
        return std::min(1.0, at + half) - std::max(-1.0, at - half);
    };
    const double width = overlap(middle.x, half_width), height = overlap(middle.y, half_height);
    if (width <= 0 || height <= 0) return 1;
    return mean(middle, half_width, half_height) * 4 * half_width * half_height / (width * height);
}

bool has_texture(const PupilTexture& t) {
    return t.image || t.dust > 0 || t.scratches > 0 || t.onion_rings > 0;
}

Plane drawn_texture(const PupilTexture& texture) {
    Plane plane(kSide, kSide, 1.0f);
    if (texture.dust > 0) add_dust(plane, texture.dust, texture.seed);
    if (texture.scratches > 0) add_scratches(plane, texture.scratches, texture.seed);
    if (texture.onion_rings > 0) add_onion_rings(plane, texture.onion_rings, texture.seed);
    if (!texture.image) return plane;
    const PupilImage image(*texture.image);
    const double half = 1.0 / kSide;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            plane(x, y) *= float(std::min(1.0, image.mean_inside({place(x), place(y)}, half, half)));
    return plane;
}

std::shared_ptr<const PupilImage> shared_texture(const PupilTexture& texture) {
    struct Drawn {
        PupilTexture texture;
        PupilImage image;
    };
    static std::mutex mutex;
    static std::weak_ptr<const Drawn> latest;
    const std::lock_guard lock(mutex);
    auto drawn = latest.lock();
    if (!drawn || !(drawn->texture == texture)) {
        drawn = std::make_shared<const Drawn>(Drawn{texture, PupilImage(drawn_texture(texture))});
        latest = drawn;
    }
    return {drawn, &drawn->image};
}

}  // namespace petzval::kernel
