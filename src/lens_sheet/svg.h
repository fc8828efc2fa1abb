// A drawing as SVG text, built piece by piece.
//
// Coordinates are px of the drawing, y down. Colours, widths and fonts come from the page's style sheet by
// class (style.cpp), so that one drawing serves light, dark and paper. Places that are not finite are never
// written.
#pragma once

#include "kernel/model/coverage.h"

#include <span>
#include <string>
#include <vector>

namespace petzval::lens_sheet {

using kernel::Point;

// A number with that many decimals, without trailing zeros and "-0"; "–" if it is not finite.
std::string number(double value, int decimals);
// With so many significant digits, as people write them: 0.0123, 45.7, 1230.
std::string significant(double value, int digits = 3);
// Text for HTML and SVG: < > & " as entities, control characters as spaces, signs of numbers as minus signs.
std::string escaped(const std::string& text);

enum class Anchor { Start, Middle, End };

class Svg {
public:
    // `name` is read out to those who cannot see the drawing.
    Svg(double width, double height, const std::string& name);

    Svg& line(Point from, Point to, const std::string& classes);
    Svg& rect(Point corner, double width, double height, const std::string& classes);
    Svg& circle(Point middle, double radius, const std::string& classes);
    // Open lines break where a point is not finite; closed ones leave such points out.
    Svg& path(std::span<const Point> points, const std::string& classes, bool closed = false);
    // Many dots of one class, as wide as its stroke.
    Svg& dots(std::span<const Point> places, const std::string& classes);
    Svg& text(Point at, const std::string& words, const std::string& classes, Anchor anchor = Anchor::Start);
    // The same, reading upwards.
    Svg& upward_text(Point at, const std::string& words, const std::string& classes);
    // A picture in a data: URI.
    Svg& image(Point corner, double width, double height, const std::string& uri);
    // Everything until close() is cut at the rectangle.
    Svg& open_window(Point corner, double width, double height);
    Svg& close_window();
    // Colours until close() add up like light.
    Svg& open_light();
    Svg& close_light();
    // Another drawing, its corner here.
    Svg& place(Point corner, const std::string& drawing);
    // A line with a separate colour, "rgb(…)", inside open_light().
    Svg& ray(Point from, Point to, const std::string& colour, double width, double opacity);

    std::string str() const { return text_ + "</svg>\n"; }

private:
    Svg& add(const std::string& piece) {
        text_ += piece;
        return *this;
    }
    std::string text_;
};

}  // namespace petzval::lens_sheet
