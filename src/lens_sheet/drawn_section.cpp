// Diagram of a lens without known glass: elements typical for its kind, rays that bend once at the principal
// plane and meet as the curves say.
#include "lens_sheet/frame.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace petzval::lens_sheet {
namespace {

constexpr double kHeight = 360, kEdge = 1.12;  // of the glass, pupil radii
constexpr int kArcSteps = 24;

enum class Shape { Sphere, Asphere, Steps };

// Pupil radii: where the surface meets the axis, and how much farther right its edge lies.
struct Surface {
    double vertex, sag;
    Shape shape = Shape::Sphere;

    double at(double height) const {
        const double a = height * height / (kEdge * kEdge);
        switch (shape) {
            case Shape::Asphere:
                return vertex + sag * a * (1.5 - 0.5 * a);  // flatter towards the edge
            case Shape::Steps:
                return vertex + sag * (6 * a - std::floor(6 * a));  // rings of a diffractive surface
            case Shape::Sphere:
                break;
        }
        return vertex + sag * a;
    }
};

struct Element {
    Surface front, back;
    bool is_flint = false;
};
using Elements = std::vector<Element>;

// Typical elements of lenses of this description; not to scale. Empty: unknown.
const Elements& elements_of(const std::string& name) {
    static const Elements doublet = {{{-0.34, 0.20}, {0.08, -0.18}}, {{0.08, -0.18}, {0.22, -0.03}, true}};
    static const std::pair<const char*, Elements> known[] = {
        {"uncorrected", {{{-0.22, 0.21}, {0.22, -0.21}}}},
        {"doublet", doublet},
        {"doublet-ccd", doublet},
        {"doublet-f4", {{{-0.20, 0.13}, {0.06, -0.12}}, {{0.06, -0.12}, {0.17, -0.02}, true}}},
        {"doublet-overcorrected", {{{-0.38, 0.20}, {0.08, -0.22}}, {{0.08, -0.22}, {0.20, 0.10}, true}}},
        {"triplet",
         {{{-0.46, 0.18}, {-0.20, 0.01}},
          {{-0.05, -0.11}, {0.03, 0.13}, true},
          {{0.24, -0.02}, {0.48, -0.17}}}},
        {"asphere", {{{-0.28, 0.26, Shape::Asphere}, {0.14, 0}}}},
        {"apochromat",
         {{{-0.42, 0.20}, {-0.04, -0.15}},
          {{-0.04, -0.15}, {0.06, 0.13}, true},
          {{0.06, 0.13}, {0.36, -0.15}}}},
        {"diffractive", {{{-0.24, 0.20}, {0.14, 0.05, Shape::Steps}}}},
    };
    static const Elements none;
    const auto* const found = std::find_if(std::begin(known), std::end(known),
                                           [&](const auto& entry) { return entry.first == name; });
    return found == std::end(known) ? none : found->second;
}

// Focus of the zone next to a height, mm from the paraxial focus.
double focus_at(const std::vector<Point>& foci, double height) {
    double shift = 0, nearest = 2;
    for (const Point& p : foci)
        if (std::abs(p.y - height) < nearest) nearest = std::abs(p.y - height), shift = p.x;
    return shift;
}

// Magnification of focus differences in the drawing: the longest spans a tenth of the focal length.
double exaggeration(const Subject& subject) {
    double longest = 1e-9;
    for (const SpectralLine& line : spectral_lines())
        for (const Point& p : subject.zone_foci(line.wavelength_nm))
            longest = std::max(longest, std::abs(p.x - subject.best_focus_mm()));
    const double times = 0.1 * subject.focal_length_mm() / longest;
    const double power = std::pow(10.0, std::floor(std::log10(times)));
    return std::clamp(std::floor(times / power) * power, 1.0, 1000.0);
}

class Diagram {
public:
    explicit Diagram(const Subject& subject)
        : subject_(subject),
          f_(subject.focal_length_mm()),
          rim_(f_ / (2 * subject.f_number())),
          times_(exaggeration(subject)),
          svg_(kWidth, kHeight, "schematic section of " + subject.name() + " with rays") {
        frame_.left_mm = low(), frame_.middle = kHeight / 2 - 6;
        frame_.scale = (kWidth - 2 * kMargin) / (high() - low());
        stretch_ = 0.37 * kHeight / rim_ / frame_.scale;
    }

    std::string str() {
        svg_.line(place(low(), 0), place(high(), 0), "optical-axis");
        draw_lens();
        draw_axial_rays();
        draw_slanted_rays();
        draw_words();
        return svg_.str();
    }

private:
    double low() const { return -0.3 * f_; }
    double high() const { return 1.2 * f_; }
    double sensor() const { return f_ + times_ * subject_.best_focus_mm(); }
    double slope() const { return 0.75 * rim_ / f_; }  // of the slanted beam, which must fit on the page
    // Stretched upwards to fill the page: this is a diagram.
    Point place(double z, double y) const { return frame_(z, stretch_ * y); }
    // Pupil radii, to one scale along and across.
    Point in_glass(double z, double y) const { return frame_(z * stretch_ * rim_, y * stretch_ * rim_); }

    void draw_lens() {
        static const Elements thin = {{{-0.22, 0.21}, {0.22, -0.21}}};
        const Elements& known = elements_of(subject_.name());
        for (const Element& element : known.empty() ? thin : known) {
            std::vector<Point> glass;
            for (const int side : {-1, 1})  // up along the front, down along the back
                for (int k = -kArcSteps; k <= kArcSteps; ++k) {
                    const double y = -side * kEdge * double(k) / kArcSteps;
                    glass.push_back(in_glass((side < 0 ? element.front : element.back).at(y), y));
                }
            svg_.path(glass, element.is_flint ? "ghost flint" : "ghost", true);
        }
        for (const int side : {-1, 1})
            svg_.line(place(0, side * 1.16 * rim_), place(0, side * 1.28 * rim_), "stop");
        svg_.text(place(0, 1.28 * rim_) + Point{6, 8}, "stop", "note");
    }

    void draw_axial_rays() {
        for (const SpectralLine& line : spectral_lines()) {
            if (std::string(line.name) == "F" || std::string(line.name) == "d") continue;
            const auto foci = subject_.zone_foci(line.wavelength_nm);
            for (const double height : {-1.0, -0.75, -0.4, 0.4, 0.75, 1.0}) {
                const double y = height * rim_, focus = f_ + times_ * focus_at(foci, std::abs(height));
                const Point path[] = {place(low(), y), place(0, y), place(high(), y * (1 - high() / focus))};
                svg_.path(path, line.css);
            }
        }
    }

    // Parallel light from the side: the ray through the middle of the lens goes straight, the others meet it.
    void draw_slanted_rays() {
        const auto foci = subject_.zone_foci(546.074);
        const double end = 1.1 * f_;
        for (const double height : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
            const double y = height * rim_, focus = f_ + times_ * focus_at(foci, std::abs(height));
            const double after = height == 0 ? slope() : (slope() * focus - y) / focus;
            const Point path[] = {place(low(), y + low() * slope()), place(0, y),
                                  place(end, y + end * after)};
            svg_.path(path, height == 0 ? "ray1 bold" : "ray1");
        }
    }

    void draw_words() {
        svg_.line(place(sensor(), -1.0 * rim_), place(sensor(), 1.0 * rim_), "sensor");
        svg_.text(place(sensor(), -1.0 * rim_) + Point{0, 14}, "sensor, best focus", "note", Anchor::Middle);
        svg_.text({kMargin, kHeight - 8}, "g 436 nm dotted, e 546 nm dash and dot, C 656 nm dashed", "note");
        svg_.text({kMargin + 330, kHeight - 8},
                  "— from " + number(std::atan(slope()) * 180 / std::numbers::pi, 1) + "° off the axis",
                  "ray1");
        if (times_ > 1 && !subject_.zone_foci(546).empty())
            svg_.text({kWidth - kMargin, kHeight - 8},
                      "differences of focus drawn " + number(times_, 0) + " times larger", "note",
                      Anchor::End);
    }

    const Subject& subject_;
    double f_, rim_, times_, stretch_ = 1;
    Frame frame_;
    Svg svg_;
};

}  // namespace

Figure drawn_section(const Subject& subject) {
    return {Diagram(subject).str(),
            std::string("A schematic drawing, because aberration curves and not glasses define this lens. ") +
                (elements_of(subject.name()).empty()
                     ? "The outline stands for any lens. "
                     : "The elements are typical of this kind of lens and not to scale. ") +
                "Each ray bends once, towards the focus of its own zone and wavelength. The distances "
                "between these foci are exaggerated, as in the figures of Kawase's talk; otherwise they "
                "would be invisible. Parallel light from the side converges off the axis, on the straight "
                "ray through the middle of the lens.",
            12};
}

}  // namespace petzval::lens_sheet
