#include "petzval/pixel_view.h"

#include <cmath>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

namespace petzval {
namespace {

constexpr int kWidth = 5, kHeight = 3;

// Numbers that a half holds exactly, another one for every channel of every pixel.
Picture numbered() {
    Picture picture(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float n = float(4 * (y * kWidth + x));
            picture(x, y) = {n, n + 1, -n - 2, (n + 3) / 64};
        }
    return picture;
}

// A way to hold a picture: samples a pixel, bytes a sample, planar or interleaved, top-down or bottom-up.
struct Way {
    SampleType type;
    int channels;
    bool planar, bottom_up;
};

ColourView laid_out(const Way& way, std::vector<std::byte>& memory) {
    const std::ptrdiff_t sample = way.type == SampleType::Half ? 2 : 4, odd = 3;  // bytes between rows
    const std::ptrdiff_t pixel = way.planar ? sample : sample * way.channels, row = pixel * kWidth + odd;
    memory.assign(std::size_t(row * kHeight * (way.planar ? way.channels : 1)), std::byte(0x55));
    ColourView view{kWidth, kHeight, {}};
    for (int c = 0; c < way.channels; ++c) {
        std::byte* first = memory.data() + (way.planar ? c * row * kHeight : c * sample);
        if (way.bottom_up) first += (kHeight - 1) * row;
        view.channels[std::size_t(c)] = {way.type, first, pixel, way.bottom_up ? -row : row};
    }
    return view;
}

TEST(PixelView, ReadsBackWhatItWroteInEveryLayout) {
    const Picture picture = numbered();
    for (const SampleType type : {SampleType::Float, SampleType::Half})
        for (const int channels : {3, 4})
            for (const bool planar : {false, true})
                for (const bool bottom_up : {false, true}) {
                    std::vector<std::byte> memory;
                    const ColourView view = laid_out({type, channels, planar, bottom_up}, memory);
                    write_pixels(picture, view);
                    Picture back(kWidth, kHeight);
                    read_pixels(view, back);
                    for (int y = 0; y < kHeight; ++y)
                        for (int x = 0; x < kWidth; ++x) {
                            Rgba expected = picture(x, y);
                            if (channels == 3) expected.a = 1;
                            EXPECT_EQ(back(x, y), expected) << channels << planar << bottom_up;
                        }
                }
}

TEST(PixelView, TheTopRowIsTheFirstAlsoWhereRowsLieBottomUp) {
    std::vector<std::byte> memory;
    const ColourView view = laid_out({SampleType::Float, 4, false, true}, memory);
    write_pixels(numbered(), view);
    float last_in_memory = 0;
    std::memcpy(&last_in_memory, memory.data() + (kHeight - 1) * -view.channels[0].row_stride, sizeof(float));
    EXPECT_EQ(last_in_memory, 0);  // pixel (0, 0) has red 0
}

TEST(PixelView, LeavesTheBytesBetweenRowsAlone) {
    std::vector<std::byte> memory;
    const ColourView view = laid_out({SampleType::Half, 3, false, false}, memory);
    write_pixels(numbered(), view);
    const std::size_t row = std::size_t(view.channels[0].row_stride);
    for (std::size_t end = row; end <= memory.size(); end += row)
        for (std::size_t i = end - 3; i < end; ++i) EXPECT_EQ(memory[i], std::byte(0x55));
}

TEST(PixelView, APlaneIsReadAndWrittenByItself) {
    Plane plane(kWidth, kHeight), back(kWidth, kHeight);
    for (std::size_t i = 0; i < plane.size(); ++i) plane.pixels()[i] = float(i) - 4;
    std::vector<std::uint16_t> halves(plane.size());
    const PlaneView view{SampleType::Half, reinterpret_cast<std::byte*>(halves.data()), 2, 2 * kWidth};
    write_pixels(plane, view);
    read_pixels(view, back);
    for (std::size_t i = 0; i < plane.size(); ++i) EXPECT_EQ(back.pixels()[i], plane.pixels()[i]);
}

TEST(PixelView, EveryHalfComesBackAsItself) {
    for (unsigned bits = 0; bits < 0x10000u; ++bits) {
        const float value = from_half(std::uint16_t(bits));
        if (std::isnan(value))
            EXPECT_TRUE(std::isnan(from_half(to_half(value))));
        else
            EXPECT_EQ(to_half(value), bits) << value;
    }
}

TEST(PixelView, AFloatBecomesTheNearestHalfTiesToEven) {
    // Every float between two neighbouring halves becomes the nearer one.
    for (std::uint16_t bits = 0; bits < 0x7bffu; ++bits) {
        const float low = from_half(bits), high = from_half(std::uint16_t(bits + 1));
        const float middle = low + (high - low) / 2;  // exact: a float has 13 more bits
        EXPECT_EQ(to_half(middle), bits + (bits & 1u)) << middle;
        EXPECT_EQ(to_half(std::nextafter(middle, 0.0f)), bits) << middle;
        EXPECT_EQ(to_half(std::nextafter(middle, 1e9f)), bits + 1) << middle;
        EXPECT_EQ(to_half(-middle), (bits + (bits & 1u)) | 0x8000u);
    }
    EXPECT_EQ(to_half(65519.996f), 0x7bffu);
    EXPECT_EQ(to_half(65520), 0x7c00u);
    EXPECT_EQ(to_half(1e30f), 0x7c00u);
}

}  // namespace
}  // namespace petzval
