// An EXR file that has been opened: its layout, its camera numbers, and OpenEXR's handle on its pixels.
#pragma once

#include "petzval/result.h"
#include "petzval/workers.h"

#include "files/camera_dialects.h"
#include "files/exr/stream.h"
#include "files/layout.h"

#include <cstdint>
#include <functional>
#include <memory>

#include <OpenEXR/ImfMultiPartInputFile.h>

namespace petzval {

struct ExrFile {
    std::shared_ptr<const InputFile> file;
    std::unique_ptr<ExrInputStream> stream;
    std::unique_ptr<Imf::MultiPartInputFile> parts;
    Layout layout;
    std::uint64_t headers_end = 0;  // where the tables of chunks begin, in bytes
    Workers* workers = nullptr;     // for what is done with its pixels; outlive the file

    // Errors: InvalidFile for anything that is not a sound header.
    static Result<ExrFile> open(std::shared_ptr<const InputFile> file, std::size_t max_pixels,
                                Workers& workers);
    // Errors: InvalidFile if the part's table of chunks has gaps.
    Status check_complete(std::size_t part) const;
};

std::vector<NumericAttribute> numeric_attributes(const Imf::Header& header);
std::string compression_name(int compression);

// Runs `body`, which reads `file`, turning everything OpenEXR may throw into InvalidFile. Lets Cancelled
// through. Whatever failed because the system did not read the file is ReadFailed.
Status guarded(const InputFile& file, const std::function<Status()>& body);

// Number of OpenEXR threads that may work on one file beside as many workers; 0: the calling thread reads or
// writes. OpenEXR's pool is global and starts empty: it gets as many threads as the widest workers so far,
// none for a width of 1, unless the host has set it.
int exr_threads(const Workers& workers);

}  // namespace petzval
