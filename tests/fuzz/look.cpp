// Looks as JSON and as links. A look is written again and read again as the same look.
#include "petzval/look_json.h"

#include "fuzz/held_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const auto look = petzval::look_from_json({reinterpret_cast<const char*>(bytes), size});
    if (!look) {
        petzval::fuzz::check_message(look.error().message);
        return 0;
    }
    const std::string written = petzval::look_to_json(*look);
    const auto again = petzval::look_from_json(written);
    if (!again || petzval::look_to_json(*again) != written) {
        std::fprintf(stderr, "not read again as it was written: %s\n", written.c_str());
        std::abort();
    }
    return 0;
}
