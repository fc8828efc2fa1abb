// Fixture of the tests of the real-time pass: a session on each GPU, and measures of pictures.
#pragma once

#include "petzval/devices.h"
#include "petzval/session.h"

#include "shots.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::conformance {

// A session on each GPU that there is.
class Realtime : public testing::Test {
protected:
    void SetUp() override {
        for (const DeviceFacts& device : devices()) {
            if (device.name == "cpu" || !device.lacks.empty()) continue;
            SessionSettings settings;
            settings.device = device.name;
            sessions_.emplace_back(settings);
        }
        if (sessions_.empty()) GTEST_SKIP() << why_no_gpu();
    }
    static Picture drawn(Session& session, const Shot& shot, Quality quality = Quality::Standard) {
        DefocusJob job = shot.job("realtime");
        job.quality = quality;
        auto report = session.defocus(job);
        EXPECT_TRUE(report) << report.error().message;
        return report ? std::move(report->image) : Picture(shot.colour.width(), shot.colour.height());
    }
    std::vector<Session> sessions_;
};

inline double sum_of(const Picture& p) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += double(p.pixels()[i].g);
    return sum;
}

// Difference as a fraction of the light of b.
inline double light_apart(const Picture& a, const Picture& b) {
    double apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i) apart += double(std::abs(a.pixels()[i].g - b.pixels()[i].g));
    return apart / sum_of(b);
}

inline double rms(const Picture& a, const Picture& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Rgba d = a.pixels()[i] - b.pixels()[i];
        squares += double(d.r * d.r + d.g * d.g + d.b * d.b) / 3;
    }
    return std::sqrt(squares / double(a.size()));
}

// Light of a spot above a uniform ground, and its centroid in pixels.
struct Centroid {
    double light = 0, x = 0, y = 0;
};
inline Centroid centroid_of(const Picture& p, double ground) {
    Centroid spot;
    for (int y = 0; y < p.height(); ++y)
        for (int x = 0; x < p.width(); ++x) {
            const double more = double(p(x, y).g) - ground;
            spot.light += more, spot.x += more * x, spot.y += more * y;
        }
    spot.x /= spot.light, spot.y /= spot.light;
    return spot;
}

}  // namespace petzval::conformance
