#include "lens_files/readers.h"
namespace petzval::lens_files {
Result<LensFile> read_optical_bench(const std::string&) {
    return at_line(1, "Optical Bench files are not read yet");
}
}  // namespace petzval::lens_files
