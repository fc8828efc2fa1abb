#include "shot/file_of_shot.h"

#include "petzval/depth.h"

#include <cstdio>
#include <utility>

namespace petzval::shot {
namespace {

// Steps of one code are not edges.
void join_codes(Frame& frame, const DepthSettings& settings) {
    if (!frame.deep.empty()) return;
    const float quantum = join_depth_codes(frame.depth, settings, frame.depth_is_share);
    if (!(quantum > 0)) return;
    char text[96];
    std::snprintf(text, sizeof text, "depth: stored in steps of %.4g; neighbouring steps are one surface",
                  double(quantum));
    frame.detected.emplace_back(text);
}

}  // namespace

Result<DepthReport> make_depth(Frame& frame, const DepthSettings& settings) {
    join_codes(frame, settings);
    if (settings.kind == DepthKind::CocPx) return depth_to_radii_px(frame.depth.view(), settings);
    if (frame.depth.empty()) return DepthReport{};
    auto report = depth_to_planar_metres(frame.depth.view(), frame.place, settings);
    if (!report || frame.deep.empty()) return report;
    const auto deep = deep_to_planar_metres(frame.deep, frame.place, settings);
    if (!deep) return deep.error();
    return report;
}

Result<FileOfShot> read_file(const std::string& path, const ReadOptions& read, const DepthSettings& depth) {
    auto frame = read_frame(path, read);
    if (!frame) return frame.error();
    auto report = make_depth(*frame, depth);
    if (!report)
        return Error{report.error().code, path + ": " + report.error().message, report.error().field};
    return FileOfShot{std::move(*frame), std::move(*report)};
}

DeepPicture samples_of(Frame& frame) {
    return frame.deep.empty() ? deep_from_flat(frame.colour, frame.depth) : std::move(frame.deep);
}

bool is_too_large(const Rect& r) {
    const auto size = [](int low, int high) { return double(high) - double(low); };
    return size(r.x0, r.x1) * size(r.y0, r.y1) > double(ReadOptions{}.max_pixels);
}

}  // namespace petzval::shot
