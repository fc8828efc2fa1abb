// Constant-time rectangle spreading (Kosloff, Tao, Barsky, "Depth of Field Postprocessing for Layered Scenes
// Using Constant-Time Rectangle Spreading", Graphics Interface 2009): every pixel leaves four differences at
// the corners of its square, and one pass of sums over both axes fills all squares at once, whatever their
// size. Layers of depth are spread apart, normalised and composited from the back.
//
// Here the squares have the area of the discs, and corners between pixels are shared bilinearly. Sums are
// doubles: in floats a bright square would leave a trail.
#include "baselines/baseline.h"

namespace petzval::baselines {
namespace {

constexpr int kLayers = 8;
constexpr int kBorder = 2;

struct Sum {
    double r = 0, g = 0, b = 0, a = 0, weight = 0;
    Sum& operator+=(const Sum& o) { return add(o, 1); }
    Sum& add(const Sum& o, double s) {
        r += s * o.r, g += s * o.g, b += s * o.b, a += s * o.a, weight += s * o.weight;
        return *this;
    }
};

void add_corner(Image<Sum>& sums, double x, double y, const Sum& value, double sign) {
    // Pixels beyond the border are not seen, but a square that begins there reaches in.
    const double cx = std::clamp(x + kBorder, 0.0, double(sums.width() - 2));
    const double cy = std::clamp(y + kBorder, 0.0, double(sums.height() - 2));
    const int ix = int(cx), iy = int(cy);
    const double fx = cx - ix, fy = cy - iy;
    sums(ix, iy).add(value, sign * (1 - fx) * (1 - fy));
    sums(ix + 1, iy).add(value, sign * fx * (1 - fy));
    sums(ix, iy + 1).add(value, sign * (1 - fx) * fy);
    sums(ix + 1, iy + 1).add(value, sign * fx * fy);
}

void add_square(Image<Sum>& sums, int x, int y, double half_px, Rgba c) {
    const double share = 1 / (4 * half_px * half_px);
    const Sum value{share * double(c.r), share * double(c.g), share * double(c.b), share * double(c.a),
                    share};
    const double left = x + 0.5 - half_px, right = x + 0.5 + half_px;
    const double top = y + 0.5 - half_px, bottom = y + 0.5 + half_px;
    add_corner(sums, left, top, value, 1);
    add_corner(sums, right, top, value, -1);
    add_corner(sums, left, bottom, value, -1);
    add_corner(sums, right, bottom, value, 1);
}

void integrate(Image<Sum>& sums) {
    for (int y = 0; y < sums.height(); ++y)
        for (int x = 1; x < sums.width(); ++x) sums(x, y) += sums(x - 1, y);
    for (int y = 1; y < sums.height(); ++y)
        for (int x = 0; x < sums.width(); ++x) sums(x, y) += sums(x, y - 1);
}

// One layer, spread: colour times how much of the pixel it covers.
Picture spread(const Input& input, const LayerRule& rule, int layer) {
    const int width = input.colour.width(), height = input.colour.height();
    Image<Sum> sums(width + 2 * kBorder + 1, height + 2 * kBorder + 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (const float coc = input.coc_px(x, y); rule.layer_of(coc) == layer) {
                constexpr double kHalfSidePerRadius = 0.886226925;  // sqrt(pi) / 2: equal areas
                add_square(sums, x, y, std::max(0.5, kHalfSidePerRadius * std::abs(double(coc))),
                           input.colour(x, y));
            }
    integrate(sums);
    Picture out(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Sum& s = sums(x + kBorder, y + kBorder);
            // More than a whole pixel arrives where radii shrink outwards; then it is normalised.
            const double scale = 1 / std::max(1.0, s.weight);
            out(x, y) = {float(s.r * scale), float(s.g * scale), float(s.b * scale), float(s.a * scale)};
        }
    return out;
}

}  // namespace

Picture rectangle_spreading(const Input& input) { return layer_by_layer(input, kLayers, spread); }

}  // namespace petzval::baselines
