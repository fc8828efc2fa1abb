#include "lens_sheet/plot.h"

#include <algorithm>
#include <cmath>

namespace petzval::lens_sheet {
namespace {

constexpr double kLeft = 60, kRight = 14, kTop = 30, kBottom = 42;

int decimals_for(double step) { return std::max(0, int(std::ceil(-std::log10(step) - 1e-9))); }

double tick_step(const Axis& axis, int count) {
    const double rough = (axis.high - axis.low) / count;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= 0.75 * rough) return factor * power;
    return 10 * power;
}

}  // namespace

Axis axis_around(const std::vector<std::vector<Point>>& curves, double Point::*which, const std::string& name,
                 double least) {
    Axis axis{0, 0, name};
    for (const auto& curve : curves)
        for (const Point& p : curve)
            if (std::isfinite(p.*which)) {
                axis.low = std::min(axis.low, p.*which);
                axis.high = std::max(axis.high, p.*which);
            }
    const double missing = std::max(0.0, least - (axis.high - axis.low)) / 2;
    const double margin = missing + 0.06 * (axis.high - axis.low);
    return {axis.low - margin, axis.high + margin, name};
}

Axis symmetric(Axis axis) {
    axis.high = std::max(std::abs(axis.low), std::abs(axis.high));
    axis.low = -axis.high;
    return axis;
}

std::vector<double> ticks(const Axis& axis, int count) {
    const double step = tick_step(axis, count);
    std::vector<double> values;
    for (double i = std::ceil(axis.low / step - 1e-9); i * step <= axis.high + 1e-9 * step; ++i)
        values.push_back(i * step);
    return values;
}

Plot::Plot(double width, double height, const std::string& title, Axis x, Axis y)
    : left_(kLeft),
      top_(kTop),
      width_(width - kLeft - kRight),
      height_(height - kTop - kBottom),
      x_(std::move(x)),
      y_(std::move(y)),
      svg_(width, height, title) {
    draw_frame(title);
}

Point Plot::on_page(Point v) const {
    return {left_ + (v.x - x_.low) / (x_.high - x_.low) * width_,
            top_ + (y_.high - v.y) / (y_.high - y_.low) * height_};
}

void Plot::draw_frame(const std::string& title) {
    svg_.rect({left_, top_}, width_, height_, "field");
    const int x_count = std::max(2, int(width_ / 62)), y_count = std::max(2, int(height_ / 38));
    const int x_digits = decimals_for(tick_step(x_, x_count)),
              y_digits = decimals_for(tick_step(y_, y_count));
    for (const double x : ticks(x_, x_count)) {
        const Point at = on_page({x, y_.low});
        svg_.line(at, {at.x, top_}, x == 0 ? "axis" : "grid");
        svg_.text({at.x, at.y + 14}, number(x, x_digits), "tick", Anchor::Middle);
    }
    for (const double y : ticks(y_, y_count)) {
        const Point at = on_page({x_.low, y});
        svg_.line(at, {left_ + width_, at.y}, y == 0 ? "axis" : "grid");
        svg_.text({at.x - 6, at.y + 3.5}, number(y, y_digits), "tick", Anchor::End);
    }
    svg_.text({left_, top_ - 11}, title, "title");
    svg_.text({left_ + width_ / 2, top_ + height_ + 32}, x_.name, "label", Anchor::Middle);
    svg_.upward_text({10, top_ + height_ / 2}, y_.name, "label");
}

Plot& Plot::curve(const std::vector<Point>& points, const std::string& classes) {
    std::vector<Point> drawn;
    for (const Point& p : points) drawn.push_back(on_page(p));
    svg_.open_window({left_, top_}, width_, height_).path(drawn, classes).close_window();
    return *this;
}

Plot& Plot::area(const std::vector<Point>& points, const std::string& classes) {
    std::vector<Point> drawn;
    for (const Point& p : points)
        if (std::isfinite(p.x) && std::isfinite(p.y)) drawn.push_back(p);
    if (drawn.empty()) return *this;
    drawn.push_back({drawn.back().x, 0});
    drawn.push_back({drawn.front().x, 0});
    for (Point& p : drawn) p = on_page(p);
    svg_.open_window({left_, top_}, width_, height_).path(drawn, classes, true).close_window();
    return *this;
}

Plot& Plot::mark_x(double x, const std::string& word, const std::string& classes) {
    if (!(x >= x_.low && x <= x_.high)) return *this;
    const Point at = on_page({x, y_.high});
    const bool at_right = at.x > left_ + 0.6 * width_;
    svg_.line(at, {at.x, top_ + height_}, classes);
    svg_.text({at.x + (at_right ? -4 : 4), top_ + 11}, word, "note", at_right ? Anchor::End : Anchor::Start);
    return *this;
}

Plot& Plot::mark_y(double y, const std::string& word, const std::string& classes) {
    if (!(y >= y_.low && y <= y_.high)) return *this;
    const Point at = on_page({x_.high, y});
    svg_.line({left_, at.y}, at, classes);
    svg_.text({at.x - 4, at.y - 4}, word, "note", Anchor::End);
    return *this;
}

Plot& Plot::bar(double x, double half_width, double y, const std::string& classes) {
    if (!std::isfinite(y)) return *this;
    const Point a = on_page({x - half_width, std::max(y, 0.0)}),
                b = on_page({x + half_width, std::min(y, 0.0)});
    svg_.rect(a, b.x - a.x, b.y - a.y, classes);
    return *this;
}

Plot& Plot::picture(const std::string& uri, Point low, Point high) {
    const Point a = on_page({low.x, high.y}), b = on_page({high.x, low.y});
    svg_.image(a, b.x - a.x, b.y - a.y, uri);
    return *this;
}

Plot& Plot::word(Point at, const std::string& words, const std::string& classes, Anchor anchor) {
    svg_.text(on_page(at), words, classes, anchor);
    return *this;
}

}  // namespace petzval::lens_sheet
