// The parts of a frame's record as JSON texts (docs/reference/report.md), and lines about a camera for
// logs. Component petzval::files.
#pragma once

#include "petzval/camera.h"
#include "petzval/depth.h"
#include "petzval/engine_report.h"
#include "petzval/export.h"
#include "petzval/files.h"
#include "petzval/look.h"
#include "petzval/result.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace petzval {

// The host's name of a field; empty: unchanged.
using InWords = std::function<std::string(const std::string&)>;

// A number as JSON. NaN is null; infinity, which JSON does not have, is a text that finished_record()
// replaces.
PETZVAL_API std::string record_of_number(double value);
// JSON of the library, where infinity is 1e999, as a part of a record. Requires: it is JSON.
PETZVAL_API std::string record_of_json(const std::string& json);
// A record with every key that it always contains, all empty.
PETZVAL_API std::string empty_record(const std::string& verb);
PETZVAL_API std::string record_of_camera(const FoundCamera& camera, ImageScale image_scale);
PETZVAL_API std::string record_of_lens(const Look& look, const std::string& description);
PETZVAL_API std::string record_of_glare(const Look& look);  // null where there is none
PETZVAL_API std::string record_of_depth(const DepthReport& depth, DepthKind kind);
PETZVAL_API std::string record_of_limits(const FocusLimits& limits, double permissible_radius_px);

// The record of a run that failed, written instead of the verb's own. verb: empty if none was understood.
PETZVAL_API std::string failure_record(const std::string& verb, const Error& error, int exit_code);

// The record as it is written, ending with a line break, on one line if `indent` is below 0. Infinity is
// 1e999, valid JSON that readers take as infinity. Lines, origins and errors use the host's names.
PETZVAL_API std::string finished_record(const std::string& record, int indent, const InWords& in_words = {});

// Largest resident memory of this process so far.
PETZVAL_API std::size_t peak_memory_bytes();

// "camera: 85 mm (file: focalLength), sensor 36 mm (camera.sensor_width_mm), f/4 (…), focus 4 m (…)"
PETZVAL_API std::string camera_line(const FoundCamera& camera, ImageScale image_scale);

}  // namespace petzval
