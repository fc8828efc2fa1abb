// Lights in CSV files. Lights by depth are written again and read again as the same lights.
#include "petzval/shot.h"

#include "fuzz/held_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const petzval::Rect window{0, 0, 64, 36};
    const auto read = petzval::read_lights(petzval::fuzz::held_file(bytes, size, ".csv"), window);
    if (!read) petzval::fuzz::check_message(read.error().message);
    return 0;
}
