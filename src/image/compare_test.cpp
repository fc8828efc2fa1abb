#include "petzval/compare.h"

#include "image/srgb.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace petzval {
namespace {

Picture flat(int width, int height, float value) { return {width, height, {value, value, value, 1}}; }

// Fixed pseudo-random picture in 0…1.
Picture noise(int width, int height, unsigned seed) {
    Picture p(width, height);
    unsigned state = seed;
    const auto next = [&] { return float((state = state * 1664525u + 1013904223u) >> 8) / float(1 << 24); };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) p(x, y) = {next(), next(), next(), 1};
    return p;
}

Comparison measured(const Picture& a, const Picture& b, const CompareSettings& settings = {}) {
    return compare(a.view(), b.view(), settings).value();
}

// SSIM as the paper defines it, one window at a time in double.
double ssim_by_definition(const Picture& a, const Picture& b) {
    double sum = 0;
    int count = 0;
    for (int y = 5; y < a.height() - 5; ++y)
        for (int x = 5; x < a.width() - 5; ++x, ++count) {
            double w_sum = 0, ma = 0, mb = 0, va = 0, vb = 0, cab = 0;
            for (int pass = 0; pass < 2; ++pass)
                for (int j = -5; j <= 5; ++j)
                    for (int i = -5; i <= 5; ++i) {
                        const double w = std::exp(-(i * i + j * j) / 4.5);
                        const double la = luminance(a(x + i, y + j)), lb = luminance(b(x + i, y + j));
                        if (pass == 0) {
                            w_sum += w, ma += w * la, mb += w * lb;
                        } else {
                            const double da = la - ma / w_sum, db = lb - mb / w_sum;
                            va += w * da * da, vb += w * db * db, cab += w * da * db;
                        }
                    }
            ma /= w_sum, mb /= w_sum, va /= w_sum, vb /= w_sum, cab /= w_sum;
            sum += (2 * ma * mb + 1e-4) * (2 * cab + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
        }
    return sum / count;
}

TEST(Compare, IdenticalPicturesAreInfinitelyGood) {
    const Picture p = noise(40, 30, 1);
    const Comparison c = measured(p, p);
    EXPECT_EQ(c.psnr_lin, std::numeric_limits<double>::infinity());
    EXPECT_EQ(c.psnr_srgb, std::numeric_limits<double>::infinity());
    EXPECT_EQ(c.psnr_log, std::numeric_limits<double>::infinity());
    EXPECT_EQ(c.ssim_lin, 1);
    EXPECT_EQ(c.ssim_srgb, 1);
    EXPECT_EQ(c.max_error, 0);
    EXPECT_EQ(c.energy_ratio, 1);
}

TEST(Compare, FlatPicturesAgreeWithHandComputedValues) {
    const Comparison c = measured(flat(20, 20, 0.5f), flat(20, 20, 0.25f));
    EXPECT_NEAR(c.psnr_lin, 12.0412, 1e-4);   // -20 log10(0.25)
    EXPECT_NEAR(c.psnr_srgb, 14.0554, 1e-3);  // sRGB 0.735357 - 0.537099 = 0.198258
    // log2(1 + 0.5/0.18) = 1.917538, log2(1 + 0.25/0.18) = 1.256339, log2(1 + 64/0.18) = 8.477983: 0.077990
    EXPECT_NEAR(c.psnr_log, 22.1592, 1e-3);
    EXPECT_NEAR(c.ssim_lin, (2 * 0.5 * 0.25 + 1e-4) / (0.25 + 0.0625 + 1e-4), 1e-5);
    EXPECT_NEAR(c.max_error, 0.25, 1e-7);
    EXPECT_NEAR(c.energy_ratio, 0.5, 1e-12);
}

TEST(Compare, OneWrongPixelIsFoundAndCounted) {
    Picture p = flat(100, 50, 0.2f);
    p(70, 33).g = 0.9f;
    const Comparison c = measured(flat(100, 50, 0.2f), p);
    EXPECT_NEAR(c.psnr_lin, 10 * std::log10(3 * 5000 / 0.49), 1e-4);
    EXPECT_EQ(c.max_error_x, 70);
    EXPECT_EQ(c.max_error_y, 33);
}

TEST(Compare, WhatIsClippedDoesNotCountExceptInLogAndEnergy) {
    const Comparison c = measured(flat(16, 16, 2), flat(16, 16, 3));
    EXPECT_EQ(c.psnr_lin, std::numeric_limits<double>::infinity());
    EXPECT_LT(c.psnr_log, 40);
    EXPECT_NEAR(c.energy_ratio, 1.5, 1e-12);
    EXPECT_LT(measured(flat(16, 16, 2), flat(16, 16, 3), {.exposure = 0.25}).psnr_lin, 15);
}

TEST(Compare, SsimEqualsItsDefinition) {
    const Picture a = noise(31, 44, 3);
    Picture b = noise(31, 44, 4);
    for (int y = 0; y < 44; ++y)
        for (int x = 0; x < 31; ++x) b(x, y) = 0.3f * b(x, y) + 0.6f * a(x, y);
    EXPECT_NEAR(measured(a, b).ssim_lin, ssim_by_definition(a, b), 1e-5);
}

TEST(Compare, TheMaskSelectsPixels) {
    Picture p = flat(40, 40, 0.5f);
    p(3, 20) = {1, 1, 1, 1};
    Plane mask(40, 40, 1);
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 12; ++x) mask(x, y) = 0.5f;
    const Comparison c = measured(flat(40, 40, 0.5f), p, {.mask = mask.view()});
    EXPECT_EQ(c.psnr_lin, std::numeric_limits<double>::infinity());
    EXPECT_EQ(c.ssim_lin, 1);  // no window around a counted pixel reaches the wrong one
}

TEST(Compare, PicturesSmallerThanTheWindowAreMeasured) {
    const Comparison c = measured(flat(1, 1, 0.5f), flat(1, 1, 0.25f));
    EXPECT_NEAR(c.ssim_lin, (2 * 0.5 * 0.25 + 1e-4) / (0.25 + 0.0625 + 1e-4), 1e-5);
    EXPECT_NEAR(measured(flat(300, 3, 0.5f), flat(300, 3, 0.5f)).ssim_lin, 1, 0);
}

TEST(Compare, ANanIsTheGreatestError) {
    Picture p = flat(12, 12, 0);
    p(4, 5).r = std::nanf("");
    const Comparison c = measured(flat(12, 12, 0), p);
    EXPECT_NEAR(c.psnr_lin, 10 * std::log10(3 * 144.0), 1e-9);
    EXPECT_EQ(c.max_error, 1);
    EXPECT_TRUE(std::isfinite(c.ssim_srgb));
}

TEST(Compare, RefusesWhatCannotBeCompared) {
    const Picture p = flat(4, 4, 1), q = flat(5, 4, 1);
    const Plane narrow(3, 4, 1), nothing(4, 4, 0);
    const auto message = [](const Result<Comparison>& r) { return r ? std::string() : r.error().message; };
    EXPECT_NE(message(compare(p.view(), q.view())).find("5 x 4"), std::string::npos);
    EXPECT_NE(message(compare(p.view(), Picture().view())).find("no pixels"), std::string::npos);
    EXPECT_NE(message(compare(p.view(), p.view(), {.mask = narrow.view()})).find("mask"), std::string::npos);
    EXPECT_NE(message(compare(p.view(), p.view(), {.mask = nothing.view()})).find("mask"), std::string::npos);
    EXPECT_NE(message(compare(p.view(), p.view(), {.exposure = 0})).find("compare.exposure"),
              std::string::npos);
}

TEST(Difference, IsThatOfTheCodesAndNamesThePlaceThatDiffers) {
    const Picture a = flat(96, 48, 0.2f);
    Picture b = a.clone();
    for (int y = 16; y < 24; ++y)
        for (int x = 40; x < 48; ++x) b(x, y).g = 0.5f;
    const auto found = difference(a.view(), b.view()).value();
    const double codes = double(srgb_code(0.5f)) - double(srgb_code(0.2f));
    EXPECT_NEAR(found.error(44, 20), codes, 1e-6);
    EXPECT_EQ(found.error(39, 20), 0);
    ASSERT_EQ(found.worst.size(), 1u);
    EXPECT_EQ(found.worst[0].area, (Rect{40, 16, 48, 24}));         // squares of 8: 96 / 24 is less
    EXPECT_NEAR(found.worst[0].rms, codes / std::sqrt(3.0), 1e-6);  // one channel of three
}

TEST(Difference, PlacesDoNotTouchAndComeWorstFirst) {
    const Picture a = noise(240, 120, 1), b = noise(240, 120, 2);
    const auto found = difference(a.view(), b.view(), {}, 6).value();
    ASSERT_EQ(found.worst.size(), 6u);
    for (std::size_t i = 1; i < found.worst.size(); ++i) {
        EXPECT_LE(found.worst[i].rms, found.worst[i - 1].rms);
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_TRUE(found.worst[i].area.grown(1).intersected(found.worst[k].area).empty());
    }
    EXPECT_TRUE(difference(a.view(), a.view()).value().worst.empty());
    EXPECT_FALSE(difference(a.view(), flat(3, 3, 0).view()));
}

}  // namespace
}  // namespace petzval
