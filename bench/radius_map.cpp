// petzval_bench_radius_map PICTURE.exr COC.exr MAP.exr: absolute radii as a grey picture, 1 for the largest,
// as other people's blurs take them. COC.exr is what `petzval defocus --view coc` wrote. Prints the largest
// radius, px.
#include "petzval/files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

int main(int count, char** words) {
    using namespace petzval;
    const auto fail = [](const std::string& message) {
        std::fprintf(stderr, "petzval_bench_radius_map: %s\n", message.c_str());
        return 2;
    };
    if (count != 4) return fail("PICTURE.exr COC.exr MAP.exr");
    ReadOptions options;
    options.depth_file = words[2];
    options.depth_channel = "coc_radius_px";
    Result<Frame> read = read_frame(words[1], options);
    if (!read) return fail(read.error().message);
    const Plane& radii = read->depth;
    float largest = 1e-6f;
    for (std::size_t i = 0; i < radii.size(); ++i) largest = std::max(largest, std::abs(radii.pixels()[i]));
    Frame map;
    map.place = read->place;
    map.colour = Picture(radii.width(), radii.height());
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const float share = std::abs(radii.pixels()[i]) / largest;
        map.colour.pixels()[i] = {share, share, share, 1};
    }
    WriteOptions write;
    write.type = PixelType::Float;
    if (const Status status = write_exr(words[3], map, write); !status) return fail(status.error().message);
    std::printf("%.4f\n", double(largest));
    return 0;
}
