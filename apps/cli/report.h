// What was done, for programs: the --json report. Keys are described in docs/command-line.md.
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
// What the library wrote, where infinity is 1e999. Requires: it is JSON.
Json json_of(const std::string& text);
Json camera_json(const FoundCamera& camera, ImageScale image_scale);
// As --save-look writes it.
Json look_json(const Look& look);
Json glare_json(const Look& look);  // null where there is none
Json lens_json(const Look& look, const std::string& description);
Json part_json(const PartSummary& part);
Json depth_json(const DepthReport& depth, DepthKind kind);
Json window_json(const Rect& window);
// What took how long of `seconds`, as stages and in sums: those that stand under a name of their own, and
// `compute`.
void add_stages(Json& report, const std::vector<StageTime>& stages, double seconds);

// Largest resident memory of this process so far.
std::size_t peak_memory_bytes();

// Writes it to a file, or "-" for standard output. Infinite numbers are written as 1e999: valid JSON that
// readers take as infinity. Errors: OutputFailed.
// One line where `indent` is below 0.
std::string report_text(Json report, int indent = 2);
Status write_report(Json report, const std::string& path);
// What a verb found: as text on standard output, and as a report where --json names a file; the report alone
// where that is "-". Errors: OutputFailed.
Status tell(const std::string& text, Json report, const std::string& json);

}  // namespace petzval::cli
