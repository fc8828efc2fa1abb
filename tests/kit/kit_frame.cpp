// Draws one frame by the real-time pass on the first Vulkan device and writes what a host of the shader
// kit needs to draw it as well, but the lens: FOLDER/colour.bin, radii.bin, and expected.bin, floats row by
// row; prints width, height and largest radius. Ends with 77 where no device is found. Usage: kit_frame
// FOLDER CATS_EYE.
#include "device/vulkan/driver/test_context.h"
#include "device/vulkan/realtime/realtime.h"
#include "kernel/lenses/make_lens.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

namespace {

using namespace petzval;

constexpr int kWidth = 200, kHeight = 120;  // no whole tiles
constexpr float kMostPx = 20;

// A floor that recedes through focus, bars in front of it, and lamps over the far half. On the right, more
// than 256 small lamps reach each tile, so that they are merged.
void paint(Picture& colour, Plane& radii) {
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const bool is_bar = x % 50 < 6, is_lamp = !is_bar && y < 50 && x % 29 == 11 && y % 17 == 5;
            const bool is_crowd = x >= 104, is_wide = x % 16 == 8 && y % 16 == 8;
            const bool is_spark = is_crowd && (is_wide || (x % 4 == 1 && y % 4 == 1));
            const float light = is_spark  ? (is_wide ? 90.0f : 2.0f)
                                : is_lamp ? 90.0f
                                          : 0.03f * float((x / 5 * 7 + y / 5 * 13) % (is_crowd ? 3 : 23));
            colour(x, y) = {light, 0.7f * light, is_bar ? 0.1f : 0.4f * light, 1};
            radii(x, y) = is_crowd ? (is_wide ? kMostPx : 3.0f)
                          : is_bar ? -kMostPx + 0.1f * float(y)
                                   : 0.2f * float(70 - y);
        }
}

template <typename T>
void write(const std::filesystem::path& file, const T* values, std::size_t count) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(values), std::streamsize(count * sizeof(T)));
}

}  // namespace

int main(int count, char** words) {
    if (count != 3) return 2;
    const std::filesystem::path folder = words[1];
    const auto context = device::vulkan::any_context();
    if (!context) return 77;
    Picture colour(kWidth, kHeight), out(kWidth, kHeight);
    Plane radii(kWidth, kHeight);
    paint(colour, radii);
    const kernel::Mount mount{{50, 36, 1.4, 2}, kWidth, kHeight};
    LensChoice choice;
    choice.aperture.blades = 5;
    choice.cats_eye = std::atof(words[2]);
    const auto lens = std::make_shared<const engine::RealtimeLens>(engine::realtime_lens_of_host(
        **kernel::make_lens(choice, mount), kWidth, kHeight, Quality::Standard));
    device::vulkan::RealtimeDrawer(*context).draw({colour, radii, kMostPx, 1, lens}, out, {});
    write(folder / "colour.bin", colour.pixels(), colour.size());
    write(folder / "radii.bin", radii.pixels(), radii.size());
    write(folder / "expected.bin", out.pixels(), out.size());
    std::printf("%d %d %g\n", kWidth, kHeight, double(kMostPx));
    return 0;
}
