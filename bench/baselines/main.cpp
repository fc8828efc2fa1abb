// petzval_bench_baselines METHOD COC.exr OUT.exr: what a published method makes of a picture. COC.exr is what
// `petzval defocus --view coc` wrote of it, the picture still in it. Prints seconds as JSON; without words,
// the names of the methods.
#include "petzval/files.h"

#include "baselines/baseline.h"
#include "process.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using namespace petzval;
using bench::cpu_seconds;
using bench::fail;

struct Method {
    const char* name;
    Picture (*run)(const baselines::Input&);
};

constexpr Method kMethods[] = {
    {"gather", baselines::gather},
    {"weighted-scatter", baselines::weighted_scatter},
    {"rectangle-spreading", baselines::rectangle_spreading},
#ifdef PETZVAL_BENCH_FFT
    {"layered-fft", baselines::layered_fft},
#endif
};

}  // namespace

int main(int count, char** words) {
    if (count == 1) {
        for (const Method& method : kMethods) std::printf("%s\n", method.name);
        return 0;
    }
    if (count != 6) fail("METHOD PICTURE.exr COC.exr OUT.exr THREADS");
    ReadOptions options;
    options.depth_file = words[3];
    options.depth_channel = "coc_radius_px";
    Result<Frame> frame = read_frame(words[2], options);
    if (!frame) fail(frame.error().message);
    for (const Method& method : kMethods)
        if (method.name == std::string(words[1])) {
            const auto start = std::chrono::steady_clock::now();
            const double cpu_start = cpu_seconds();
            frame->colour = method.run({frame->colour, frame->depth, std::atoi(words[5])});
            const double wall_s =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            std::printf("{\"wall_s\": %.4f, \"cpu_s\": %.4f}\n", wall_s, cpu_seconds() - cpu_start);
            if (const Status status = write_exr(words[4], *frame); !status) fail(status.error().message);
            return 0;
        }
    fail(std::string("no method ") + words[1]);
}
