#include "petzval/shot_run.h"

#include <array>
#include <string>
#include <utility>

namespace petzval {
namespace {

Error refused(const std::string& field, const std::string& why) {
    return {ErrorCode::InvalidArgument, field + why, field};
}

Status contradict(bool first, const std::string& first_field, bool second, const std::string& second_field) {
    if (!first || !second) return Done{};
    return refused(first_field, " and " + second_field + " contradict each other; give one");
}

// Fields that an engine or the view does not use.
Status check_view(const ShotRunSettings& settings) {
    const std::string &engine = settings.look.engine, view = name_of(settings.view);
    const ShotSource& source = settings.source;
    if (!source.lights.empty() && engine != "sprites")
        return refused("shot.lights", " has no effect without job.engine sprites");
    if (gaussian_view(settings.view) && engine != "gaussian")
        return refused("job.view", " " + view + " is a buffer of job.engine gaussian");
    if (scatter_view(settings.view) != ScatterView::Result && engine != "scatter")
        return refused("job.view", " " + view + " shows what job.engine scatter does, not " + engine);
    const bool is_beauty = settings.view == ShotView::Beauty;
    const bool computes = is_beauty || settings.view == ShotView::Alpha;
    const std::string here = " has no effect on job.view " + view;
    if (!source.holdout.empty() && !computes) return refused("shot.holdout", here);
    if (settings.region && !is_beauty) return refused("shot.region", here);
    if (settings.overscan_px && !computes) return refused("shot.overscan_px", here);
    if (!source.mask.empty() && !computes) return refused("shot.mask", here);
    if (!source.read.layers.empty() && !is_beauty) return refused("read.layers", here);
    if (settings.missing == MissingFiles::Black && !is_beauty)
        return refused("run.missing", " black is for job.view beauty");
    return Done{};
}

// Refuses motion without neighbouring frames, and a scale without vectors.
Status check_motion_reading(const ShotRunSettings& settings) {
    const MotionReading& motion = settings.motion;
    const bool is_scaled = motion.scale_x != 1 || motion.scale_y != 1;
    if (settings.temporal == 0) {
        const char* const without = " has no effect without shot.temporal";
        if (is_scaled) return refused("read.motion.scale", without);
        const bool is_chosen = motion.from != MotionReading::From::File || !motion.layer.empty();
        return is_chosen ? Status(refused("read.motion.layer", without)) : Done{};
    }
    if (!is_scaled || motion.wanted) return Done{};
    return refused("read.motion.scale", " has no effect with read.motion.layer " + motion_word(motion));
}

// The track, and neighbouring frames.
Status check_frames(const ShotRunSettings& settings) {
    const bool racks = !settings.rack.empty();
    for (const auto& [given, field] :
         {std::pair(settings.source.camera.focus_distance_m.has_value(), "camera.focus_distance_m"),
          std::pair(settings.focus_pixel.has_value(), "focus.at"),
          std::pair(settings.focus_point.has_value(), "focus.point")})
        if (const Status one = contradict(racks, "shot.rack", given, field); !one) return one;
    if (settings.focus_speed && settings.track_file.empty() && !racks)
        return refused("shot.focus_speed", " has no effect without shot.track or shot.rack");
    if (const Status fine = check_motion_reading(settings); !fine || settings.temporal == 0) return fine;
    const ShotSource& source = settings.source;
    for (const auto& [given, other] :
         {std::pair(!source.behind.empty(), "shot.behind"), std::pair(!source.merge.empty(), "shot.merge"),
          std::pair(source.depth.kind == DepthKind::CocPx, "depth.kind coc-px"),
          std::pair(settings.look.expand_highlights, "plate.expand_highlights"),
          std::pair(settings.view == ShotView::Depth, "job.view depth")})
        if (given) return refused("shot.temporal", std::string(" cannot be used with ") + other);
    return Done{};
}

// A file with the pictures of all eyes.
Status check_all_views(const ShotRunSettings& settings, FileKind kind) {
    const ShotSource& source = settings.source;
    if (source.read.view_name != kAllViews) return Done{};
    if (kind != FileKind::Exr || settings.view != ShotView::Beauty)
        return refused("read.view_name", " all writes the picture of every view to one EXR");
    if (!source.behind.empty() || !source.holdout.empty() || !source.merge.empty() || !source.mask.empty() ||
        !source.lights.empty())
        return refused("read.view_name",
                       " all cannot be used with shot.behind, shot.holdout, shot.merge, shot.mask and "
                       "shot.lights, which are of one view");
    if (settings.region)
        return refused("shot.region", " is for one view; read.view_name all blurs every view");
    return Done{};
}

// The format of the output, and settings of display pictures.
Status check_output(const ShotRunSettings& settings) {
    const auto kind = kind_of_output(settings.output);
    if (!kind) return refused("run.output", " " + kind.error().message);
    if (const Status fine = check_all_views(settings, *kind); !fine) return fine;
    const bool is_png = *kind == FileKind::Png;
    if (settings.view == ShotView::Hidden && is_png)
        return refused("job.view", " hidden is a deep EXR; run.output " + settings.output + " is none");
    if (!settings.source.read.layers.empty() && is_png)
        return refused("read.layers", " are written to an EXR; run.output " + settings.output + " is none");
    const std::string displays =
        " applies to display pictures only: run.output FILE.png with job.view beauty";
    if (!settings.display_view.empty() && (!is_png || settings.view != ShotView::Beauty))
        return refused("ocio.view", displays);
    if (is_png && is_developed(settings.view)) return Done{};
    const DisplayChoice& display = settings.display;
    for (const auto& [field, given] :
         {std::pair("develop.exposure_stops", display.exposure_stops.has_value()),
          std::pair("develop.contrast", display.contrast.has_value()),
          std::pair("develop.tone", display.tone.has_value())})
        if (given) return refused(field, displays + " or focus");
    return Done{};
}

}  // namespace

MotionReading motion_reading(const std::string& word) {
    using From = MotionReading::From;
    if (word == "still") return {.from = From::Still};
    if (word == "estimate") return {.from = From::Flow};
    if (word == "off") return {};
    return {.wanted = true, .layer = word};
}

std::string motion_word(const MotionReading& motion) {
    if (motion.from == MotionReading::From::Still) return "still";
    if (motion.from == MotionReading::From::Flow) return "estimate";
    return motion.wanted ? motion.layer : "off";
}

Status check_display(const DisplayChoice& display, std::optional<Transfer> transfer,
                     const std::string& display_view, const std::string& display_space) {
    const bool is_shown = !display_view.empty();
    if (!display_space.empty() && !is_shown)
        return refused("ocio.working_space", " has no effect without ocio.view");
    for (const auto& [field, given] : {std::pair("develop.tone", display.tone.has_value()),
                                       std::pair("develop.contrast", display.contrast.has_value()),
                                       std::pair("read.transfer", transfer.has_value())})
        if (const Status one = contradict(is_shown, "ocio.view", given, field); !one) return one;
    return Done{};
}

Status check(const ShotSource& source, const Look& look) {
    if (look.expand_highlights && !source.behind.empty())
        return refused("plate.expand_highlights",
                       " cannot be used with shot.behind: a display picture has no clean plate");
    return Done{};
}

Status check(const ShotRunSettings& settings) {
    if (const Status fine = check(settings.source, settings.look); !fine) return fine;
    if (const Status fine = check_focus(settings.source.camera, settings.focus_pixel, settings.focus_point);
        !fine)
        return fine;
    for (const auto rules : {check_view, check_frames})
        if (const Status fine = rules(settings); !fine) return fine;
    if (!settings.output.empty())
        if (const Status fine = check_output(settings); !fine) return fine;
    return check_display(settings.display, settings.transfer, settings.display_view, settings.display_space);
}

}  // namespace petzval
