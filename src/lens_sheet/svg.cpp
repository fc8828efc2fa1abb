#include "lens_sheet/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace petzval::lens_sheet {
namespace {

constexpr double kFarthest = 1e5;  // px; beyond it renderers lose precision

std::string attribute(const char* name, double value) {
    return std::string(" ") + name + "=\"" + number(std::clamp(value, -kFarthest, kFarthest), 2) + "\"";
}

std::string place_text(Point p) {
    return number(std::clamp(p.x, -kFarthest, kFarthest), 2) + " " +
           number(std::clamp(p.y, -kFarthest, kFarthest), 2);
}

std::string class_of(const std::string& classes) {
    return classes.empty() ? "" : " class=\"" + classes + "\"";
}

bool finite(Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }

const char* anchor_name(Anchor anchor) {
    switch (anchor) {
        case Anchor::Middle:
            return " text-anchor=\"middle\"";
        case Anchor::End:
            return " text-anchor=\"end\"";
        case Anchor::Start:
            break;
    }
    return "";
}

}  // namespace

std::string number(double value, int decimals) {
    if (!std::isfinite(value)) return "–";
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    std::string result = text.data();
    if (result.find('.') != std::string::npos) {
        while (result.back() == '0') result.pop_back();
        if (result.back() == '.') result.pop_back();
    }
    return result == "-0" ? "0" : result;
}

std::string significant(double value, int digits) {
    if (!std::isfinite(value)) return "–";
    if (value == 0) return "0";
    const int before = int(std::floor(std::log10(std::abs(value)))) + 1;
    const double step = std::pow(10.0, before - digits);
    return number(std::round(value / step) * step, std::max(0, digits - before));
}

std::string escaped(const std::string& text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        // A number's sign is a minus, not a hyphen.
        if (c == '-' && (i == 0 || text[i - 1] == ' ') && i + 1 < text.size() && text[i + 1] >= '0' &&
            text[i + 1] <= '9')
            result += "−";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '&')
            result += "&amp;";
        else if (c == '"')
            result += "&quot;";
        else
            result += static_cast<unsigned char>(c) < 32 || c == 127 ? ' ' : c;
    }
    return result;
}

Svg::Svg(double width, double height, const std::string& name) {
    text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width, 2) + " " +
            number(height, 2) + "\"" + attribute("width", width) + attribute("height", height) +
            " role=\"img\" aria-label=\"" + escaped(name) + "\">";
}

Svg& Svg::line(Point from, Point to, const std::string& classes) {
    if (!finite(from) || !finite(to)) return *this;
    return add("<path" + class_of(classes) + " d=\"M" + place_text(from) + "L" + place_text(to) + "\"/>");
}

Svg& Svg::rect(Point corner, double width, double height, const std::string& classes) {
    if (!finite(corner) || !(width >= 0) || !(height >= 0)) return *this;
    return add("<rect" + class_of(classes) + attribute("x", corner.x) + attribute("y", corner.y) +
               attribute("width", width) + attribute("height", height) + "/>");
}

Svg& Svg::circle(Point middle, double radius, const std::string& classes) {
    if (!finite(middle) || !(radius >= 0)) return *this;
    return add("<circle" + class_of(classes) + attribute("cx", middle.x) + attribute("cy", middle.y) +
               attribute("r", radius) + "/>");
}

Svg& Svg::path(std::span<const Point> points, const std::string& classes, bool closed) {
    std::string d;
    bool drawing = false;
    for (const Point& p : points) {
        if (!finite(p)) {
            drawing = drawing && closed;
            continue;
        }
        d += (drawing ? "L" : "M") + place_text(p);
        drawing = true;
    }
    if (d.empty()) return *this;
    return add("<path" + class_of(classes) + " d=\"" + d + (closed ? "Z" : "") + "\"/>");
}

Svg& Svg::dots(std::span<const Point> places, const std::string& classes) {
    std::string d;
    for (const Point& p : places)
        if (finite(p)) d += "M" + place_text(p) + "h0";
    return d.empty() ? *this : add("<path" + class_of(classes) + " d=\"" + d + "\"/>");
}

Svg& Svg::text(Point at, const std::string& words, const std::string& classes, Anchor anchor) {
    return add("<text" + class_of(classes) + attribute("x", at.x) + attribute("y", at.y) +
               anchor_name(anchor) + ">" + escaped(words) + "</text>");
}

Svg& Svg::upward_text(Point at, const std::string& words, const std::string& classes) {
    return add("<text" + class_of(classes) + " transform=\"translate(" + place_text(at) +
               ") rotate(-90)\" text-anchor=\"middle\">" + escaped(words) + "</text>");
}

Svg& Svg::image(Point corner, double width, double height, const std::string& uri) {
    return add("<image" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", width) +
               attribute("height", height) + " preserveAspectRatio=\"none\" href=\"" + uri + "\"/>");
}

Svg& Svg::open_window(Point corner, double width, double height) {
    return add("<svg" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", width) +
               attribute("height", height) + " viewBox=\"" + place_text(corner) + " " + number(width, 2) +
               " " + number(height, 2) + "\">");
}

Svg& Svg::close_window() { return add("</svg>"); }

Svg& Svg::place(Point corner, const std::string& drawing) {
    return add("<g transform=\"translate(" + place_text(corner) + ")\">" + drawing + "</g>");
}

Svg& Svg::open_light() { return add("<g class=\"light\">"); }

Svg& Svg::close_light() { return add("</g>"); }

Svg& Svg::ray(Point from, Point to, const std::string& colour, double width, double opacity) {
    if (!finite(from) || !finite(to)) return *this;
    return add("<path stroke=\"" + colour + "\"" + attribute("stroke-width", width) +
               attribute("opacity", opacity) + " d=\"M" + place_text(from) + "L" + place_text(to) + "\"/>");
}

}  // namespace petzval::lens_sheet
