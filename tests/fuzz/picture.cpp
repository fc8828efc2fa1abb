// EXR, PNG, JPEG and TIFF through the one door that decides by content.
#include "petzval/files.h"

#include "fuzz/held_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const std::string path = petzval::fuzz::held_file(bytes, size, ".picture");
    petzval::ReadOptions options;
    options.max_memory_bytes = std::size_t(64) << 20;
    options.max_pixels = 1 << 18;
    options.threads = 1;
    for (const auto& read : {petzval::read_frame_header, petzval::read_frame})
        if (const auto frame = read(path, options); !frame)
            petzval::fuzz::check_message(frame.error().message);
    return 0;
}
