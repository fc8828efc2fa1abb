// Lists of frames, as a command line has them: 1001-1010x2.
#include "petzval/frames.h"

#include "fuzz/held_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const auto frames = petzval::parse_frames({reinterpret_cast<const char*>(bytes), size});
    if (!frames) petzval::fuzz::check_message(frames.error().message);
    return 0;
}
