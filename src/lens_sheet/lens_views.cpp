// One picture through several lenses.
#include "petzval/display_files.h"
#include "petzval/lens_facts.h"
#include "petzval/lens_report.h"
#include "petzval/place.h"
#include "petzval/views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace petzval {
namespace {

std::string f_number_text(double f_number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "f/%.3g", f_number);
    return text.data();
}

// Sets the f-number of the shot.
Status open_to(Shot& shot, const Lens& lens, std::optional<double> f_number,
               std::vector<std::string>& warnings) {
    const auto widest = widest_f_number(lens);
    if (!widest) return widest.error();
    if (f_number && lens.kind() == LensModelKind::Prescription && *f_number < **widest) {
        warnings.push_back("opens to " + f_number_text(**widest) + ", not to " + f_number_text(*f_number));
        f_number.reset();
    }
    if (f_number)
        shot.camera.f_number = FoundNumber{*f_number, "camera.f_number"};
    else if (*widest)
        shot.camera.f_number = FoundNumber{**widest, "the widest aperture of " + lens.name()};
    return Done{};
}

Picture cell_of(const LensView& view, double pixel_aspect, const LensViewSheet& sheet) {
    const double wide = view.light.width() * pixel_aspect;
    const int height = std::max(1, int(std::lround(sheet.cell_width_px * view.light.height() / wide)));
    Picture cell = shown(resized(view.light, sheet.cell_width_px, height), sheet.develop);
    if (sheet.captions) draw_caption(cell, view.lens + "  " + f_number_text(view.f_number));
    return cell;
}

}  // namespace

Result<LensView> through_lens(Session& session, Shot& shot, Look look, const std::string& lens,
                              std::optional<double> f_number, const Control& control) {
    look.lens.name = lens;
    const auto opened = Lens::open(look.lens);
    if (!opened) return opened.error();
    LensView view{.light = {}, .lens = lens};
    if (Status done = open_to(shot, *opened, f_number, view.warnings); !done) return done.error();
    const auto lent = rendered(shot);
    if (!lent) return lent.error();
    Control with_lens = control;
    with_lens.lens = *opened;
    auto taken = session.take(*lent, look, with_lens);
    if (!taken) return taken.error();
    view.light = through_window(taken->image, shot.place.data_window, shot.place.display_window, Rgba{});
    view.f_number = lent->camera.f_number;
    view.warnings.insert(view.warnings.end(), taken->warnings.begin(), taken->warnings.end());
    return view;
}

Result<Picture> lens_view_sheet(Session& session, Shot& shot, const Look& look, const LensViewSheet& sheet,
                                const Control& control, const std::function<void(const LensView&)>& seen) {
    if (sheet.lenses.empty()) return Error{ErrorCode::InvalidArgument, "no lens for the sheet"};
    if (sheet.cell_width_px <= 0)
        return Error{ErrorCode::InvalidArgument, "the width of a cell must be above 0"};
    const std::optional<FoundNumber> own = shot.camera.f_number;
    const double share = 1.0 / double(sheet.lenses.size());
    std::vector<Picture> cells;
    for (const std::string& lens : sheet.lenses) {
        Control part = control;
        if (control.progress)
            part.progress = [&control, share, done = double(cells.size())](double of_lens) {
                return control.progress((done + of_lens) * share);
            };
        shot.camera.f_number = own;
        auto view = through_lens(session, shot, look, lens, sheet.f_number, part);
        if (!view) return Error{view.error().code, lens + ": " + view.error().message, view.error().field};
        cells.push_back(cell_of(*view, shot.place.pixel_aspect, sheet));
        if (seen) seen(*view);
    }
    shot.camera.f_number = own;
    return contact_sheet(cells, sheet.columns);
}

Status write_lens_view_sheet(const LensViewFile& file, const Control& control,
                             const std::function<void(const std::string&)>& warn) {
    if (const Status fine = check_focus(file.source.camera, file.focus_pixel, file.focus_point); !fine)
        return fine;
    auto shot = read_shot(file.source, {.cancelled = control.cancelled});
    if (!shot) return shot.error();
    for (const std::string& line : shot->warnings) warn(line);
    if (file.focus_pixel)
        if (Status done = focus_on_pixel(*shot, *file.focus_pixel); !done) return done;
    if (file.focus_point)
        if (Status done = focus_on_point(*shot, *file.focus_point); !done) return done;
    LensViewSheet settings = file.sheet;
    const CameraChoice& user = file.source.camera;
    if (!user.wide_open && (user.f_number || user.aperture_diameter_mm) && shot->camera.f_number)
        settings.f_number = shot->camera.f_number->value;
    settings.develop = file.display.settings(shot->code_bits, file.transfer, file.threads);
    Session session({.threads = file.threads});
    const auto sheet =
        lens_view_sheet(session, *shot, file.look, settings, control, [&](const LensView& view) {
            for (const std::string& line : view.warnings) warn(view.lens + ": " + line);
        });
    if (!sheet) return sheet.error();
    const DevelopSettings shown{.tone = ToneCurve::None, .dither = false, .threads = file.threads};
    return write_developed(file.output, sheet->view(), shown, file.overwrite);
}

}  // namespace petzval
