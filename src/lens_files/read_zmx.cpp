#include "lens_files/readers.h"
namespace petzval::lens_files {
Result<LensFile> read_zmx(const std::string&) { return at_line(1, "Zemax files are not read yet"); }
}  // namespace petzval::lens_files
