#include "lens/on_picture.h"

#include "console/console.h"
#include "console/interrupt.h"
#include "console/progress.h"

#include <utility>

namespace petzval::cli {

void LensesOnPictureFlags::add_to(Verb& verb, InputFlags& input) {
    FlagGroup(verb, "Lenses")
        .value("--lenses", "LIST",
               "one picture through each of these lenses, such as doublet,tessar,my_lens.zmx; needs depth "
               "and camera numbers, as defocus does",
               parse_words, lenses);
    input.add_depth_to(verb);
    camera.add_to(verb, "file", true);
    focus.add_to(verb);
    look.add_files_to(verb);
    look.add_to(verb, {"Engine"});
}

void LensesOnPictureFlags::check(const Verb& verb, InputFlags& input) {
    if (!is_on()) {
        auto words = typed_words(
            verb, {"Camera (numbers of the file hold unless given here)", "Focus", "Look", "Engine"}, {});
        for (const auto& [given, flag] : {std::pair(!input.read.depth_file.empty(), "--depth"),
                                          {!input.read.depth_channel.empty(), "--depth-channel"},
                                          {input.depth_kind.has_value(), "--depth-kind"},
                                          {input.depth_range.has_value(), "--depth-range"},
                                          {input.unit_scale_m.has_value(), "--unit-scale"}})
            if (given) words.emplace_back(flag);
        if (!words.empty()) throw UsageError(words[0] + " has no effect without --lenses");
        input.read.need_depth = false;
        return;
    }
    input.check();
    camera.check();
    look.settle();
    if (input.depth_is_coc())
        throw UsageError("--depth-kind coc-px cannot be used with --lenses, which set the radii");
    focus.check(camera);
}

Result<Picture> LensesOnPictureFlags::make(const InputFlags& input, LensViewSheet sheet,
                                           const DisplayChoice& display, const RunFlags& run) {
    auto shot = load_shot(input.source(camera));
    if (!shot) return shot.error();
    for (const std::string& line : shot->warnings) warning(line);
    if (focus.focus_at)
        if (Status done = focus_on_pixel(*shot, *focus.focus_at); !done) return done.error();
    if (focus.focus_point)
        if (Status done = focus_on_point(*shot, *focus.focus_point); !done) return done.error();
    sheet.lenses = lenses;
    const CameraChoice choice = camera.choice();
    if (!choice.wide_open && (choice.f_number || choice.aperture_diameter_mm) && shot->camera.f_number)
        sheet.f_number = shot->camera.f_number->value;
    sheet.develop = display.settings(shot->display_referred, input.transfer, run.threads);
    Session session({.threads = run.threads});
    ProgressLine progress(run.progress, run.quiet, "sheet");
    const Control control{.progress = [&](double share) { return progress(share); },
                          .cancelled = [] { return interrupted_by() != 0; }};
    return lens_view_sheet(session, *shot, look.look(), sheet, control, [](const LensView& view) {
        for (const std::string& line : view.warnings) warning(view.lens + ": " + line);
    });
}

}  // namespace petzval::cli
