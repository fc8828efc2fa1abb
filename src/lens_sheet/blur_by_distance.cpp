// The circle of confusion: what it is made of, and how it grows with distance.
#include "petzval/camera.h"

#include "lens_sheet/figures.h"
#include "lens_sheet/plot.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace petzval::lens_sheet {
namespace {

constexpr double kWidth = 1100, kHeight = 300, kMiddle = 148;
// In focal lengths: the plane in focus, a point behind it, the radius of the lens; the radius on the film
// that still counts as sharp, in radii of the lens, far larger than anyone would take it.
constexpr double kFocus = 3, kPoint = 5.2, kLens = 1.05, kSharp = 0.1;

double image_of(double distance) { return distance / (distance - 1); }
// Distance of the object that is imaged there.
double seen_at(double image) { return image / (image - 1); }

// Maps focal lengths along the axis and upwards to the drawing.
Point place(double z, double y) { return {(z + kPoint + 0.25) * 149, kMiddle - y * 104}; }

// A length between two places, with its letters.
void measure(Svg& svg, Point from, Point to, const std::string& word, Point beside, Anchor anchor) {
    svg.line(from, to, "dashed");
    const bool level = from.y == to.y;
    for (const Point& end : {from, to})
        svg.line(end - (level ? Point{0, 4} : Point{4, 0}), end + (level ? Point{0, 4} : Point{4, 0}),
                 "axis");
    svg.text(0.5 * (from + to) + beside, word, "word", anchor);
}

void draw_lens(Svg& svg) {
    std::vector<Point> outline;
    for (const int side : {-1, 1})
        for (int k = -12; k <= 12; ++k) {
            const double y = -side * k / 12.0;
            outline.push_back(place(side * 0.11 * (1.05 - y * y), y * kLens));
        }
    svg.path(outline, "glass", true);
}

// Draws the depth of field in front of the lens, and the depth of focus behind it.
void draw_depths(Svg& svg, double film) {
    const double image[] = {film / (1 - kSharp), film / (1 + kSharp)};
    const auto band = [&](double from, double to, double high, const char* word) {
        const Point corner[] = {place(from, high), place(to, high), place(to, -high), place(from, -high)};
        svg.path(corner, "wash", true);
        svg.text(place((from + to) / 2, high) + Point{0, -6}, word, "label", Anchor::Middle);
    };
    band(-seen_at(image[1]), -seen_at(image[0]), 0.72, "depth of field");
    band(image[1], image[0], 0.95, "depth of focus");
}

Figure labelled() {
    const double film = image_of(kFocus), image = image_of(kPoint), last = 1.9;
    const double disc = kLens * (film / image - 1);
    Svg svg(kWidth, kHeight, "the circle of confusion of a point behind the plane in focus");
    svg.text({0, 14}, "The circle of confusion", "title");
    draw_depths(svg, film);
    svg.line(place(-kPoint - 0.2, 0), place(last, 0), "optical-axis");
    draw_lens(svg);
    for (const int side : {-1, 1}) {
        const double y = side * kLens;
        const Point focused[] = {place(-kFocus, 0), place(0, y), place(film, 0),
                                 place(last, y * (1 - last / film))};
        const Point blurred[] = {place(-kPoint, 0), place(0, y), place(image, 0),
                                 place(last, y * (1 - last / image))};
        svg.path(focused, "ray1").path(blurred, "ray2");
    }
    svg.line(place(film, 0.95), place(film, -1.1), "sensor");
    svg.line(place(film, disc), place(film, -disc), "curve0");
    svg.text(place(-kFocus, 0) + Point{0, -8}, "in focus", "ray1", Anchor::Middle);
    svg.text(place(-kPoint, 0) + Point{-4, -8}, "point", "ray2");
    measure(svg, place(-0.2, kLens), place(-0.2, -kLens), "A", {-9, -30}, Anchor::End);
    measure(svg, place(film + 0.12, disc), place(film + 0.12, -disc), "c", {10, 4}, Anchor::Start);
    measure(svg, place(0, -1.18), place(1, -1.18), "f", {0, 15}, Anchor::Middle);
    measure(svg, place(-kFocus, -1.05), place(0, -1.05), "F", {0, -5}, Anchor::Middle);
    measure(svg, place(-kPoint, -1.25), place(0, -1.25), "P", {0, 15}, Anchor::Middle);
    return {svg.str(),
            "A is the diameter of the pupil, f the focal length, F the focus distance, P the distance of a "
            "point. The light of this point converges in front of the film and forms a disc on it, the "
            "circle of confusion. Its diameter is <b>c = A · |P − F|/P · f/(F − f)</b>; petzval uses the "
            "radius, negative in front of focus. A point counts as sharp if c is too small to see: these "
            "points form the depth of field. The positions of the film at which c is that small form the "
            "depth of focus. In this drawing the limit is a tenth of A, so that both ranges are visible.",
            12};
}

struct Stop {
    double share;  // of the open diameter
    const char* css;
};
constexpr Stop kStops[] = {{1, "curve0"}, {0.5, "curve1"}, {0.25, "curve2"}};

// Signed diameter by distance, in hundredths of the picture's width.
Figure over_distance(const Subject& subject) {
    const double focus_m = 40 * subject.focal_length_mm() / 1000;
    const auto coc = [&](double share) {
        const Camera camera{.focal_length_mm = subject.focal_length_mm(),
                            .sensor_width_mm = subject.sensor_width_mm(),
                            .f_number = subject.f_number() / share,
                            .focus_distance_m = focus_m,
                            .image_scale = ImageScale::ThinLens};
        return CircleOfConfusion::make(camera, 200);  // so a radius in pixels is a diameter in hundredths
    };
    const auto open = coc(1);
    if (!open) return {};
    const double most = open->radius_at_infinity_px();
    Plot plot(kWidth, 330, "Circle of confusion by distance", {0, 6 * focus_m, "distance, m"},
              {-1.6 * most, 1.25 * most, "diameter, % of the picture’s width"});
    plot.mark_x(focus_m, "in focus");
    plot.mark_y(most, "infinity: A · f/(F − f)").mark_y(-most, "clamp of published gather methods");
    for (const Stop& stop : kStops) {
        const auto law = coc(stop.share);
        if (!law) return {};
        std::vector<Point> curve;
        for (int i = 1; i <= 600; ++i) {
            const double z = focus_m * i / 100;
            curve.push_back({z, law->radius_px(z)});
        }
        plot.curve(curve, stop.css);
        plot.word({5.2 * focus_m, curve[519].y + 0.05 * most},
                  "f/" + significant(subject.f_number() / stop.share, 2), "label", Anchor::Middle);
    }
    return {plot.str(),
            "Focused at " + significant(focus_m) +
                " m (40 f). In front of focus (below 0), discs grow without limit; behind focus they grow up "
                "to the disc of infinity. A point at half the focus distance is blurred as much as infinity; "
                "published methods for games clamp the near side there. Stopping down by two stops halves "
                "all diameters; the third curve is four stops down.",
            12};
}

}  // namespace

std::vector<Figure> blur_by_distance(const Subject& subject) {
    std::vector<Figure> figures{labelled()};
    if (Figure curve = over_distance(subject); !curve.drawing.empty()) figures.push_back(std::move(curve));
    return figures;
}

}  // namespace petzval::lens_sheet
