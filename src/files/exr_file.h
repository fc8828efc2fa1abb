// An EXR file that has been opened: its layout, its camera numbers, and OpenEXR's handle on its pixels.
#pragma once

#include "petzval/result.h"

#include "files/camera_dialects.h"
#include "files/exr_stream.h"
#include "files/layout.h"

#include <functional>
#include <memory>

#include <OpenEXR/ImfMultiPartInputFile.h>

namespace petzval {

struct ExrFile {
    std::shared_ptr<const InputFile> file;
    std::unique_ptr<ExrInputStream> stream;
    std::unique_ptr<Imf::MultiPartInputFile> parts;
    Layout layout;

    // Errors: InvalidFile for anything that is not a sound header.
    static Result<ExrFile> open(std::shared_ptr<const InputFile> file, std::size_t max_pixels);
    // Errors: InvalidFile if the part's table of chunks has gaps.
    Status check_complete(std::size_t part) const;
};

std::vector<NumericAttribute> numeric_attributes(const Imf::Header& header);
std::string compression_name(int compression);

// Runs `body`, turning everything OpenEXR may throw into InvalidFile for `path`.
Status guarded(const std::string& path, const std::function<Status()>& body);

// OpenEXR's thread pool is one per process and starts empty: gives it this process's threads, unless the
// program around us has set it already.
void start_exr_threads();

}  // namespace petzval
