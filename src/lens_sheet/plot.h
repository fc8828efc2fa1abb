// A chart: two axes with ticks at round numbers, units in their names, and curves.
#pragma once

#include "lens_sheet/svg.h"

#include <string>
#include <vector>

namespace petzval::lens_sheet {

struct Axis {
    double low = 0, high = 1;
    std::string name;  // with its unit: "focus shift, mm"
};

// The smallest range that holds every finite number, and 0; not narrower than `least`, with a margin.
Axis axis_around(const std::vector<std::vector<Point>>& curves, double Point::*which, const std::string& name,
                 double least);
// The same, alike on both sides of 0.
Axis symmetric(Axis axis);

// Round numbers inside an axis, about `count`.
std::vector<double> ticks(const Axis& axis, int count);

class Plot {
public:
    Plot(double width, double height, const std::string& title, Axis x, Axis y);

    Plot& curve(const std::vector<Point>& points, const std::string& classes);
    // A line across, with a word at its end.
    Plot& mark_x(double x, const std::string& word, const std::string& classes = "mark");
    Plot& mark_y(double y, const std::string& word, const std::string& classes = "mark");
    // An area between a curve and y = 0.
    Plot& area(const std::vector<Point>& points, const std::string& classes);
    // A box from y = 0 to its height.
    Plot& bar(double x, double half_width, double y, const std::string& classes);
    Plot& picture(const std::string& uri, Point low, Point high);
    Plot& word(Point at, const std::string& words, const std::string& classes, Anchor anchor = Anchor::Start);
    Svg& svg() { return svg_; }
    Point on_page(Point value) const;

    std::string str() const { return svg_.str(); }

private:
    void draw_frame(const std::string& title);

    double left_, top_, width_, height_;  // of the field inside the axes
    Axis x_, y_;
    Svg svg_;
};

}  // namespace petzval::lens_sheet
