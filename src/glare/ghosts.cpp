#include "glare/ghosts.h"

#include "base/parallel.h"
#include "kernel/draw/outline.h"

#include <algorithm>
#include <cmath>

namespace petzval::glare {
namespace {

using kernel::Light;
using kernel::Point;

struct Source {
    Point place_px;  // from the middle
    Light light;     // summed over pixels
};

constexpr std::size_t kMostSources = 1200;

// Highlights gathered in square cells, each at its centre of gravity; larger cells while there are too many.
std::vector<Source> gathered(View<const Rgba> light, Point middle, int cell) {
    const int columns = (light.width() + cell - 1) / cell, rows = (light.height() + cell - 1) / cell;
    std::vector<Source> cells(std::size_t(columns) * std::size_t(rows));
    for (int y = 0; y < light.height(); ++y)
        for (int x = 0; x < light.width(); ++x) {
            const Rgba c = light(x, y);
            const double weight = double(c.r) + double(c.g) + double(c.b);
            if (weight == 0) continue;
            Source& s = cells[std::size_t(y / cell) * std::size_t(columns) + std::size_t(x / cell)];
            s.light += {c.r, c.g, c.b};
            s.place_px = s.place_px + weight * Point{x + 0.5, y + 0.5};
        }
    std::erase_if(cells, [](const Source& s) { return s.light.r + s.light.g + s.light.b == 0; });
    for (Source& s : cells) s.place_px = (1 / (s.light.r + s.light.g + s.light.b)) * s.place_px - middle;
    return cells;
}

std::vector<Source> sources(View<const Rgba> light, Point middle) {
    int cell = 1;
    auto found = gathered(light, middle, cell);
    while (found.size() > kMostSources) found = gathered(light, middle, cell *= 2);
    return found;
}

// The part of a convex polygon where offset + slope . p >= 0.
std::vector<Point> half_plane(const std::vector<Point>& polygon, Point slope, double offset) {
    std::vector<Point> kept;
    const auto height = [&](Point p) { return offset + slope.x * p.x + slope.y * p.y; };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        const double hp = height(p), hq = height(q);
        if (hp >= 0) kept.push_back(p);
        if ((hp >= 0) != (hq >= 0)) kept.push_back(p + (hp / (hp - hq)) * (q - p));
    }
    return kept;
}

std::vector<Point> inside(std::vector<Point> polygon, const Rect& pixels) {
    polygon = half_plane(polygon, {1, 0}, 0.5 - pixels.x0);
    polygon = half_plane(polygon, {-1, 0}, pixels.x1 - 0.5);
    polygon = half_plane(polygon, {0, 1}, 0.5 - pixels.y0);
    return half_plane(polygon, {0, -1}, pixels.y1 - 0.5);
}

void draw(kernel::CoverageBuffer<Light>& buffer, const GhostShape& ghost, Point middle, const Light& source) {
    const Light light{source.r * ghost.share.r, source.g * ghost.share.g, source.b * ghost.share.b};
    std::vector<Point> outline = ghost.outline;
    // The buffer counts from pixel centres.
    for (Point& p : outline) p = p + middle - Point{0.5, 0.5};
    const double area = kernel::area(outline);
    if (std::abs(area) < 1e-3) {
        const Point p = outline.front();
        if (buffer.extent().contains(int(std::floor(p.x + 0.5)), int(std::floor(p.y + 0.5))))
            buffer.add_point(p, light);
        return;
    }
    outline = inside(std::move(outline), buffer.extent());
    if (outline.size() >= 3) buffer.add_polygon(outline, 1 / area * light);
}

// One ghost: its position (times the light's distance from the middle; negative: on the other side), its size
// and its red, green and blue fractions. Chosen by eye after the flares of 1970s zooms; columns are scaled to
// sum to 1.
struct Sprite {
    double place, radius;  // radius: share of the frame's height
    Light tint;
};
constexpr Sprite kSprites[] = {
    {-0.28, 0.012, {1.0, 0.8, 0.5}}, {-0.55, 0.040, {0.5, 1.0, 0.7}}, {-0.95, 0.075, {0.5, 0.6, 1.3}},
    {-1.55, 0.140, {1.3, 0.6, 0.4}}, {0.35, 0.022, {0.4, 0.9, 1.2}},  {0.62, 0.055, {1.1, 0.5, 0.9}},
    {1.40, 0.110, {0.6, 1.0, 0.5}},
};

}  // namespace

GhostModel sprite_ghosts(const ApertureShape& aperture, double height_px, double pixel_aspect) {
    Light sum;
    for (const Sprite& s : kSprites) sum += s.tint;
    const std::vector<Point> unit = kernel::aperture_outline(aperture, 0.3 / std::max(1.0, 0.14 * height_px));
    return [=](Point source) {
        std::vector<GhostShape> ghosts;
        for (const Sprite& s : kSprites) {
            GhostShape ghost;
            ghost.share = {s.tint.r / sum.r, s.tint.g / sum.g, s.tint.b / sum.b};
            const double radius = std::copysign(s.radius * height_px, s.place);  // beyond the middle: turned
            for (const Point& p : unit)
                ghost.outline.push_back(s.place * source + radius * Point{p.x, p.y * pixel_aspect});
            ghosts.push_back(std::move(ghost));
        }
        return ghosts;
    };
}

Picture ghosts_of(View<const Rgba> light, const GhostModel& model, Point middle, Workers& workers) {
    kernel::CoverageBuffer<Light> buffer(light.rect());
    const auto lights = sources(light, middle);
    std::vector<std::vector<GhostShape>> ghosts(lights.size());
    parallel_for(int(lights.size()), workers,
                 [&](int i) { ghosts[std::size_t(i)] = model(lights[std::size_t(i)].place_px); });
    for (std::size_t i = 0; i < lights.size(); ++i)  // in order: sums are the same for any thread count
        for (const GhostShape& ghost : ghosts[i]) draw(buffer, ghost, middle, lights[i].light);
    Picture thrown = Picture::uninitialised(light.width(), light.height());
    parallel_for(thrown.height(), workers, [&](int y) {
        const Light* row = buffer.resolve_row(y);
        const auto positive = [](double v) { return float(std::max(v, 0.0)); };
        for (int x = 0; x < thrown.width(); ++x)
            thrown(x, y) = {positive(row[x].r), positive(row[x].g), positive(row[x].b), 0};
    });
    return thrown;
}

}  // namespace petzval::glare
