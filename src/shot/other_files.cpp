// Data beside a picture in separate files: more pictures of the shot, a holdout, hidden layers.
#include "shot/file_of_shot.h"
#include "shot/plate_doubt.h"
#include "shot/wording.h"

#include <algorithm>
#include <utility>

namespace petzval::shot {
namespace {

// Bytes of the data read so far.
std::size_t held_bytes(const Reading& r) {
    std::size_t bytes = r.shot.colour.size() * sizeof(Rgba) + r.plane.size() * sizeof(float);
    for (const DeepPicture* deep : {&r.shot.deep, &r.shot.behind, &r.shot.holdout}) bytes += deep->bytes();
    return bytes;
}

// Another file of the same shot. `what` names its part in messages, `field` the setting that gave it.
Result<FileOfShot> read_other(Reading& r, const std::string& what, const std::string& field,
                              const std::string& path, bool need_colour = true) {
    ReadOptions options;
    options.need_colour = need_colour;
    options.need_depth = false;  // the reader's message would ask for a depth file of the main picture
    options.workers = &r.workers;
    if (const std::size_t most = r.source.read.max_memory_bytes; most > 0)
        options.max_memory_bytes = most - std::min(most - 1, held_bytes(r));
    auto read = read_file(path, options, r.depth);
    if (!read) return read;
    if (read->frame.depth.empty() && read->frame.deep.empty())
        return Error{ErrorCode::InvalidFile,
                     field + " " + path + " has no depth; it must be a deep EXR, or an EXR with RGBA and Z"};
    const std::string from = what + ": ";
    for (const auto& line : read->frame.detected) r.shot.detected.push_back(from + line);
    for (const auto& line : read->frame.warnings) r.shot.warnings.push_back(from + line);
    for (const auto& line : read->depth.warnings) r.shot.warnings.push_back(from + line);
    return read;
}

void extend(DepthReport& report, const DepthReport& other) {
    if (other.nearest_m > 0 && (report.nearest_m == 0 || other.nearest_m < report.nearest_m))
        report.nearest_m = other.nearest_m;
    report.farthest_finite_m = std::max(report.farthest_finite_m, other.farthest_finite_m);
    report.misses += other.misses, report.non_finite += other.non_finite;
}

DeepPicture samples_of(Reading& r) {
    return r.shot.deep.empty() ? deep_from_flat(r.shot.colour, r.plane) : std::move(r.shot.deep);
}

}  // namespace

Status same_frame(const Reading& r, const Frame& other, const std::string& field) {
    const Rect& ours = r.shot.place.display_window;
    if (ours == other.place.display_window) return Done{};
    return Error{ErrorCode::InvalidFile, field + " has a display window of " +
                                             window_text(other.place.display_window) + ", but that of " +
                                             r.source.path + " is " + window_text(ours) +
                                             "; they must be the same"};
}

Rect around(const Rect& a, const Rect& b) {
    return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

// One deep picture of all files, over the union of their windows.
Status merge_files(Reading& r) {
    std::vector<DeepPicture> pictures;
    std::vector<Rect> windows{r.shot.place.data_window};
    pictures.push_back(samples_of(r));
    Rect all = r.shot.place.data_window;
    for (const std::string& path : r.source.merge) {
        auto other = read_other(r, path, "shot.merge", path);
        if (!other) return other.error();
        if (Status same = same_frame(r, other->frame, "shot.merge " + path); !same) return same;
        const Rect& window = other->frame.place.data_window;
        all = around(all, window);
        if (is_too_large(all))
            return Error{ErrorCode::InvalidFile, "shot.merge " + path +
                                                     " lies too far from the other pictures: together "
                                                     "they cover " +
                                                     window_text(all)};
        extend(r.shot.depth_report, other->depth);
        windows.push_back(window);
        pictures.push_back(shot::samples_of(other->frame));
    }
    std::vector<PlacedDeep> parts;
    for (std::size_t i = 0; i < pictures.size(); ++i) parts.push_back({&pictures[i], windows[i]});
    r.shot.deep = merge_deep(parts, all);
    r.shot.place.data_window = all;
    r.shot.has_alpha = true;
    flatten(r.shot.deep, r.shot.colour, r.plane, 0, &r.workers);
    return Done{};
}

Status read_holdout(Reading& r) {
    const std::string& path = r.source.holdout;
    auto matte = read_other(r, "holdout", "shot.holdout", path, false);
    if (!matte) return matte.error();
    if (Status same = same_frame(r, matte->frame, "shot.holdout " + path); !same) return same;
    const Rect window = matte->frame.place.data_window;
    const DeepPicture samples = shot::samples_of(matte->frame);
    r.shot.holdout = merge_deep({{&samples, window}}, r.shot.place.data_window);
    if (r.shot.holdout.empty())
        r.shot.warnings.push_back("holdout: " + path + " holds nothing inside the picture's window");
    return Done{};
}

Status read_behind(Reading& r) {
    const std::string& path = r.source.behind;
    if (!r.shot.deep.empty())
        return Error{ErrorCode::InvalidArgument,
                     "shot.behind " + path + ": " + r.source.path +
                         " is deep and holds what it hides itself; shot.merge adds another deep picture"};
    auto hidden = read_other(r, "plate", "shot.behind", path);
    if (!hidden) return hidden.error();
    if (Status same = same_frame(r, hidden->frame, "shot.behind " + path); !same) return same;
    const Rect &theirs = hidden->frame.place.data_window, &ours = r.shot.place.data_window;
    if (theirs.intersected(ours).empty())
        return Error{ErrorCode::InvalidFile, "shot.behind " + path + " covers " + window_text(theirs) +
                                                 ", but " + r.source.path + " covers " + window_text(ours) +
                                                 "; they must overlap"};
    r.shot.behind = shot::samples_of(hidden->frame);
    if (theirs != ours) {
        r.shot.behind = merge_deep({{&r.shot.behind, theirs}}, ours);
        r.shot.detected.push_back("plate: covers " + window_text(theirs) +
                                  "; only the part inside the picture's " + window_text(ours) + " is used");
    }
    if (r.depth.kind == DepthKind::CocPx || r.plane.empty()) return Done{};
    if (const std::string doubt = plate_doubt(r.shot, r.plane); !doubt.empty())
        r.shot.warnings.push_back(doubt);
    return Done{};
}

}  // namespace petzval::shot
