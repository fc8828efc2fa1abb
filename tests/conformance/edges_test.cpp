// Silhouettes against the answer that can be worked out: a disc of one radius, through the pupil of an ideal
// lens.
#include "shots.h"

#include <array>

namespace petzval::conformance {
namespace {

struct Disc {
    int width, height;
    double x, y, radius;

    // Share of pixel (u, v) that the disc covers; `filtered`: else all or nothing, by the pixel's centre.
    float coverage(int u, int v, bool filtered) const {
        const int n = filtered ? 8 : 1;
        int inside = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i)
                inside += std::hypot(u + (i + 0.5) / n - x, v + (j + 0.5) / n - y) < radius;
        return float(inside) / float(n * n);
    }
};

Plane picture_of(const Disc& disc, bool filtered) {
    Plane coverage(disc.width, disc.height);
    for (int y = 0; y < disc.height; ++y)
        for (int x = 0; x < disc.width; ++x) coverage(x, y) = disc.coverage(x, y, filtered);
    return coverage;
}

// Coverage averaged over a disc of radius_px around each pixel, nothing beyond the picture: rows of the disc,
// four to a pixel, as differences of running sums.
Plane seen_through_pupil(const Plane& coverage, double radius_px) {
    constexpr int kPerPixel = 4;
    const int width = coverage.width(), height = coverage.height();
    std::vector<std::vector<double>> sums(std::size_t(height), std::vector<double>(std::size_t(width) + 1));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            sums[std::size_t(y)][std::size_t(x) + 1] =
                sums[std::size_t(y)][std::size_t(x)] + double(coverage(x, y));
    const auto up_to = [&](int y, double x) {
        const double at = std::clamp(x, 0.0, double(width));
        const auto whole = std::min(std::size_t(at), std::size_t(width) - 1);
        const auto& row = sums[std::size_t(y)];
        return row[whole] + (at - double(whole)) * (row[whole + 1] - row[whole]);
    };
    struct Row {
        double offset, half_width;
    };
    std::vector<Row> rows;
    double area = 0;
    const int count = int(std::ceil(radius_px * kPerPixel));
    for (int k = -count; k < count; ++k) {
        const double offset = (k + 0.5) / kPerPixel, square = radius_px * radius_px - offset * offset;
        if (square <= 0) continue;
        rows.push_back({offset, std::sqrt(square)});
        area += 2 * std::sqrt(square);
    }
    Plane seen(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (const Row& r : rows) {
                const int v = int(std::floor(y + 0.5 + r.offset));
                if (v >= 0 && v < height)
                    sum += up_to(v, x + 0.5 + r.half_width) - up_to(v, x + 0.5 - r.half_width);
            }
            seen(x, y) = float(sum / area);
        }
    return seen;
}

// The same of the disc itself, averaged over each pixel: from pixels 1 / finer as wide.
Plane seen_through_pupil(const Disc& disc, double radius_px) {
    const int finer = radius_px < 8 ? 4 : 2;
    const Disc fine{finer * disc.width, finer * disc.height, finer * disc.x, finer * disc.y,
                    finer * disc.radius};
    const Plane seen = seen_through_pupil(picture_of(fine, true), finer * radius_px);
    Plane mean(disc.width, disc.height, 0);
    for (int y = 0; y < fine.height; ++y)
        for (int x = 0; x < fine.width; ++x) mean(x / finer, y / finer) += seen(x, y) / float(finer * finer);
    return mean;
}

struct Case {
    const char* name;
    double disc, behind;  // radii, in units of the radius
    bool filtered, has_alpha;
};
constexpr Case kCases[] = {
    {"near, over black in focus", -1, 0, true, false}, {"near, over black behind focus", -1, 1, true, false},
    {"near, unfiltered", -1, 0, false, false},         {"far, over black farther away", 1, 2, true, false},
    {"far, unfiltered", 1, 2, false, false},           {"near, over emptiness", -1, 0, true, true},
};
constexpr float kLight = 0.8f;

Shot shot_of(const Case& c, const Disc& disc, const Plane& coverage, float radius_px) {
    Shot shot = flat(disc.width, disc.height, {0, 0, 0, 1}, float(c.behind) * radius_px);
    for (int y = 0; y < disc.height; ++y)
        for (int x = 0; x < disc.width; ++x) {
            const float a = coverage(x, y), light = kLight * a;
            shot.colour(x, y) = {light, light, light, c.has_alpha ? a : 1};
            if (c.has_alpha ? a > 0 : a >= 0.5f) shot.coc_px(x, y) = float(c.disc) * radius_px;
        }
    return shot;
}

// The largest difference from the answer, of light and alpha.
double largest_error(const Case& c, const Picture& image, const Plane& expected) {
    double largest = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const Rgba p = image(x, y);
            const float alpha = c.has_alpha ? expected(x, y) : 1;
            largest = std::max(
                {largest, double(std::abs(p.r / kLight - expected(x, y))), double(std::abs(p.a - alpha))});
        }
    return largest;
}

// Taps as wide as pixels cannot follow a disc of 1 px wherever in a pixel its edge lies: the best that are
// not negative are wrong by 0.046 at one such edge or another, those of least squares by 0.057.
constexpr double kLimitAt1Px = 0.06;
constexpr Quality kQualities[] = {Quality::Draft, Quality::Standard, Quality::Final};

// Pixels that are all or nothing are squares, and so is what is expected of them.
void check_disc(float radius_px, const Disc& disc) {
    const Plane filtered = picture_of(disc, true), squares = picture_of(disc, false);
    const Plane of_disc = seen_through_pupil(disc, double(radius_px));
    const Plane of_squares = seen_through_pupil(squares, double(radius_px));
    for (const Case& c : kCases) {
        const Plane& expected = c.filtered ? of_disc : of_squares;
        const Shot shot = shot_of(c, disc, c.filtered ? filtered : squares, radius_px);
        const double limit = radius_px < 1.5f ? kLimitAt1Px : c.has_alpha && radius_px < 32 ? 0.03 : 0.05;
        double best = 1;
        for (const Quality quality : kQualities) {
            DefocusJob job = shot.job("scatter");
            job.quality = quality;
            const double error = largest_error(c, rendered(job), expected);
            EXPECT_LT(error, limit) << c.name << ", radius " << radius_px << ", quality " << int(quality);
            EXPECT_LT(error, best + 0.005) << c.name << ", radius " << radius_px << ": quality "
                                           << int(quality) << " is worse than the one below it";
            best = std::min(best, error);
        }
    }
}

TEST(Edges, ADiscThroughAPupilIsTheDiscAveragedOverIt) {
    for (const float radius_px : {1.0f, 1.5f, 2.0f, 3.0f, 5.0f, 8.0f, 13.0f, 21.0f})
        check_disc(radius_px, {180, 150, 90.3, 75.1, 50});
}

TEST(Edges, AWideDiscThroughAWiderPupilToo) {
    for (const float radius_px : {32.0f, 128.0f}) check_disc(radius_px, {420, 340, 210.3, 170.1, 100});
}

}  // namespace
}  // namespace petzval::conformance
