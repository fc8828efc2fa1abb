// Headers of the files that are written.
#pragma once

#include "petzval/files.h"

#include "files/layout.h"

#include <string>
#include <vector>

#include <OpenEXR/ImfHeader.h>

namespace petzval {

Imf::Header new_header(const Place& place, const std::vector<Channel>& channels);

// The header of the colour's part with everything the input said, for flat pixels of `channels`, of which the
// first `colours` are written anew and all others copied: these must not suffer from the compression.
Imf::Header colour_header(const Imf::Header& input, const Frame& frame, const std::vector<Channel>& channels,
                          std::size_t colours);

// The header of a part that is copied as it is.
Imf::Header kept_header(const Imf::Header& input, const Frame& frame);

// Compression, attributes and camera of `options`. Errors: InvalidArgument for an unknown compression.
Status apply(const WriteOptions& options, const Rect& display_window, Imf::Header& header);

// True if decoding and encoding again changes samples. B44 packs every half channel, DWA those named like
// colour. PXR24 rounds floats to 24 bits, and a second rounding changes nothing.
bool loses_again(const std::string& compression, const Channel& channel);

Imath::Box2i box_of(const Rect& rect);

}  // namespace petzval
