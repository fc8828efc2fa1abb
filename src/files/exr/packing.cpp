#include "files/exr/packing.h"

#include <algorithm>
#include <libdeflate.h>
#include <new>

namespace petzval {
namespace {

// libdeflate's level 1 packs 99.5 MB of a 4K night to 32.5 MB in 0.39 s of one thread; zlib at OpenEXR's
// level: 32.1 MB in 1.36 s. ISA-L 2.30 needs 0.15 s, but packs equal bytes otherwise once in some thousand
// files.
constexpr int kLevel = 1;

struct FreeDecompressor {
    void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};

// Even bytes, then odd ones, each as its difference to the one before, plus 128; and back.
void predict(std::span<const unsigned char> from, std::span<unsigned char> to) {
    if (from.empty()) return;
    const std::size_t half = (from.size() + 1) / 2;
    const auto step = [&](std::size_t at, std::size_t before) {
        return static_cast<unsigned char>(from[at] - from[before] + 128);
    };
    to[0] = from[0];
    for (std::size_t i = 1; i < half; ++i) to[i] = step(2 * i, 2 * i - 2);
    if (half < to.size()) to[half] = step(1, 2 * half - 2);
    for (std::size_t i = 1; i < from.size() / 2; ++i) to[half + i] = step(2 * i + 1, 2 * i - 1);
}

// Computes two sums in parallel: the one of odd bytes begins with the sum of the even bytes.
void undo_predictor(std::span<const unsigned char> from, std::span<unsigned char> to) {
    const auto change = [](unsigned char byte) { return static_cast<unsigned char>(byte ^ 128); };
    const std::size_t pairs = from.size() / 2;
    const auto even = from.first(from.size() - pairs), odd = from.last(pairs);
    unsigned char even_sum = 128, odd_sum = 128;
    for (const unsigned char byte : even) odd_sum = static_cast<unsigned char>(odd_sum + change(byte));
    for (std::size_t i = 0; i < pairs; ++i) {
        to[2 * i] = even_sum = static_cast<unsigned char>(even_sum + change(even[i]));
        to[2 * i + 1] = odd_sum = static_cast<unsigned char>(odd_sum + change(odd[i]));
    }
    if (even.size() > pairs) to[2 * pairs] = static_cast<unsigned char>(even_sum + change(even.back()));
}

// Runs: n + 1 times the byte that follows; from 128 on, 256 - n bytes as they are. One cut off ends it.
std::size_t unpack_runs(std::span<const unsigned char> packed, std::span<unsigned char> to) {
    std::size_t out = 0;
    for (std::size_t at = 0; at + 1 < packed.size();) {
        const std::size_t n = packed[at++];
        const std::size_t count = n < 128 ? n + 1 : std::min(256 - n, packed.size() - at);
        if (count > to.size() - out) return to.size() + 1;
        if (n < 128)
            std::fill_n(to.begin() + std::ptrdiff_t(out), count, packed[at++]);
        else
            std::copy_n(packed.begin() + std::ptrdiff_t(at), count, to.begin() + std::ptrdiff_t(out)),
                at += count;
        out += count;
    }
    return out;
}

std::optional<std::size_t> unpack_zlib(std::span<const unsigned char> packed, std::span<unsigned char> to) {
    if (packed.empty()) return 0;
    const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(
        libdeflate_alloc_decompressor());
    if (!decompressor) throw std::bad_alloc();
    std::size_t bytes = 0;
    switch (libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), to.data(), to.size(),
                                       &bytes)) {
        case LIBDEFLATE_SUCCESS:
            return bytes;
        case LIBDEFLATE_INSUFFICIENT_SPACE:
            return to.size() + 1;
        default:
            return std::nullopt;
    }
}

}  // namespace

void FreeCompressor::operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }

std::vector<unsigned char> zipped(std::span<const unsigned char> raw, ZipBuffers& buffers) {
    if (!buffers.compressor) buffers.compressor.reset(libdeflate_alloc_compressor(kLevel));
    if (!buffers.compressor) throw std::bad_alloc();
    buffers.predicted.resize(raw.size()), buffers.packed.resize(raw.size());
    predict(raw, buffers.predicted.bytes());
    const std::size_t size = libdeflate_zlib_compress(buffers.compressor.get(), buffers.predicted.data(),
                                                      raw.size(), buffers.packed.data(), raw.size());
    const bool is_smaller = size > 0 && size < raw.size();
    const auto from = is_smaller ? std::span<const unsigned char>(buffers.packed.data(), size) : raw;
    return {from.begin(), from.end()};
}

std::optional<std::size_t> unpack(std::span<const unsigned char> packed, Imf::Compression compression,
                                  std::span<unsigned char> to, RawBytes& between) {
    if (compression == Imf::NO_COMPRESSION || packed.size() >= to.size()) {
        std::copy_n(packed.begin(), std::min(packed.size(), to.size()), to.begin());
        return packed.size();
    }
    between.resize(to.size());
    const std::optional<std::size_t> found = compression == Imf::RLE_COMPRESSION
                                                 ? unpack_runs(packed, between.bytes())
                                                 : unpack_zlib(packed, between.bytes());
    if (found == to.size()) undo_predictor(between.bytes(), to);
    return found;
}

}  // namespace petzval
