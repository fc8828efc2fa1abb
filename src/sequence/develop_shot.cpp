#include "petzval/shots/develop_shot.h"

#include "petzval/frames.h"
#include "petzval/names.h"
#include "petzval/place.h"
#include "petzval/reports/stopwatch.h"
#include "petzval/session.h"

#include "records/record_json.h"

#include <utility>

namespace petzval {
namespace {

using records::Json;

// Camera numbers that are missing are an error only where a part of the glare needs them.
Status add_glare(Shot& shot, const Lens& lens, const DevelopShot& settings) {
    Rendered taken;
    taken.place = shot.place;
    taken.camera = known_camera(shot.camera, shot.image_scale);
    Session session({.threads = settings.threads});
    auto light = session.add_light(std::move(shot.colour), taken, settings.look, {.lens = lens});
    if (!light) return light.error();
    shot.colour = std::move(*light);
    return Done{};
}

Json record_of(const Shot& shot, const DevelopShot& settings, const DevelopSettings& develop) {
    Json record = Json::parse(empty_record("develop"));
    record["input"] = settings.source.path;
    record["output"] = settings.output;
    record["detected"] = shot.detected;
    record["warnings"] = shot.warnings;
    record["non_finite"]["colour"] = shot.non_finite_colour;
    record["parameters"] = {{"exposure_stops", settings.display.exposure_stops.value_or(0)},
                            {"contrast", develop.contrast},
                            {"tone", name_of(develop.tone)},
                            {"ocio", settings.display_view},
                            {"bits", develop.bits},
                            {"dither", develop.dither}};
    record["glare"] = Json::parse(record_of_glare(settings.look));
    return record;
}

MadeWith made_with_of(const DevelopShot& settings) {
    MadeWith made;
    made.add(settings.look);
    made.add_files(files_of(settings.source));
    made.add(settings.source);
    made.add(settings.display);
    if (!settings.display_view.empty()) made.add("ocio.view", settings.display_view);
    if (!settings.display_space.empty()) made.add("ocio.working_space", settings.display_space);
    if (!settings.dither) made.add("develop.dither", "off");
    return made;
}

DevelopShot of_frame(DevelopShot settings, int frame) {
    for (std::string* path : {&settings.source.path, &settings.output}) *path = at_frame(*path, frame);
    return settings;
}

void say(const ShotRunHost& host, Say how, const std::string& line) {
    if (host.say) host.say(how, line);
}

// The frame as the display shows it; `develop` becomes what remains to be applied.
Result<Picture> shown_by(const ShotRunHost& host, Shot& shot, DevelopSettings& develop) {
    const Place& place = shot.place;
    Picture light = through_window(shot.colour, place.data_window, place.display_window, Rgba{});
    if (!host.to_display) return light;
    std::string used;
    std::vector<std::string> said;
    if (Status fine = host.to_display(light, develop, used, said); !fine) return fine.error();
    for (const std::string& line : said) say(host, Say::Warning, line);
    shot.warnings.insert(shot.warnings.end(), said.begin(), said.end());
    say(host, Say::Note, used);
    return light;
}

Result<FrameRecord> developed(const DevelopShot& settings, const Lens& lens, const ShotRunHost& host) {
    const Stopwatch total;
    const MadeWith made_with = made_with_of(settings);
    const OutputState there =
        state_of({settings.output}, files_of(settings.source), settings.existing, &made_with);
    if (there.is_kept) {
        say(host, Say::Note, there.why);
        return frame_record(records::as_text(
            Json{{"input", settings.source.path}, {"output", settings.output}, {"skipped", there.why}}));
    }
    if (!there.why.empty()) say(host, Say::Note, settings.output + ": made again: " + there.why);
    auto shot = read_shot(settings.source, {.cancelled = host.cancelled});
    if (!shot) return shot.error();
    for (const auto& line : detected_in_picture(*shot)) say(host, Say::Note, line);
    for (const auto& line : shot->warnings) say(host, Say::Warning, line);
    const double read_s = total.seconds();
    if (Status glared = add_glare(*shot, lens, settings); !glared) return glared.error();
    const double glare_s = total.seconds() - read_s;
    DevelopSettings develop = settings.display.settings(shot->code_bits, settings.transfer, settings.threads);
    develop.dither = settings.dither;
    const auto shown = shown_by(host, *shot, develop);
    if (!shown) return shown.error();
    const bool overwrite = settings.existing != ExistingOutputs::Keep;
    const Status done = write_developed(settings.output, shown->view(), develop, overwrite,
                                        shot->place.pixel_aspect, {{kMadeWith, made_with.text()}});
    if (!done) return done.error();
    say(host, Say::Note, "wrote " + settings.output);
    Json record = record_of(*shot, settings, develop);
    if (!there.why.empty()) record["made_again"] = there.why;
    record["seconds"]["read"] = read_s;
    record["seconds"]["glare"] = glare_s;
    record["seconds"]["write"] = total.seconds() - read_s - glare_s;
    record["seconds"]["total"] = total.seconds();
    record["peak_memory_bytes"] = peak_memory_bytes();
    return frame_record(records::as_text(record));
}

}  // namespace

Status check(const DevelopShot& settings) {
    const auto kind = kind_of_output(settings.output);
    if (!kind || *kind != FileKind::Png)
        return Error{ErrorCode::InvalidArgument,
                     "run.output " + settings.output + ": the name must end in .png", "run.output"};
    return check_display(settings.display, settings.transfer, settings.display_view, settings.display_space);
}

Result<FrameRecord> develop_picture(const DevelopShot& settings, const Lens& lens, const ShotRunHost& host) {
    if (const Status fine = check(settings); !fine) return fine.error();
    auto made = developed(settings, lens, host);
    if (made && made->state == FrameRecord::State::Kept)
        for (const std::string& line : damage_of_kept({settings.output})) say(host, Say::Warning, line);
    return made;
}

FrameWork work_of(const DevelopShot& settings, const Lens& lens, const ShotRunHost& host) {
    FrameWork work;
    work.input = settings.source.path;
    work.keeps_what_is_there = settings.existing != ExistingOutputs::Replace;
    work.files = [settings](int frame) -> Result<FrameWork::Files> {
        const DevelopShot of = of_frame(settings, frame);
        if (const Status fine = check(of); !fine) return fine.error();
        return FrameWork::Files{files_of(of.source), {of.output}};
    };
    work.make = [settings, lens, host](int frame, bool again) {
        DevelopShot of = of_frame(settings, frame);
        if (again) of.existing = ExistingOutputs::Replace;
        return developed(of, lens, host);
    };
    return work;
}

}  // namespace petzval
