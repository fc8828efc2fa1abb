// Packed data unpacks to the same bytes, by petzval and by OpenEXR; damaged data never writes beyond its end.
#include "files/exr/packing.h"

#include <random>

#include <gtest/gtest.h>

namespace petzval {
namespace {

using Bytes = std::vector<unsigned char>;

std::optional<std::size_t> unpack(const Bytes& packed, Imf::Compression compression, Bytes& to) {
    static RawBytes between;  // whatever was there
    return petzval::unpack(packed, compression, to, between);
}

Bytes zipped(const Bytes& raw) {
    static ZipBuffers buffers;
    return petzval::zipped(raw, buffers);
}

Bytes smooth(std::size_t size) {
    Bytes bytes(size);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<unsigned char>(i / 7 + i % 2 * 90);
    return bytes;
}

TEST(ExrPacking, ZipComesBack) {
    for (const std::size_t size : {400, 401, 65537}) {
        const Bytes raw = smooth(size), packed = zipped(raw);
        EXPECT_LT(packed.size(), size);
        Bytes back(size);
        EXPECT_EQ(unpack(packed, Imf::ZIP_COMPRESSION, back), size);
        EXPECT_EQ(back, raw);
    }
}

TEST(ExrPacking, WhatWasPackedBeforeChangesNoByte) {
    const Bytes raw = smooth(65537);
    Bytes noise(300000);
    std::mt19937 random(3);
    for (unsigned char& byte : noise) byte = static_cast<unsigned char>(random() % 200);
    ZipBuffers fresh, used;
    petzval::zipped(noise, used);
    EXPECT_EQ(petzval::zipped(raw, used), petzval::zipped(raw, fresh));
}

TEST(ExrPacking, WhatIsNotSmallerStaysAsItIs) {
    const Bytes raw{9, 3, 200, 17};
    EXPECT_EQ(zipped(raw), raw);
    Bytes back(raw.size());
    EXPECT_EQ(unpack(raw, Imf::ZIPS_COMPRESSION, back), raw.size());
    EXPECT_EQ(back, raw);
}

TEST(ExrPacking, RunsAreRunsAndBytes) {
    Bytes back(6);
    EXPECT_EQ(unpack(Bytes{1, 130, 253, 131, 128}, Imf::RLE_COMPRESSION, back), 4u) << "cut off";
    EXPECT_EQ(unpack(Bytes{100, 130}, Imf::RLE_COMPRESSION, back), 7u) << "more than fits";
    EXPECT_EQ(unpack(Bytes{}, Imf::RLE_COMPRESSION, back), 0u);
    // Five times a step of 2, then three steps as they are; of eight bytes the even ones come first.
    back.assign(8, 0);
    EXPECT_EQ(unpack(Bytes{4, 130, 253, 131, 128, 127}, Imf::RLE_COMPRESSION, back), 8u);
    EXPECT_EQ(back, (Bytes{130, 138, 132, 141, 134, 141, 136, 140}));
}

TEST(ExrPacking, DamagedStreamsStayInBounds) {
    const Bytes raw = smooth(4000), packed = zipped(raw);
    std::mt19937 random(7);
    int damaged = 0;
    for (int i = 0; i < 500; ++i) {
        Bytes broken = packed;
        broken[random() % broken.size()] ^= static_cast<unsigned char>(1 + random() % 255);
        broken.resize(broken.size() - random() % 3);
        Bytes back(raw.size());
        if (unpack(broken, Imf::ZIP_COMPRESSION, back) != raw.size())
            ++damaged;
        else
            EXPECT_EQ(back, raw) << "a bit that says nothing";
    }
    EXPECT_GT(damaged, 490) << "the checksum tells";
    Bytes less(raw.size() - 100);
    EXPECT_EQ(unpack(packed, Imf::ZIP_COMPRESSION, less), less.size() + 1);
}

}  // namespace
}  // namespace petzval
