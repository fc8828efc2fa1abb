#include "lens_files/readers.h"
namespace petzval::lens_files {
Result<LensFile> read_seq(const std::string&) { return at_line(1, "CODE V files are not read yet"); }
}  // namespace petzval::lens_files
