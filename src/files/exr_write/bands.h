// Writing one flat EXR part band by band, so that an image never exists twice in memory.
#pragma once

#include "petzval/image.h"
#include "petzval/workers.h"

#include "files/layout.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>

namespace petzval {

// Samples of one channel for the rows of a band, in the channel's own type.
struct BandChannel {
    Channel channel;
    std::vector<char> bytes;  // rows of the band without padding, subsampled rows and columns left out
    std::size_t row_bytes = 0;

    std::size_t sample_bytes() const { return channel.type == ChannelType::Half ? 2 : 4; }
    char* row(int y_in_band) { return bytes.data() + std::size_t(y_in_band) * row_bytes; }
};

// Fills all channels for rows y0 … y1 - 1 of the frame.
using FillBand = std::function<void(std::vector<BandChannel>&, int y0, int y1)>;

// Writes every row of part `part` of `output`, which must be flat. Throws what OpenEXR throws.
void write_bands(Imf::MultiPartOutputFile& output, int part, const std::vector<Channel>& channels,
                 const FillBand& fill);

// Writes a file of this one flat part. Throws what the stream and OpenEXR throw.
void write_one_part(Imf::OStream& stream, const Imf::Header& header, const std::vector<Channel>& channels,
                    const FillBand& fill, Workers& workers);

// A slice for a band whose first sample is that of pixel (x0, y0).
Imf::Slice slice_of(const BandChannel& channel, int x0, int y0);
// Prepares buffers of `width` x `rows` pixels.
void resize_band(std::vector<BandChannel>& channels, int width, int rows);
// Rows per band: few for memory, many for threads, and a multiple of the common subsampling rates.
int band_rows(const std::vector<Channel>& channels, int width, int height);

}  // namespace petzval
