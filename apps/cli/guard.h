// The files of this run, in one place: flags and arguments that name a file say so as they are read
// (flags.h), a verb adds those it finds by itself, and main asks before the work begins.
#pragma once

#include "petzval/run_files.h"

#include <string>
#include <vector>

namespace petzval::cli {

// Those of this process, which runs one verb.
RunFiles& run_files();

// Adds outputs whose names follow from flags, and checks all files again.
Status may_write(const std::vector<std::string>& outputs);

// Applies --no-clobber from now on.
void never_replace();
bool never_replaces();
// With --no-clobber and a file of that name: says that it is left alone.
bool is_left_alone(const std::string& path);

}  // namespace petzval::cli
