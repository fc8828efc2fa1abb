// Limits of this machine: bytes per second from memory and from the nearest cache, multiply-adds per second
// from registers. Small loops, on one thread and on all, timed by each thread's own clock; the hot stages of
// an engine are compared with these.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <sched.h>
#include <thread>
#include <vector>

namespace {

// A vector of floats as wide as the widest registers there are; GCC and clang split it where they are not.
using Wide [[gnu::vector_size(64)]] = float;
constexpr int kLanes = 16;
// Enough sums to hide an FMA's latency of four or five cycles on two units, and few enough to fit the
// registers.
constexpr int kSums = 12;

// The loops, compiled for each set of instructions by the functions they are inlined into.
#define PETZVAL_INLINE __attribute__((always_inline)) inline

PETZVAL_INLINE float multiply_adds(long steps, float seed) {
    Wide sum[kSums];
    for (int k = 0; k < kSums; ++k) sum[k] = Wide{} + float(k);
    const Wide factor = Wide{} + 0.999f, term = Wide{} + seed;
    for (long i = 0; i < steps; ++i)
        for (Wide& s : sum) s = s * factor + term;
    float total = 0;
    for (const Wide& s : sum)
        for (int l = 0; l < kLanes; ++l) total += s[l];
    return total;
}

// Weights times light onto sums, as the inner loop of spreading does it: 12 bytes and one multiply-add a
// float. Both arrays together fill half of a first cache of 32 KiB.
constexpr int kCached = 2048;

PETZVAL_INLINE void stamp(long steps, float seed, const float* weights, float* sums) {
    const Wide light = Wide{} + seed;
    for (long i = 0; i < steps; ++i)
        for (int k = 0; k < kCached; k += kLanes) {
            Wide weight, sum;
            std::memcpy(&weight, weights + k, sizeof weight);
            std::memcpy(&sum, sums + k, sizeof sum);
            sum += weight * light;
            std::memcpy(sums + k, &sum, sizeof sum);
        }
}

#define PETZVAL_LOOPS(Name, ...)                                                                   \
    struct Name {                                                                                  \
        __VA_ARGS__ static float multiply_adds_on(long n, float f) { return multiply_adds(n, f); } \
        __VA_ARGS__ static void stamp_on(long n, float f, const float* from, float* to) {          \
            stamp(n, f, from, to);                                                                 \
        }                                                                                          \
    };
PETZVAL_LOOPS(Plain)
#if defined(__x86_64__)
PETZVAL_LOOPS(Avx512, __attribute__((target("avx512f,fma"))))
PETZVAL_LOOPS(Avx2, __attribute__((target("avx2,fma"))))
#endif

struct Arithmetic {
    const char* name;
    float (*multiply_adds)(long, float);
    void (*stamp)(long, float, const float*, float*);
};

Arithmetic widest() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f")) return {"AVX-512", Avx512::multiply_adds_on, Avx512::stamp_on};
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return {"AVX2", Avx2::multiply_adds_on, Avx2::stamp_on};
#endif
    return {"plain", Plain::multiply_adds_on, Plain::stamp_on};
}

double thread_cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Calls of body(thread) per second by that many threads together, the best of five rounds. The CPU time of
// each thread counts: on a shared machine, elapsed time shows only how busy the others are.
double rate(int threads, const std::function<void(int)>& body) {
    double best = 0;
    for (int round = 0; round < 5; ++round) {
        std::vector<double> seconds(static_cast<std::size_t>(threads));
        std::vector<std::thread> all;
        for (int t = 0; t < threads; ++t)
            all.emplace_back([&, t] {
                const double start = thread_cpu_seconds();
                body(t);
                seconds[std::size_t(t)] = thread_cpu_seconds() - start;
            });
        for (std::thread& t : all) t.join();
        double sum = 0;
        for (const double s : seconds) sum += 1 / s;
        best = std::max(best, sum);
    }
    return best;
}

volatile float g_kept;  // so that no loop is dropped

double giga_multiply_adds(int threads) {
    constexpr long kSteps = 20'000'000;
    const Arithmetic arithmetic = widest();
    return 1e-9 * double(kSteps) * kSums * kLanes *
           rate(threads, [&](int t) { g_kept = arithmetic.multiply_adds(kSteps, float(t)); });
}

double stamp_gb_per_s(int threads) {
    constexpr long kSteps = 200'000;
    const Arithmetic arithmetic = widest();
    return 1e-9 * double(kSteps) * kCached * 3 * sizeof(float) * rate(threads, [&](int t) {
               alignas(64) float weights[kCached] = {}, sums[kCached] = {};
               arithmetic.stamp(kSteps, float(t), weights, sums);
               g_kept = sums[t];
           });
}

// 256 MiB per thread: far beyond any cache.
struct Memory {
    static constexpr std::size_t kFloats = std::size_t(64) << 20;
    static constexpr double kBytes = double(kFloats * sizeof(float));
    std::vector<std::unique_ptr<float[]>> blocks;
    explicit Memory(int threads) {
        for (int t = 0; t < threads; ++t) {
            blocks.emplace_back(new float[kFloats]);
            std::fill_n(blocks.back().get(), kFloats, float(t));
        }
    }
    double read_gb_per_s() const {
        return 1e-9 * kBytes * rate(int(blocks.size()), [&](int t) {
                   Wide sum[4] = {};
                   const float* const from = blocks[std::size_t(t)].get();
                   for (std::size_t i = 0; i < kFloats; i += std::size_t(4 * kLanes))
                       for (std::size_t k = 0; k < 4; ++k) {
                           Wide value;
                           std::memcpy(&value, from + i + k * kLanes, sizeof value);
                           sum[k] += value;
                       }
                   g_kept = sum[0][0] + sum[1][0] + sum[2][0] + sum[3][0];
               });
    }
    // Bytes read plus bytes written, one half of each block onto the other.
    double copy_gb_per_s() const {
        return 1e-9 * kBytes * rate(int(blocks.size()), [&](int t) {
                   float* const block = blocks[std::size_t(t)].get();
                   std::copy_n(block, kFloats / 2, block + kFloats / 2);
               });
    }
};

int usable_threads() {
    cpu_set_t set;
    return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

}  // namespace

int main() {
    std::printf("{\"simd\": \"%s\"", widest().name);
    const int all = usable_threads();
    for (const int threads : all > 1 ? std::vector{1, all} : std::vector{1}) {
        const Memory memory(threads);
        std::printf(
            ", \"%d\": {\"read_gb_per_s\": %.1f, \"copy_gb_per_s\": %.1f, \"stamp_gb_per_s\": %.1f, "
            "\"giga_fma_per_s\": %.1f}",
            threads, memory.read_gb_per_s(), memory.copy_gb_per_s(), stamp_gb_per_s(threads),
            giga_multiply_adds(threads));
    }
    std::printf("}\n");
}
