#include "save.h"

#include "petzval/display_files.h"

#include <utility>

namespace petzval::view {

Result<ShotRunSettings> settings_to_save(ShotRunSettings settings, const Choice& choice,
                                         const std::string& output) {
    const auto kind = kind_of_output(output);
    if (!kind) return kind.error();
    settings.output = output;
    settings.focus_pixel.reset();
    settings.focus_point.reset();
    settings.look = choice.look;
    const bool is_png = *kind == FileKind::Png;
    settings.display = is_png ? DisplayChoice{choice.develop.exposure_stops, choice.develop.contrast,
                                              choice.develop.tone, settings.display.bits}
                              : DisplayChoice{};
    if (!choice.ocio || !is_png)
        settings.display_view = settings.display_space = "";
    else  // the view replaces them
        settings.display.contrast.reset(), settings.display.tone.reset();
    settings.source = with_input(std::move(settings.source), choice.input);
    settings.source.camera = choice.camera;
    if (choice.camera.f_number) settings.source.camera.aperture_diameter_mm.reset();
    if (choice.frame) settings.source = at_frame(std::move(settings.source), *choice.frame);
    return settings;
}

Status save_picture(Session& session, const Setup& setup, const Choice& choice, const std::string& output) {
    const auto settings = settings_to_save(setup.run, choice, output);
    if (!settings) return settings.error();
    ShotRunHost host = setup.host;
    if (settings->display_view.empty()) host.to_display = {};
    const auto done = make_picture(session, *settings, host);
    if (done) return Done{};
    Error error = done.error();
    if (host.in_words) error.message = host.in_words(error.message);
    return error;
}

}  // namespace petzval::view
