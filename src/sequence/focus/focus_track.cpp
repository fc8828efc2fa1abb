#include "petzval/focus_track.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace petzval {
namespace {

std::string number_text(double value) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(9);
    text << value;
    return text.str();
}

double dioptres(double distance_m) { return 1 / distance_m; }

double metres(double dioptres) {
    return dioptres > 0 ? 1 / dioptres : std::numeric_limits<double>::infinity();
}

std::string rounded(double value, double step) { return number_text(std::round(value / step) * step); }

// Maps frames and dioptres to the drawing, y down.
class PlotFrame {
public:
    explicit PlotFrame(std::span<const FocusKey> keys) {
        first_ = keys.front().frame, last_ = keys.back().frame;
        least_ = most_ = dioptres(keys.front().distance_m);
        for (const FocusKey& key : keys) {
            least_ = std::min(least_, dioptres(key.distance_m));
            most_ = std::max(most_, dioptres(key.distance_m));
        }
        const double room = std::max(0.08 * (most_ - least_), 0.02 * most_ + 1e-3);
        least_ = std::max(0.0, least_ - room), most_ += room;
    }
    static constexpr double kWidth = 720, kHeight = 320, kLeft = 64, kBottom = 40, kMargin = 16;

    double x(double frame) const {
        return kLeft + (kWidth - kLeft - kMargin) * (frame - first_) / std::max(1, last_ - first_);
    }
    // Near is above.
    double y(double distance_m) const {
        return kHeight - kBottom -
               (kHeight - kBottom - kMargin) * (dioptres(distance_m) - least_) / (most_ - least_);
    }
    std::string at(const FocusKey& key) const {
        return rounded(x(key.frame), 0.01) + "," + rounded(y(key.distance_m), 0.01);
    }
    int first() const { return first_; }
    int last() const { return last_; }
    double nearest_m() const { return metres(most_); }
    double farthest_m() const { return metres(least_); }

private:
    int first_ = 0, last_ = 0;
    double least_ = 0, most_ = 0;  // dioptres
};

// Distances that people name, farthest first, at least 22 px from each other in the drawing.
std::vector<double> named_distances(const PlotFrame& frame) {
    std::vector<double> names;
    const auto add = [&](double distance) {
        if (distance < frame.nearest_m() || distance > frame.farthest_m()) return;
        if (names.empty() || frame.y(names.back()) - frame.y(distance) >= 22) names.push_back(distance);
    };
    add(std::numeric_limits<double>::infinity());
    for (double decade = 1e4; decade > 1e-4; decade /= 10)
        for (int tenth = 99; tenth >= 10; --tenth) add(decade * tenth / 10);
    return names;
}

std::string label(double x, double y, const char* anchor, const std::string& words) {
    return "<text x=\"" + rounded(x, 0.01) + "\" y=\"" + rounded(y, 0.01) + "\" text-anchor=\"" + anchor +
           "\">" + words + "</text>\n";
}

std::string axes(const PlotFrame& frame) {
    std::string text;
    const double right = PlotFrame::kWidth - PlotFrame::kMargin;
    for (const double distance : named_distances(frame)) {
        const double y = frame.y(distance);
        text += "<path d=\"M" + rounded(PlotFrame::kLeft, 1) + "," + rounded(y, 0.01) + "H" +
                rounded(right, 1) + "\" stroke=\"#ddd\"/>\n";
        text += label(PlotFrame::kLeft - 8, y + 4, "end",
                      std::isinf(distance) ? "infinity" : number_text(distance) + " m");
    }
    const int step = std::max(1, (frame.last() - frame.first() + 7) / 8);
    for (int shown = frame.first(); shown <= frame.last(); shown += step)
        text += label(frame.x(shown), PlotFrame::kHeight - 18, "middle", std::to_string(shown));
    return text + label((PlotFrame::kLeft + right) / 2, PlotFrame::kHeight - 2, "middle", "frame");
}

}  // namespace

Result<std::vector<FocusPick>> in_order(std::vector<FocusPick> picks) {
    std::stable_sort(picks.begin(), picks.end(),
                     [](const FocusPick& a, const FocusPick& b) { return a.frame < b.frame; });
    for (std::size_t i = 1; i < picks.size(); ++i)
        if (picks[i - 1].frame == picks[i].frame)
            return Error{ErrorCode::InvalidArgument,
                         "focus.picks: frame " + std::to_string(picks[i].frame) +
                             " twice; a pixel without a frame stands alone",
                         "focus.picks"};
    return picks;
}

PixelPosition pixel_at(std::span<const FocusPick> picks, int frame) {
    const auto next =
        std::find_if(picks.begin(), picks.end(), [&](const FocusPick& p) { return p.frame >= frame; });
    if (next == picks.end()) return picks.back().pixel;
    if (next == picks.begin()) return picks.front().pixel;
    const FocusPick &from = *(next - 1), &to = *next;
    const double share = (double(frame) - from.frame) / (double(to.frame) - from.frame);
    const auto between = [&](int a, int b) { return int(std::lround(a + share * (double(b) - a))); };
    return {between(from.pixel.x, to.pixel.x), between(from.pixel.y, to.pixel.y)};
}

std::vector<FocusKey> smoothed(std::span<const FocusKey> keys, double frames) {
    std::vector<FocusKey> smooth(keys.begin(), keys.end());
    if (!(frames > 0)) return smooth;
    for (FocusKey& key : smooth) {
        double sum = 0, weights = 0;
        for (const FocusKey& other : keys) {
            const double apart = (double(other.frame) - key.frame) / frames;
            const double weight = std::exp(-apart * apart / 2);
            sum += weight * dioptres(other.distance_m), weights += weight;
        }
        key.distance_m = metres(sum / weights);
    }
    return smooth;
}

std::string track_csv(std::span<const FocusKey> keys) {
    std::string text = "frame,focus\n";
    for (const FocusKey& key : keys)
        text += std::to_string(key.frame) + "," +
                (std::isinf(key.distance_m) ? "inf" : number_text(key.distance_m)) + "\n";
    return text;
}

std::string focus_plot(std::span<const FocusKey> measured, std::span<const FocusKey> track) {
    const PlotFrame frame(measured);
    std::string text =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number_text(PlotFrame::kWidth) + " " +
        number_text(PlotFrame::kHeight) + "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#333\">\n" +
        "<title>Focus distance over frames</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
        axes(frame);
    std::string points;
    for (const FocusKey& key : track) points += (points.empty() ? "M" : "L") + frame.at(key);
    text += "<path d=\"" + points + "\" fill=\"none\" stroke=\"#c33\" stroke-width=\"1.5\"/>\n";
    for (const FocusKey& key : measured)
        text += "<circle cx=\"" + rounded(frame.x(key.frame), 0.01) + "\" cy=\"" +
                rounded(frame.y(key.distance_m), 0.01) + "\" r=\"2\"/>\n";
    return text + "</svg>\n";
}

}  // namespace petzval
