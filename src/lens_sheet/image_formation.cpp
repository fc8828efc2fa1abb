// Figures of image formation: magnification by distance, and the effect of the stop on points out of focus.
#include "base/parallel.h"
#include "lens_sheet/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace petzval::lens_sheet {
namespace {

// Distances in focal lengths.
double image_of(double distance) { return distance / (distance - 1); }

struct Scene {
    double distance;  // of what is in focus
    double near_point() const { return 1 + 0.62 * (distance - 1); }
    double far_point() const { return 1 + 1.9 * (distance - 1); }
    double magnification() const { return 1 / (distance - 1); }
    // Signed radius on the film of a point elsewhere, in radii of the lens; + behind the focus.
    double radius_of(double point) const {
        const double film = image_of(distance), image = image_of(point);
        return (film - image) / image;
    }
};
constexpr std::array<Scene, 3> kScenes{{{3}, {2}, {1.5}}};

struct Stop {
    const char* name;
    double share;  // of the open diameter
};
constexpr std::array<Stop, 4> kStops{
    {{"open", 1}, {"2 stops down", 0.5}, {"4 stops down", 0.25}, {"pinhole", 0.02}}};

void draw_lens(Svg& svg, Point middle, double half_height) {
    std::vector<Point> outline;
    for (const int side : {-1, 1})
        for (int k = -12; k <= 12; ++k) {
            const double y = -side * k / 12.0;
            outline.push_back(middle + Point{side * half_height * 0.13 * (1.06 - y * y), y * half_height});
        }
    svg.path(outline, "glass", true);
}

// Object, lens, image, with the ray through the middle and those through both focal points.
Figure magnification(const Scene& scene) {
    constexpr double kWidth = 352, kHeight = 222, kMiddle = 104, kObject = 0.36;
    const double scale = (kWidth - 30) / 4.5, a = scene.distance, film = image_of(a),
                 m = scene.magnification();
    const double left = (kWidth - (a + film) * scale) / 2;
    const auto place = [&](double z, double y) { return Point{left + (a + z) * scale, kMiddle - y * scale}; };
    Svg svg(kWidth, kHeight, "object at " + number(a, 1) + " f");
    svg.line(place(-a, 0) + Point{-6, 0}, place(film, 0) + Point{6, 0}, "optical-axis");
    draw_lens(svg, place(0, 0), 0.95 * scale);
    const Point tip = place(-a, kObject), image = place(film, -m * kObject);
    const Point parallel[] = {tip, place(0, kObject), image}, centre[] = {tip, image};
    const Point focal[] = {tip, place(0, -m * kObject), image};
    svg.path(parallel, "ray0").path(centre, "ray1").path(focal, "ray2");
    svg.line(place(-a, 0), tip, "object").line(place(film, 0.75), place(film, -0.85), "sensor");
    svg.line(place(film, 0), image, "object");
    for (const double z : {-1.0, 1.0}) {
        svg.line(place(z, 0) + Point{0, -4}, place(z, 0) + Point{0, 4}, "sensor");
        svg.text(place(z, 0) + Point{0, 17}, "f", "tick", Anchor::Middle);
    }
    svg.text(place(-a, kObject) + Point{4, -6}, "y", "word");
    svg.text(image + Point{-6, 14}, "y′", "word", Anchor::End);
    const double base = kHeight - 12;
    svg.text({place(-a / 2, 0).x, base}, "a = " + number(a, 1) + " f", "label", Anchor::Middle);
    svg.text({place(film / 2, 0).x, base}, "a′ = " + number(film, 1) + " f", "label", Anchor::Middle);
    // Newton's distances, from the focal points.
    const double above = base - 16;
    svg.text({place(-(a + 1) / 2, 0).x, above}, "b = " + number(a - 1, 1) + " f", "label", Anchor::Middle);
    svg.text({place((1 + film) / 2, 0).x, above}, "b′ = " + number(film - 1, 1) + " f", "label",
             Anchor::Middle);
    svg.text({0, 14}, "M = a′/a = f/b = b′/f = " + number(m, 1), "title");
    return {svg.str(), "", 4};
}

// The cones of a near, a focused and a far point through the stop.
void draw_cones(Svg& svg, Point corner, double width, const Scene& scene, const Stop& stop) {
    constexpr double kHalf = 46;
    const double far_point = scene.far_point(), film = image_of(scene.distance);
    const double end = image_of(scene.near_point()) * 1.0;
    const double scale = width / (far_point + end);
    const auto place = [&](double z, double y) {
        return corner + Point{(far_point + z) * scale, kHalf - y * kHalf * 0.8};
    };
    svg.line(place(-far_point, 0), place(end, 0), "optical-axis");
    draw_lens(svg, place(0, 0), kHalf * 0.86);
    const struct {
        double point;
        const char* css;
    } cones[] = {{scene.near_point(), "ray0"}, {scene.distance, "ray1"}, {far_point, "ray2"}};
    for (const auto& cone : cones)
        for (const int side : {-1, 1}) {
            const double y = side * stop.share, image = image_of(cone.point), last = std::max(end, image);
            const Point path[] = {place(-cone.point, 0), place(0, y), place(last, y * (1 - last / image))};
            svg.path(path, cone.css);
        }
    for (const int side : {-1, 1}) svg.line(place(0.04, side * stop.share), place(0.04, side * 1.16), "stop");
    svg.line(place(film, 0.8), place(film, -0.8), "sensor");
}

Figure stops(const Subject& subject) {
    constexpr double kWidth = 1100, kColumn = 258, kLeft = 68, kTop = 34, kCones = 100, kCell = 129;
    constexpr int kPx = 176;
    const double lens_radius_um = 1000 * subject.focal_length_mm() / subject.f_number() / 2;
    struct Disc {
        int column = 0, row = 0, side = 0;
        kernel::PointSpread disc;
    };
    std::vector<std::optional<Axial>> lenses;
    std::vector<Disc> discs;
    for (int column = 0; column < int(kStops.size()); ++column) {
        const auto lens = subject.mounted(subject.f_number() / kStops[std::size_t(column)].share);
        lenses.push_back(lens ? std::optional<Axial>(*lens) : std::nullopt);
        for (int row = 0; lens && row < int(kScenes.size()); ++row)
            for (const int side : {0, 1}) discs.push_back({column, row, side, {}});
    }
    parallel_for(int(discs.size()), subject.workers(), [&](int i) {
        Disc& d = discs[std::size_t(i)];
        const Scene& scene = kScenes[std::size_t(d.row)];
        const double share = kStops[std::size_t(d.column)].share;
        const double near_radius = scene.radius_of(scene.near_point()),
                     far_radius = scene.radius_of(scene.far_point());
        const double largest_um = lens_radius_um * std::max(-near_radius, far_radius);
        d.disc = lenses[std::size_t(d.column)]->disc(
            lens_radius_um * share * (d.side == 0 ? near_radius : far_radius),
            1.1 * largest_um / (0.46 * kPx));
    });
    Canvas canvas(int(kStops.size()) * 2 * kPx, int(kScenes.size()) * kPx);
    for (const Disc& d : discs) {
        const int x = (2 * d.column + d.side) * kPx, y = d.row * kPx;
        canvas.add(d.disc, x + kPx / 2, y + kPx / 2, even_gain(d.disc),
                   {x + 1, y + 1, x + kPx - 1, y + kPx - 1});
    }
    const double top = kTop + kCones + 24, bottom = top + kCell * double(kScenes.size());
    Svg svg(kWidth, bottom + 10, "the stop, and discs in front of and behind the focus");
    svg.image({kLeft, top}, kColumn * 4, bottom - top, canvas.uri());
    for (std::size_t c = 0; c < kStops.size(); ++c) {
        const double x = kLeft + double(c) * kColumn;
        const double n = subject.f_number() / kStops[c].share;
        svg.text({x + 6, 15}, std::string(kStops[c].name) + ", f/" + significant(n, 2), "title");
        draw_cones(svg, {x + 8, kTop}, kColumn - 20, kScenes[1], kStops[c]);
        svg.text({x + kColumn / 4, top - 6}, "near disc", "label", Anchor::Middle);
        svg.text({x + 3 * kColumn / 4, top - 6}, "far disc", "label", Anchor::Middle);
    }
    for (std::size_t r = 0; r < kScenes.size(); ++r) {
        const double y = top + (double(r) + 0.5) * kCell;
        svg.text({kLeft - 8, y}, number(kScenes[r].distance, 1) + " f", "name", Anchor::End);
        svg.text({kLeft - 8, y + 15}, "M = " + number(kScenes[r].magnification(), 1), "tick", Anchor::End);
    }
    return {svg.str(),
            "Cones of light of three points: one in front of focus, which converges behind the film; one in "
            "focus; and one behind focus, which converges in front of the film. The stop narrows all three "
            "cones. The focused point does not change; the two discs shrink until, through a pinhole, "
            "everything is sharp. The rows below show the two discs of this lens, focused at 3f, 2f and "
            "1.5f; each row has one scale.",
            12};
}

}  // namespace

std::vector<Figure> image_formation(const Subject& subject) {
    std::vector<Figure> figures;
    for (const Scene& scene : kScenes) figures.push_back(magnification(scene));
    figures.push_back(stops(subject));
    return figures;
}

}  // namespace petzval::lens_sheet
