// The source revision of the program.
#pragma once

#include <string>

namespace petzval::cli {

// " (git 1a2b3c4d)", with a + behind it where files were changed; nothing where it was built outside of git.
std::string source_revision();

}  // namespace petzval::cli
