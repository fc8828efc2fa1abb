// Every format of lens files.
#include "fuzz/held_file.h"
#include "lens_files/lens_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const auto read = petzval::lens_files::read_lens({reinterpret_cast<const char*>(bytes), size}, "a lens");
    if (!read) petzval::fuzz::check_message(read.error().message);
    return 0;
}
