#include "device/vulkan/develop.h"

#include "petzval/workers.h"

#include "device/vulkan/driver/test_context.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace petzval::device::vulkan {
namespace {

constexpr int kWidth = 96, kHeight = 64;

// Light of thirty stops in every hue, with emptiness, emission without coverage, NaN and infinity.
Picture all_sorts() {
    constexpr float kInfinity = std::numeric_limits<float>::infinity(),
                    kNaN = std::numeric_limits<float>::quiet_NaN();
    Picture picture(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float light = std::exp2(30 * float(x) / kWidth - 20);
            picture(x, y) = {light, light * (1 - float(y) / kHeight), light * float(y * y % 61) / 60,
                             float(x) / (kWidth - 3)};
        }
    picture(0, 0) = {}, picture(1, 0) = {1, 1, 1, 1}, picture(2, 0) = {0.5f, 2, 8, 0};
    picture(3, 0) = {kNaN, kInfinity, -kInfinity, kNaN}, picture(4, 0) = {-1, 0.2f, 1e30f, -2};
    return picture;
}

struct Apart {
    int most = 0;
    double share = 0;
};
Apart apart(const std::vector<std::uint16_t>& a, const std::vector<std::uint16_t>& b) {
    if (a.size() != b.size()) return {1 << 16, 1};
    Apart found;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const int difference = std::abs(int(a[i]) - int(b[i]));
        found.most = std::max(found.most, difference);
        found.share += difference > 0 ? 1 / double(a.size()) : 0;
    }
    return found;
}

// On the device from the start to the end of a test.
struct OnDevice {
    std::shared_ptr<Context> context = any_context();
    std::shared_ptr<Workers> workers = own_workers(2);
    Picture light = all_sorts();

    std::vector<std::uint16_t> codes(const colour::DevelopPlan& plan) {
        DeviceCanvas canvas(*context, light.clone());
        canvas.view();
        EXPECT_NE(canvas.sent(), nullptr);
        return developed(*context, plan, canvas, *workers);
    }
};

// Every tone curve and transfer, plain with noise and with contrast without, of both depths. Apart: what a
// float rounds otherwise.
TEST(DevelopOnDevice, CodesAreTheCpusAndTwiceTheSame) {
    OnDevice device;
    if (!device.context) GTEST_SKIP() << "no Vulkan device";
    for (const ToneCurve tone : {ToneCurve::None, ToneCurve::Reinhard, ToneCurve::Filmic})
        for (const Transfer transfer :
             {Transfer::Srgb, Transfer::Gamma22, Transfer::Gamma20, Transfer::Linear})
            for (const bool plain : {true, false})
                for (const int bits : {8, 16}) {
                    const colour::DevelopPlan plan{{.exposure_stops = plain ? 0 : -1.3,
                                                    .contrast = plain ? 1 : 1.4,
                                                    .tone = tone,
                                                    .transfer = transfer,
                                                    .dither = plain,
                                                    .bits = bits,
                                                    .alpha = true},
                                                   device.light.rect()};
                    const auto made = device.codes(plan);
                    const Apart off = apart(made, colour::develop(device.light, plan, *device.workers));
                    EXPECT_LE(off.most, bits == 8 ? 1 : 4) << int(tone) << " " << int(transfer);
                    EXPECT_LE(off.share, bits == 8 ? 0.002 : 0.05) << int(tone) << " " << int(transfer);
                    EXPECT_EQ(device.codes(plan), made) << "not twice the same";
                }
}

// Black, white and invalid light have codes that no rounding may change.
TEST(DevelopOnDevice, BlackStaysBlackAndWhiteWhite) {
    OnDevice device;
    if (!device.context) GTEST_SKIP() << "no Vulkan device";
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            device.light(x, y) = y < kHeight / 2 ? Rgba{0, -1, std::nanf(""), 0}
                                                 : Rgba{1, 7, std::numeric_limits<float>::infinity(), 1};
    for (const int bits : {8, 16}) {
        const colour::DevelopPlan plan{{.tone = ToneCurve::None, .bits = bits, .alpha = true},
                                       device.light.rect()};
        const auto codes = device.codes(plan);
        const auto middle = codes.begin() + std::ptrdiff_t(codes.size() / 2);
        EXPECT_EQ(std::count(codes.begin(), middle, 0), middle - codes.begin());
        EXPECT_EQ(std::count(middle, codes.end(), plan.largest_code()), codes.end() - middle);
    }
}

// A part is the crop of the whole where its pattern begins there; with and without coverage.
TEST(DevelopOnDevice, APartIsTheCropOfTheWhole) {
    OnDevice device;
    if (!device.context) GTEST_SKIP() << "no Vulkan device";
    const Rect part{13, 5, 60, 41};
    for (const bool alpha : {false, true}) {
        const DevelopSettings settings{.alpha = alpha};
        const std::size_t channels = alpha ? 4 : 3;
        const auto whole = device.codes({settings, device.light.rect()});
        const auto made = device.codes({settings, part, part.x0, part.y0});
        ASSERT_EQ(made.size(), std::size_t(part.width()) * std::size_t(part.height()) * channels);
        const std::size_t row = std::size_t(part.width()) * channels;
        for (int y = 0; y < part.height(); ++y) {
            const std::size_t from = std::size_t((part.y0 + y) * kWidth + part.x0) * channels;
            ASSERT_TRUE(std::equal(made.begin() + std::ptrdiff_t(std::size_t(y) * row),
                                   made.begin() + std::ptrdiff_t(std::size_t(y + 1) * row),
                                   whole.begin() + std::ptrdiff_t(from)))
                << "row " << y;
        }
    }
}

// A picture in host memory is not uploaded for its codes.
TEST(DevelopOnDevice, WhatIsAtHomeStaysThere) {
    OnDevice device;
    if (!device.context) GTEST_SKIP() << "no Vulkan device";
    DeviceCanvas canvas(*device.context, device.light.clone());
    const colour::DevelopPlan plan{{}, device.light.rect()};
    EXPECT_TRUE(developed(*device.context, plan, canvas, *device.workers).empty()) << "nothing is drawn yet";
    canvas.view();
    EXPECT_TRUE(developed(*device.context, plan, canvas, *device.workers).empty());
    canvas.sent();
    EXPECT_FALSE(developed(*device.context, plan, canvas, *device.workers).empty());
    EXPECT_NE(canvas.away(), nullptr) << "its light did not come home";
}

}  // namespace
}  // namespace petzval::device::vulkan
