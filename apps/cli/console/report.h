// The --json report of a run. docs/reference/report.md describes its keys; petzval/records.h has the parts
// that every host writes.
#pragma once

#include "petzval/records.h"

#include <string>

namespace petzval::cli {

// Writes a record of the library to a file, or "-" for standard output, in the words of flags. Nothing is
// written if it is empty or --json names no file. Errors: OutputFailed.
Status write_record(const std::string& record, const std::string& json);
// Prints a verb's result as text on standard output, and as a record if --json names a file; only the record
// if that is "-". Errors: OutputFailed.
Status tell(const std::string& text, const std::string& record, const std::string& json);

}  // namespace petzval::cli
