#include "shot/following.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace petzval::shot {
namespace {

// The share of moving pixels that look alike where they land, by vectors as given and with turned signs.
// Only pixels that land within the shot by all of them count.
struct SignFit {
    static constexpr std::array<PixelMove, 4> kSigns{{{1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
    std::array<int, 4> alike{};
    int moving = 0;
};

SignFit fit_of_signs(const OtherPicture& other, std::span<const OtherPicture> all, const Shot& shot) {
    constexpr int kStep = 2;
    constexpr float kMoves = 1;  // px
    const Rect &from = other.shot->place.data_window, &to = shot.place.data_window;
    const Steps steps = steps_of(other, all);
    const View<const float> depth = shot.depth_plane();
    SignFit fit;
    for (int y = 0; y < from.height(); y += kStep)
        for (int x = 0; x < from.width(); x += kStep) {
            std::array<Landing, 4> at;
            for (std::size_t i = 0; i < at.size(); ++i) at[i] = carried(steps, x, y, to, SignFit::kSigns[i]);
            const auto is_within = [&](const Landing& l) { return lands_within(l, depth); };
            if (!std::all_of(at.begin(), at.end(), is_within)) continue;
            if (std::hypot(at[0].x - at[1].x, at[0].y - at[1].y) < 2 * kMoves) continue;
            ++fit.moving;
            for (std::size_t i = 0; i < at.size(); ++i)
                fit.alike[i] += lands_alike(*other.shot, x, y, shot, at[i]);
        }
    return fit;
}

}  // namespace

Steps steps_of(const OtherPicture& other, std::span<const OtherPicture> all) {
    Steps steps{other};
    const int away = other.frames_later;
    for (const OtherPicture& o : all)
        if (o.frames_later * std::int64_t(away) > 0 && std::abs(o.frames_later) < std::abs(away) &&
            !o.shot->motion.empty() && !o.shot->depth_plane().empty())
            steps.push_back(o);
    std::stable_sort(steps.begin(), steps.end(), [](const OtherPicture& a, const OtherPicture& b) {
        return std::abs(a.frames_later) > std::abs(b.frames_later);
    });
    return steps;
}

Landing carried(const Steps& steps, int x, int y, const Rect& to, PixelMove signs) {
    const bool back = steps.front().frames_later > 0;
    const Rect& from = steps.front().shot->place.data_window;
    double at_x = from.x0 + x + 0.5, at_y = from.y0 + y + 0.5;
    const float depth = steps.front().shot->depth_plane()(x, y);
    float seen_depth = depth;
    PixelMove move{};
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const Shot& frame = *steps[i].shot;
        const Rect& window = frame.place.data_window;
        const int u = int(std::floor(at_x)), v = int(std::floor(at_y));
        if (window.contains(u, v)) {
            const float there = frame.depth_plane()(u - window.x0, v - window.y0);
            const PixelMove own = frame.motion.at(u - window.x0, v - window.y0, back);
            const bool is_it = laws::same_surface_by_depth(kOneSurface, there, seen_depth);
            if (i == 0 || (is_it && std::isfinite(own.x))) move = own, seen_depth = there;
        }
        const int next = i + 1 < steps.size() ? steps[i + 1].frames_later : 0;
        const int frames = std::abs(steps[i].frames_later - next);
        at_x += frames * double(move.x * signs.x);
        at_y += frames * double(move.y * signs.y);
        if (!(std::abs(at_x) < 1e7 && std::abs(at_y) < 1e7)) return {};  // unknown, or no picture is so wide
    }
    return {float(at_x - to.x0), float(at_y - to.y0), depth};
}

std::string note_of_signs(const OtherPicture& other, std::span<const OtherPicture> all, const Shot& shot) {
    constexpr int kEnough = 64;      // pixels
    constexpr double kBetter = 0.2;  // share of them
    constexpr std::array kTurned{"", "the other way", "down instead of up", "left instead of right"};
    const SignFit fit = fit_of_signs(other, all, shot);
    const auto best = std::size_t(std::max_element(fit.alike.begin(), fit.alike.end()) - fit.alike.begin());
    if (fit.moving < kEnough || fit.alike[best] - fit.alike[0] < kBetter * fit.moving) return "";
    const auto share = [&](int alike) { return percent(double(alike) / fit.moving); };
    return other.shot->path + ": by its motion vectors " + share(fit.alike[0]) +
           " of moving pixels look the same, and " + share(fit.alike[best]) + " if they point " +
           kTurned[best] + "; look at read.motion.scale";
}

}  // namespace petzval::shot
