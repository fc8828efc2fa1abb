// The rules of every file that is written, and text by them (component petzval::files).
//
// A file is written beside its final name, synced and renamed: it is complete or untouched. It is never a
// device, a pipe or a link that leads nowhere; a link to a file is followed. What a process that died left
// unfinished in a folder is removed by the next one that writes there. "-.exr" and "-.png" are standard
// output.
#pragma once

#include "petzval/export.h"
#include "petzval/result.h"

#include <string>
#include <vector>

namespace petzval {

// Fails before minutes of work are spent: every folder is there and may be written, no name is a folder,
// device, pipe or a link that leads nowhere, none is that of an input, and no two are one file. Names that
// are empty are passed over; one may be standard output, "-" or "-.exr". Errors: OutputFailed,
// InvalidArgument.
PETZVAL_API Status check_outputs(const std::vector<std::string>& outputs,
                                 const std::vector<std::string>& inputs);

// overwrite: false makes a file that is there an error. Errors: OutputFailed.
PETZVAL_API Status write_text(const std::string& path, const std::string& text, bool overwrite = true);

// Removes every output of this process that is not finished; for a signal handler, which may call it at any
// time (async-signal-safe). The process must not write on afterwards.
PETZVAL_API void remove_unfinished_outputs();

}  // namespace petzval
