// The rules for all files that are written, and a writer of text files (component petzval::files).
//
// A file is written beside its final name, synced and renamed, so it is complete or unchanged. It is
// never a device, a pipe or a dangling link; a link to a file is followed. The next process that writes
// into a folder removes unfinished files of a process that died. "-.exr" and "-.png" are standard
// output.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval {

// Checks outputs before the work begins: every folder exists and is writable, no name is a
// folder, device, pipe or dangling link, no output is an input, and no two are the same file.
// Empty names are skipped; one may be standard output, "-" or "-.exr". Errors: OutputFailed,
// InvalidArgument.
PETZVAL_API Status check_outputs(const std::vector<std::string>& outputs,
                                 const std::vector<std::string>& inputs);

// overwrite false: an existing file is an error. Errors: OutputFailed.
PETZVAL_API Status write_text(const std::string& path, const std::string& text, bool overwrite = true);

// Makes a folder with its parents, if it does not exist. Errors: OutputFailed.
PETZVAL_API Status make_folder(const std::string& folder);

// Removes all unfinished outputs of this process. Async-signal-safe, so a signal handler may call it at any
// time. The process must not write afterwards.
PETZVAL_API void remove_unfinished_outputs();

}  // namespace petzval
