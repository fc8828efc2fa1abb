#include "base/fft.h"

#include "base/check.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace petzval {

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
    const float sign = inverse ? 1.0f : -1.0f;
    for (int half = 1; half < n_; half *= 2) {
        const int step = n_ / (2 * half);
        for (int start = 0; start < n_; start += 2 * half)
            for (int k = 0; k < half; ++k) {
                const float c = cos_[std::size_t(k * step)], s = sign * sin_[std::size_t(k * step)];
                const std::ptrdiff_t a = std::ptrdiff_t(start + k) * kLanes,
                                     b = a + std::ptrdiff_t(half) * kLanes;
                float *ar = re + a, *ai = im + a, *br = re + b, *bi = im + b;
                for (int l = 0; l < kLanes; ++l) {
                    const float tr = br[l] * c - bi[l] * s, ti = br[l] * s + bi[l] * c;
                    br[l] = ar[l] - tr, bi[l] = ai[l] - ti;
                    ar[l] += tr, ai[l] += ti;
                }
            }
    }
}

void fft_square(std::vector<std::complex<float>>& field, const Fft& fft, bool inverse, Workers& workers) {
    const int n = fft.size();
    PETZVAL_CHECK(n % kLanes == 0 && field.size() == std::size_t(n) * std::size_t(n));
    const float scale = inverse ? 1.0f / float(n) : 1.0f;
    // Once along rows, once along columns; `along` and `across` are the steps in memory.
    const auto pass = [&](std::size_t along, std::size_t across) {
        parallel_for(n / kLanes, workers, [&](int group) {
            std::vector<float> re(std::size_t(n) * kLanes), im(re.size());
            std::complex<float>* first = field.data() + std::size_t(group) * kLanes * across;
            for (std::size_t i = 0; i < std::size_t(n); ++i)
                for (std::size_t l = 0; l < kLanes; ++l) {
                    re[i * kLanes + l] = first[i * along + l * across].real();
                    im[i * kLanes + l] = first[i * along + l * across].imag();
                }
            const auto is_zero = [](float v) { return v == 0; };
            if (std::all_of(re.begin(), re.end(), is_zero) && std::all_of(im.begin(), im.end(), is_zero))
                return;
            fft.transform(re.data(), im.data(), inverse);
            for (std::size_t i = 0; i < std::size_t(n); ++i)
                for (std::size_t l = 0; l < kLanes; ++l)
                    first[i * along + l * across] = {scale * re[i * kLanes + l], scale * im[i * kLanes + l]};
        });
    };
    pass(1, std::size_t(n));
    pass(std::size_t(n), 1);
}

}  // namespace petzval
