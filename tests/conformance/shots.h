// Small pictures with given radii, and how to put them through an engine. Shared by the conformance tests.
#pragma once

#include "petzval/compare.h"
#include "petzval/defocus.h"
#include "petzval/workers.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::conformance {

// A picture with signed radii instead of depth, through the ideal lens, with known hidden layers if any.
struct Shot {
    Picture colour;
    Plane coc_px;
    DeepPicture behind;

    DefocusJob job(const std::string& engine) const {
        DefocusJob job;
        job.colour = colour;
        job.coc_px = coc_px;
        job.behind = behind.empty() ? nullptr : &behind;
        job.place = Place::whole(colour.rect());
        job.engine = engine;
        job.pupil_points = 1024;
        return job;
    }
};

inline Shot flat(int width, int height, Rgba colour, float coc_px) {
    return {Picture(width, height, colour), Plane(width, height, coc_px), {}};
}

inline void paint_noise(Picture& picture, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> value(0.1f, 0.9f);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            picture(x, y) = {value(random), value(random), value(random), 1};
}

// Hard-edged rectangles of 0.03…0.97 over each other.
inline void paint_rectangles(Picture& picture, unsigned seed) {
    std::mt19937 random(seed);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) picture(x, y) = {0.4f, 0.4f, 0.4f, 1};
    const auto up_to = [&](int n) { return int(random() % unsigned(n)); };
    for (int i = 0; i < picture.width() * picture.height() / 300; ++i) {
        const int x = up_to(picture.width()), y = up_to(picture.height());
        const Rect r = Rect{x, y, x + 4 + up_to(20), y + 4 + up_to(20)}.intersected(picture.rect());
        const auto level = [&] { return 0.03f + 0.94f * float(up_to(1000)) / 999; };
        const Rgba colour{level(), level(), level(), 1};
        for (int v = r.y0; v < r.y1; ++v)
            for (int u = r.x0; u < r.x1; ++u) picture(u, v) = colour;
    }
}

// Noise behind focus, a bar across it in front, a patch in focus and one nearly, and a bright point.
inline Shot noise_at_several_depths() {
    Shot shot = flat(150, 130, {}, 5);
    paint_noise(shot.colour, 2);
    const auto put = [&](const Rect& r, float coc_px) {
        for (int y = r.y0; y < r.y1; ++y)
            for (int x = r.x0; x < r.x1; ++x) shot.coc_px(x, y) = coc_px;
    };
    put({71, 0, 90, 130}, -17), put({0, 40, 40, 60}, 0), put({0, 80, 40, 100}, 3);
    shot.colour(95, 100) = {9000, 60, 20, 1};
    return shot;
}

// Higher than any strip, with small screens in front that hide lights.
inline Shot tall_with_screens() {
    Shot shot = flat(96, 1000, {}, 4);
    paint_rectangles(shot.colour, 8);
    std::mt19937 random(3);
    for (int i = 0; i < 40; ++i) {
        const int x = int(random() % 90), y = int(random() % 990);
        shot.colour(x, y) = {80, 60, 20, 1};
        for (int v = y; v < y + 9; ++v)
            for (int u = x; u < x + 5; ++u) shot.coc_px(u, v) = -13;
    }
    return shot;
}

// One sample behind every pixel: colour(x, y) at coc(x, y).
template <typename Colour, typename Coc>
void put_behind(Shot& shot, const Colour& colour, const Coc& coc) {
    shot.behind = DeepPicture::made_of(shot.colour.width(), shot.colour.height(),
                                       [&](int x, int y, std::vector<DeepSample>& samples) {
                                           samples.push_back({colour(x, y), coc(x, y), coc(x, y)});
                                       });
}

// Three threads also where there are fewer processors; `threads` is never more than those.
inline Workers& three_threads() {
    static const std::shared_ptr<Workers> three = own_workers(3);
    return *three;
}

// The amount that a refusal for too little memory names.
inline std::size_t named_bytes(const Error& error) {
    std::size_t amount = 0;
    for (const char* before : {"at least ", "about "})
        if (const std::size_t at = error.message.find(before); at != std::string::npos)
            amount = std::stoul(error.message.substr(at + std::string(before).size())) << 20;
    return amount;
}

inline Picture rendered(const DefocusJob& job) {
    auto report = defocus(job);
    EXPECT_TRUE(report.has_value()) << (report ? "" : report.error().message);
    if (!report) return {};
    EXPECT_EQ(report->engine, job.engine) << "another engine ran instead";
    return std::move(report->image);
}

// Light of one pixel, and the radius of the disc with its second moment (a pixel's own is 1/6 px^2).
struct Spot {
    double sum = 0, radius_px = 0;
};

inline Spot spot(const Picture& image, int at) {
    double sum = 0, moment = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            const double light = double(image(x, y).g);
            sum += light, moment += light * (std::pow(x - at, 2) + std::pow(y - at, 2));
        }
    return {sum, std::sqrt(std::max(0.0, 2 * (moment / sum - 1.0 / 6)))};
}

inline double largest_difference(const Picture& a, const Picture& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Rgba d = a.pixels()[i] - b.pixels()[i];
        for (const float v : {d.r, d.g, d.b, d.a}) largest = std::max(largest, double(std::abs(v)));
    }
    return largest;
}

// PSNR of the pixels at least `border` away from the frame.
inline double psnr_inside(const Picture& reference, const Picture& test, int border) {
    const Rect inside = reference.rect().grown(-border);
    return compare(reference.view().part(inside), test.view().part(inside))->psnr_lin;
}

}  // namespace petzval::conformance
