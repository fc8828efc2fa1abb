// Builds the kernels a lens needs for one frame and prints what that took: `./dev bench kernels`.
#include "petzval/workers.h"

#include "kernel/keep/bank.h"
#include "kernel/lenses/make_lens.h"
#include "process.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace {

using namespace petzval;
using bench::cpu_seconds;

}  // namespace

// LENS WIDTH HEIGHT LARGEST_RADIUS_PX F_NUMBER CATS_EYE THREADS
int main(int count, char** words) {
    if (count != 8) {
        std::fprintf(stderr, "usage: LENS WIDTH HEIGHT RADIUS_PX F_NUMBER CATS_EYE THREADS\n");
        return 2;
    }
    LensChoice choice;
    choice.name = words[1];
    choice.cats_eye = std::atof(words[6]);
    const int width = std::atoi(words[2]), height = std::atoi(words[3]);
    const double radius_px = std::atof(words[4]);
    const kernel::Mount mount{{50, 36, std::atof(words[5]), 2}, width, height};
    const auto begin = std::chrono::steady_clock::now();
    const double cpu_begin = cpu_seconds();
    const auto lens = kernel::make_lens(choice, mount);
    if (!lens) {
        std::fprintf(stderr, "%s\n", lens.error().message.c_str());
        return 1;
    }
    const double cpu_lens = cpu_seconds() - cpu_begin;
    const kernel::KernelBank bank(**lens,
                                  {.aspect = double(width) / height, .max_bytes = std::size_t(4) << 30});
    bank.prepare(-radius_px, radius_px, *petzval::own_workers(std::atoi(words[7])));
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("%s wall %.2f cpu %.2f lens %.2f kernels %zu MiB %.0f\n", words[1], wall,
                cpu_seconds() - cpu_begin, cpu_lens, bank.kernels_held(),
                double(bank.bytes_held()) / (1 << 20));
}
