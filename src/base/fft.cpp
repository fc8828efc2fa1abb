#include "base/fft.h"

#include "base/check.h"
#include "base/fft_lanes.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace petzval {
namespace {

using Complex = std::complex<float>;

constexpr std::size_t kBlock = 8;  // complex numbers in a cache line

// Reads kLanes rows. Returns true if a number is not 0.
bool take_rows(const Complex* rows, std::size_t n, float* re, float* im) {
    bool any = false;
    for (std::size_t start = 0; start < n; start += kBlock)
        for (std::size_t l = 0; l < kLanes; ++l)
            for (std::size_t i = start; i < start + kBlock; ++i) {
                const Complex z = rows[l * n + i];
                re[i * kLanes + l] = z.real(), im[i * kLanes + l] = z.imag();
                any |= z != 0.0f;
            }
    return any;
}

void put_rows(const float* re, const float* im, std::size_t n, float scale, Complex* rows) {
    for (std::size_t start = 0; start < n; start += kBlock)
        for (std::size_t l = 0; l < kLanes; ++l)
            for (std::size_t i = start; i < start + kBlock; ++i)
                rows[l * n + i] = {scale * re[i * kLanes + l], scale * im[i * kLanes + l]};
}

}  // namespace

Fft::Fft(int n) : n_(n), swap_with_(std::size_t(n)) {
    PETZVAL_CHECK(n >= 2 && (n & (n - 1)) == 0);
    for (int k = 0; k < n / 2; ++k) {
        const double angle = 2 * std::numbers::pi * k / n;
        cos_.push_back(float(std::cos(angle)));
        sin_.push_back(float(std::sin(angle)));
    }
    for (int i = 1, reversed = 0; i < n; ++i) {
        int bit = n >> 1;
        for (; reversed & bit; bit >>= 1) reversed ^= bit;
        reversed |= bit;
        swap_with_[std::size_t(i)] = reversed;
    }
}

void Fft::transform(float* re, float* im, bool inverse) const {
    for (int i = 0; i < n_; ++i)
        if (const int j = swap_with_[std::size_t(i)]; i < j)
            for (int l = 0; l < kLanes; ++l) {
                std::swap(re[i * kLanes + l], re[j * kLanes + l]);
                std::swap(im[i * kLanes + l], im[j * kLanes + l]);
            }
    fft_stages({n_, cos_.data(), sin_.data(), inverse ? 1.0f : -1.0f}, re, im);
}

void fft_square(std::vector<std::complex<float>>& field, const Fft& fft, bool inverse, Workers& workers,
                int reach) {
    const std::size_t n = std::size_t(fft.size());
    PETZVAL_CHECK(n % kLanes == 0 && field.size() == n * n);
    const float scale = inverse ? 1.0f / float(n) : 1.0f;
    parallel_for(int(n) / kLanes, workers, [&](int group) {
        std::vector<float> re(n * kLanes), im(re.size());
        Complex* rows = field.data() + std::size_t(group) * kLanes * n;
        if (!take_rows(rows, n, re.data(), im.data())) return;
        fft.transform(re.data(), im.data(), inverse);
        put_rows(re.data(), im.data(), n, scale, rows);
    });
    parallel_for(int(n) / kLanes, workers, [&](int group) {
        const int first = group * kLanes, last = first + kLanes - 1;
        if (first > reach && int(n) - last > reach) return;
        std::vector<float> re(n * kLanes), im(re.size());
        float* columns = reinterpret_cast<float*>(field.data() + first);
        if (!take_columns(columns, n, re.data(), im.data())) return;
        fft.transform(re.data(), im.data(), inverse);
        put_columns(re.data(), im.data(), n, scale, columns);
    });
}

}  // namespace petzval
