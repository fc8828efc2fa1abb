#include "kernel/draw/mesh_kernel.h"

#include "base/cancel.h"
#include "kernel/draw/outline.h"

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
        for (int j = 0; j <= rings_; ++j) {
            // Towards the rim, where aberrations bend most, rings are half as wide as on average.
            const double t = double(j) / rings_, radius = t * (1.5 - 0.5 * t);
            for (const Point& rim : pupil.outline) points_.push_back(centre + radius * (rim - centre));
        }
        std::vector<double> density(points_.size(), 1.0);
        if (pupil.density) pupil.density(points_, density.data());
        const auto light_of = [&](std::size_t p, std::size_t q, std::size_t r) {
            return (density[p] + density[q] + density[r]) / 3 *
                   light(pupil, points_[p], points_[q], points_[r]);
        };
        for (int j = 0; j < rings_; ++j) {
            check_cancelled();
            for (int k = 0; k < spokes_; ++k) {
                const std::size_t a = at(j, k), b = at(j, k + 1), c = at(j + 1, k + 1), d = at(j + 1, k);
                light_.push_back({light_of(a, d, c), light_of(a, c, b)});
            }
        }
    }

    int rings() const { return rings_; }
    int spokes() const { return spokes_; }
    std::size_t at(int ring, int spoke) const {
        return std::size_t(ring * spokes_ + (spoke == spokes_ ? 0 : spoke));
    }
    const std::vector<Point>& points() const { return points_; }
    const std::vector<Halves>& light() const { return light_; }
    double light_of_all() const {
        double sum = 0;
        for (const Halves& cell : light_) sum += cell.outer + cell.inner;
        return sum;
    }

private:
    static double light(const MeshPupil& pupil, Point a, Point b, Point c) {
        const double whole = signed_area(a, b, c);
        if (!pupil.transmission) return whole;
        // The two triangles of a cell fill a square of twice their area.
        return whole * pupil.transmission((1.0 / 3) * (a + b + c), std::sqrt(0.5 * std::abs(whole)) + 1e-9);
    }

    int rings_, spokes_;
    std::vector<Point> points_;
    std::vector<Halves> light_;
};

// The image of the mesh in one wavelength, drawn into a buffer. Cells need not land within its extent.
class Drawing {
public:
    Drawing(const Mesh& mesh, CoverageBuffer<double>& buffer, bool is_whole)
        : mesh_(mesh), buffer_(buffer), is_whole_(is_whole), density_(mesh.light().size()) {
        const Rect& e = buffer.extent();
        low_ = {e.x0 - 0.5, e.y0 - 0.5}, high_ = {e.x1 - 0.5, e.y1 - 0.5};
    }

    void draw(const Point* landed) {
        landed_ = landed;
        find_densities();
        for (int j = 0; j < mesh_.rings(); ++j) {
            check_cancelled();
            for (int k = 0; k < mesh_.spokes(); ++k) {
                const Halves& here = density_[mesh_.at(j, k)];
                const Point a = landed[mesh_.at(j, k)], d = landed[mesh_.at(j + 1, k)];
                const Point c = landed[mesh_.at(j + 1, k + 1)];
                const int before = k == 0 ? mesh_.spokes() - 1 : k - 1;
                const double beyond = j + 1 < mesh_.rings() ? density_[mesh_.at(j + 1, k)].inner : 0;
                // Every edge is drawn once, with the density on its one side less the density on the other.
                draw_edge(a, d, here.outer - density_[mesh_.at(j, before)].inner);
                draw_edge(d, c, here.outer - beyond);
                draw_edge(a, c, here.inner - here.outer);
            }
        }
    }

private:
    static constexpr double kLeastArea = 1e-9;  // px^2; above, doubles lose nothing to the division

    // Covers what is right of it: beside the buffer, the border stands for the edge.
    void draw_edge(Point from, Point to, double density) {
        if (density == 0) return;
        if (is_whole_) return buffer_.add_edge(from, to, density);
        if (from.y > to.y) std::swap(from, to), density = -density;
        if (to.y <= low_.y || from.y >= high_.y) return;
        const Point first = from, along = to - from;
        const auto at_row = [&](double y) { return Point{first.x + (y - first.y) / along.y * along.x, y}; };
        if (from.y < low_.y) from = at_row(low_.y);
        if (to.y > high_.y) to = at_row(high_.y);
        const auto draw_up_to = [&](Point next) {
            const auto beside = [&](Point p) { return Point{std::clamp(p.x, low_.x, high_.x), p.y}; };
            buffer_.add_edge(beside(from), beside(next), density);
            from = next;
        };
        const bool rightwards = along.x > 0;
        for (const double border : {rightwards ? low_.x : high_.x, rightwards ? high_.x : low_.x})
            if ((from.x < border) != (to.x < border) && along.x != 0)
                draw_up_to({border, first.y + (border - first.x) / along.x * along.y});
        draw_up_to(to);
    }

    bool is_outside(Point a, Point b, Point c, Point d) const {
        if (is_whole_) return false;
        return std::max({a.x, b.x, c.x, d.x}) <= low_.x || std::min({a.x, b.x, c.x, d.x}) >= high_.x ||
               std::max({a.y, b.y, c.y, d.y}) <= low_.y || std::min({a.y, b.y, c.y, d.y}) >= high_.y;
    }

    void find_densities() {
        for (int j = 0; j < mesh_.rings(); ++j)
            for (int k = 0; k < mesh_.spokes(); ++k) {
                const Halves& light = mesh_.light()[mesh_.at(j, k)];
                const Point a = landed_[mesh_.at(j, k)], b = landed_[mesh_.at(j, k + 1)];
                const Point c = landed_[mesh_.at(j + 1, k + 1)], d = landed_[mesh_.at(j + 1, k)];
                Halves& density = density_[mesh_.at(j, k)];
                if (is_outside(a, b, c, d)) {
                    density = {};
                    continue;
                }
                const double outer = signed_area(a, d, c), inner = signed_area(a, c, b);
                if (outer * inner >= 0 && std::abs(outer + inner) >= kLeastArea) {
                    density.outer = density.inner = (light.outer + light.inner) / (outer + inner);
                } else {
                    density.outer = spread(light.outer, outer, a, d, c);
                    density.inner = spread(light.inner, inner, a, c, b);
                }
            }
    }

    // Light per signed area: a triangle that was turned over counts negative twice, here and when drawn. One
    // without area, as on a caustic or at a perfect focus, leaves its light in the pixel where it lies.
    double spread(double light, double area_px, Point a, Point b, Point c) {
        if (std::abs(area_px) >= kLeastArea) return light / area_px;
        const Point middle = (1.0 / 3) * (a + b + c);
        if (light != 0 && !is_outside(middle, middle, middle, middle)) buffer_.add_point(middle, light);
        return 0;
    }

    const Mesh& mesh_;
    CoverageBuffer<double>& buffer_;
    bool is_whole_;     // everything lands within the buffer
    Point low_, high_;  // borders of the buffer
    const Point* landed_ = nullptr;
    std::vector<Halves> density_;
};

Rect extent_of(const std::vector<Point>& points) {
    Point low = points[0], high = points[0];
    for (const Point& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    return pixels_touched(low, high);
}

PointSpread spread_of(const Image<Light>& sum, const Rect& extent, const Light& whole) {
    PointSpread spread{extent, Image<Rgba>::uninitialised(extent.width(), extent.height()), false};
    // Clears rounding errors where nothing landed, against light of a few units in all.
    const auto cleared = [](double light, double of) {
        return std::abs(light) < 1e-13 ? 0.0f : float(light / of);
    };
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const Light& l = sum.pixels()[i];
        spread.weights.pixels()[i] = {cleared(l.r, whole.r), cleared(l.g, whole.g), cleared(l.b, whole.b), 0};
    }
    return spread;
}

// The mesh and where it lands in each band.
class Landed {
public:
    Landed(const MeshPupil& pupil, const std::vector<MeshBand>& bands) : mesh_(pupil), bands_(bands) {
        const std::size_t count = mesh_.points().size();
        points_.resize(count * bands.size());
        for (std::size_t i = 0; i < bands.size(); ++i) {
            check_cancelled();
            bands[i].land(mesh_.points(), &points_[i * count]);
        }
    }

    Rect extent() const { return extent_of(points_); }

    Image<Light> drawn(const Rect& extent) const {
        CoverageBuffer<double> buffer(extent);
        Drawing drawing(mesh_, buffer, extent == extent_of(points_));
        Image<Light> sum(extent.width(), extent.height());
        for (std::size_t i = 0; i < bands_.size(); ++i) {
            drawing.draw(&points_[i * mesh_.points().size()]);
            for (int y = 0; y < extent.height(); ++y) {
                check_cancelled();
                buffer.drain_row(y, [&, row = sum.row(y)](int x, double covered) {
                    row[x] += covered * bands_[i].weight;
                });
            }
        }
        return sum;
    }

    Light light() const {
        Light sum;
        for (const MeshBand& band : bands_) sum += mesh_.light_of_all() * band.weight;
        return sum;
    }

private:
    Mesh mesh_;
    const std::vector<MeshBand>& bands_;
    std::vector<Point> points_;
};

}  // namespace

PointSpread mesh_kernel(const MeshPupil& pupil, const std::vector<MeshBand>& bands) {
    const Landed landed(pupil, bands);
    const Rect extent = landed.extent();
    PointSpread spread = spread_of(landed.drawn(extent), extent, {1, 1, 1});
    trim(spread);
    normalise(spread);
    return spread;
}

PointSpread mesh_kernel(const MeshPupil& pupil, const std::vector<MeshBand>& bands, const Rect& window) {
    const Landed landed(pupil, bands);
    const Rect extent = landed.extent().intersected(window);
    if (extent.empty()) return {{}, {}, false};
    return spread_of(landed.drawn(extent), extent, landed.light());
}

int mesh_rings(double size_px) { return std::clamp(int(std::ceil(5 + std::pow(size_px, 0.8))), 6, 192); }

double mesh_tolerance(double size_px) { return 0.05 / std::max(size_px, 4.0); }

double mesh_step(double size_px) { return std::sqrt(8 * mesh_tolerance(size_px)); }

MeshPupil mesh_pupil(const Pupil& pupil, const std::vector<Point>& outline, double size_px, double bend_px) {
    MeshPupil mesh{subdivided(outline, mesh_step(bend_px)), {}, mesh_rings(size_px), {}};
    if (!pupil.has_texture()) return mesh;
    mesh.rings = std::clamp(int(1.2 * size_px), 32, 256);
    mesh.outline = subdivided(outline, 1.2 / mesh.rings);
    mesh.transmission = [&pupil](Point p, double half_width) { return pupil.transmission(p, half_width); };
    return mesh;
}

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
