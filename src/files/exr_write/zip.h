// Writing a part of ZIP or ZIPS chunks with libdeflate: a third of the time that OpenEXR's own zlib takes, by
// the same format.
#pragma once

#include "petzval/workers.h"

#include "files/exr_write/bands.h"

#include <cstddef>
#include <vector>

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>

namespace petzval {

// True if write_zip_file() can write the part: flat, lines in downward order, nothing subsampled. OpenEXR
// writes all others.
bool is_zip_of_lines(const Imf::Header& header, const std::vector<Channel>& channels);

// Writes a file of this one part: magic number, header, table of chunks, chunks, packed on the workers.
// Requires: is_zip_of_lines(). Throws what the stream and OpenEXR throw.
void write_zip_file(Imf::OStream& stream, const Imf::Header& header, const std::vector<Channel>& channels,
                    const FillBand& fill, Workers& workers);

}  // namespace petzval
