#include "lens/on_picture.h"

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
        auto words =
            typed_words(verb, {"Camera (default: the numbers of the file)", "Focus", "Look", "Engine"}, {});
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

LensViewFile LensesOnPictureFlags::file(const InputFlags& input) const {
    LensViewFile file{.source = input.source(camera)};
    file.focus_pixel = focus.focus_at;
    file.focus_point = focus.focus_point;
    file.look = look.look();
    file.sheet.lenses = lenses;
    file.transfer = input.transfer;
    return file;
}

}  // namespace petzval::cli
