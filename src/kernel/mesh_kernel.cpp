#include "kernel/mesh_kernel.h"

#include "kernel/outline.h"

#include <algorithm>
#include <cmath>

namespace petzval::kernel {
namespace {

double signed_area(Point a, Point b, Point c) { return 0.5 * cross(b - a, c - a); }

// Per cell: of its triangle at the outer ring and of its triangle at the inner ring.
struct Halves {
    double outer = 0, inner = 0;
};

// Points on rings from the centroid (ring 0) to the outline, and the light of the cells between them. Cell
// (j, k) has the corners a = (j, k), b = (j, k+1), c = (j+1, k+1), d = (j+1, k) and the triangles a d c and a
// c b.
class Mesh {
public:
    explicit Mesh(const MeshPupil& pupil) : rings_(pupil.rings), spokes_(int(pupil.outline.size())) {
        const Point centre = centroid(pupil.outline);
        for (int j = 0; j <= rings_; ++j)
            for (const Point& rim : pupil.outline)
                points_.push_back(centre + (double(j) / rings_) * (rim - centre));
        for (int j = 0; j < rings_; ++j)
            for (int k = 0; k < spokes_; ++k) {
                const Point a = points_[at(j, k)], b = points_[at(j, k + 1)];
                const Point c = points_[at(j + 1, k + 1)], d = points_[at(j + 1, k)];
                light_.push_back({light(pupil, a, d, c), light(pupil, a, c, b)});
            }
    }

    int rings() const { return rings_; }
    int spokes() const { return spokes_; }
    std::size_t at(int ring, int spoke) const {
        return std::size_t(ring * spokes_ + (spoke == spokes_ ? 0 : spoke));
    }
    const std::vector<Point>& points() const { return points_; }
    const std::vector<Halves>& light() const { return light_; }

private:
    static double light(const MeshPupil& pupil, Point a, Point b, Point c) {
        const double passed = pupil.transmission ? pupil.transmission((1.0 / 3) * (a + b + c)) : 1;
        return passed * signed_area(a, b, c);
    }

    int rings_, spokes_;
    std::vector<Point> points_;
    std::vector<Halves> light_;
};

// The image of the mesh in one wavelength, drawn into a buffer.
class Drawing {
public:
    Drawing(const Mesh& mesh, const std::vector<Point>& landed, CoverageBuffer& buffer)
        : mesh_(mesh), landed_(landed), buffer_(buffer) {}

    void draw() {
        find_densities();
        for (int j = 0; j < mesh_.rings(); ++j)
            for (int k = 0; k < mesh_.spokes(); ++k) {
                const Halves& here = density_[mesh_.at(j, k)];
                const Point a = landed_[mesh_.at(j, k)], d = landed_[mesh_.at(j + 1, k)];
                const Point c = landed_[mesh_.at(j + 1, k + 1)];
                const int before = k == 0 ? mesh_.spokes() - 1 : k - 1;
                const double beyond = j + 1 < mesh_.rings() ? density_[mesh_.at(j + 1, k)].inner : 0;
                // Every edge is drawn once, with what lies on its one side less what lies on the other.
                draw_edge(a, d, here.outer - density_[mesh_.at(j, before)].inner);
                draw_edge(d, c, here.outer - beyond);
                draw_edge(a, c, here.inner - here.outer);
            }
    }

private:
    void draw_edge(Point from, Point to, double weight) {
        if (weight != 0) buffer_.add_edge(from, to, weight);
    }

    void find_densities() {
        density_.resize(mesh_.light().size());
        for (int j = 0; j < mesh_.rings(); ++j)
            for (int k = 0; k < mesh_.spokes(); ++k) {
                const Halves& light = mesh_.light()[mesh_.at(j, k)];
                const Point a = landed_[mesh_.at(j, k)], b = landed_[mesh_.at(j, k + 1)];
                const Point c = landed_[mesh_.at(j + 1, k + 1)], d = landed_[mesh_.at(j + 1, k)];
                const double outer = signed_area(a, d, c), inner = signed_area(a, c, b);
                Halves& density = density_[mesh_.at(j, k)];
                if (outer * inner > 0) {
                    density.outer = density.inner = (light.outer + light.inner) / (outer + inner);
                    if (std::abs(outer + inner) >= kLeastArea) continue;
                }
                density = {spread(light.outer, outer, a, d, c), spread(light.inner, inner, a, c, b)};
            }
    }

    // Light per signed area: a triangle that was turned over counts negative twice, once here and once drawn.
    // One without area, as on a caustic or at a perfect focus, leaves its light in the pixel where it lies.
    double spread(double light, double signed_area_px, Point a, Point b, Point c) {
        if (std::abs(signed_area_px) >= kLeastArea) return light / signed_area_px;
        if (light != 0) buffer_.add_point((1.0 / 3) * (a + b + c), light);
        return 0;
    }

    static constexpr double kLeastArea = 1e-9;  // px^2; above, doubles lose nothing to the division

    const Mesh& mesh_;
    const std::vector<Point>& landed_;
    CoverageBuffer& buffer_;
    std::vector<Halves> density_;
};

Rect extent_of(const std::vector<std::vector<Point>>& landed) {
    Point low = landed[0][0], high = low;
    for (const std::vector<Point>& points : landed)
        for (const Point& p : points) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y)};
        }
    return pixels_touched(low, high);
}

}  // namespace

PointSpread mesh_kernel(const MeshPupil& pupil, const std::vector<MeshBand>& bands) {
    const Mesh mesh(pupil);
    std::vector<std::vector<Point>> landed(bands.size());
    for (std::size_t i = 0; i < bands.size(); ++i)
        for (const Point& p : mesh.points()) landed[i].push_back(bands[i].landing_px(p));

    const Rect extent = extent_of(landed);
    CoverageBuffer buffer(extent);
    PointSpread spread{extent, Image<Rgba>(extent.width(), extent.height()), false};
    for (std::size_t i = 0; i < bands.size(); ++i) {
        buffer.clear();
        Drawing(mesh, landed[i], buffer).draw();
        const BandWeight& w = bands[i].weight;
        for (int y = 0; y < extent.height(); ++y) {
            const double* covered = buffer.resolve_row(y);
            Rgba* row = spread.weights.row(y);
            for (int x = 0; x < extent.width(); ++x)
                row[x] += {float(w.r * covered[x]), float(w.g * covered[x]), float(w.b * covered[x]), 0};
        }
    }
    normalise(spread);
    return spread;
}

int rings_for(double size_px) { return std::clamp(int(std::ceil(8 + size_px / 1.5)), 12, 192); }

std::vector<Point> subdivided(const std::vector<Point>& outline, double longest) {
    std::vector<Point> fine;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point p = outline[i], q = outline[(i + 1) % outline.size()];
        const int parts = std::max(1, int(std::ceil(std::hypot(q.x - p.x, q.y - p.y) / longest)));
        for (int k = 0; k < parts; ++k) fine.push_back(p + (double(k) / parts) * (q - p));
    }
    return fine;
}

}  // namespace petzval::kernel
