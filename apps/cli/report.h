// The --json report of a run. docs/reference/report.md describes its keys.
#pragma once

#include "petzval/camera.h"
#include "petzval/depth.h"
#include "petzval/engine_report.h"
#include "petzval/files.h"
#include "petzval/look.h"
#include "petzval/result.h"

#include <chrono>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace petzval::cli {

using Json = nlohmann::ordered_json;  // keys stay in the order in which they are set

// Seconds since its making.
class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

// schema, program, verb, and every key that a report always holds, with nothing in them yet.
Json new_report(const std::string& verb);

// JSON has no infinity; see write_report.
Json number(double value);
// Parses JSON of the library, where infinity is 1e999. Requires: it is JSON.
Json json_of(const std::string& text);
Json camera_json(const FoundCamera& camera, ImageScale image_scale);
// The look in the form of --save-look.
Json look_json(const Look& look);
Json glare_json(const Look& look);  // null where there is none
Json lens_json(const Look& look, const std::string& description);
Json part_json(const PartSummary& part);
Json depth_json(const DepthReport& depth, DepthKind kind);
Json window_json(const Rect& window);
// Adds the stages and sums of `seconds`: stages with a name, and `compute`.
void add_stages(Json& report, const std::vector<StageTime>& stages, double seconds);

// Largest resident memory of this process so far.
std::size_t peak_memory_bytes();

// Writes it to a file, or "-" for standard output. Infinite numbers are written as 1e999: valid JSON that
// readers take as infinity. Errors: OutputFailed.
// One line where `indent` is below 0.
std::string report_text(Json report, int indent = 2);
Status write_report(Json report, const std::string& path);
// Prints a verb's result as text on standard output, and as a report if --json names a file; only the report
// if that is "-". Errors: OutputFailed.
Status tell(const std::string& text, Json report, const std::string& json);

}  // namespace petzval::cli
