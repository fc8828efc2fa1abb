// The --json report of a run. docs/reference/report.md describes its keys; petzval/records.h has the parts
// that every host writes.
#pragma once

#include "petzval/records.h"
#include "petzval/reports/stopwatch.h"

#include <string>

#include <nlohmann/json.hpp>

namespace petzval::cli {

using Json = nlohmann::ordered_json;  // keys stay in the order in which they are set

// schema, program, verb, and every key that a report always holds, with nothing in them yet.
Json new_report(const std::string& verb);

// Parses JSON of the library, where infinity is 1e999. Requires: it is JSON.
Json json_of(const std::string& text);
// The look in the form of --save-look.
Json look_json(const Look& look);
// The report with the seconds of the whole verb and its memory.
Json finished(Json report, const Stopwatch& watch);

// Writes it to a file, or "-" for standard output. Infinite numbers are written as 1e999: valid JSON that
// readers take as infinity. Errors: OutputFailed.
// One line where `indent` is below 0.
std::string report_text(const Json& report, int indent = 2);
Status write_report(const Json& report, const std::string& path);
// The same for a record of the library. Nothing is written if it is empty or --json names no file.
Status write_record(const std::string& record, const std::string& json);
// Prints a verb's result as text on standard output, and as a report if --json names a file; only the report
// if that is "-". Errors: OutputFailed.
Status tell(const std::string& text, const Json& report, const std::string& json);

}  // namespace petzval::cli
