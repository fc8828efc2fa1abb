// Frames behind the C API: whole, by stages, as codes.
#include "petzval/names.h"
#include "petzval/petzval_c.h"
#include "petzval/session.h"

#include "c/handles.h"
#include "c/lent.h"
#include "c/report_text.h"
#include "c/session_handle.h"

#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace petzval;
using petzval::c::fail;
using petzval::c::guarded;
using petzval::c::missing;
using petzval::c::refused;

Rect rect_of(const petzval_rect& r) { return {r.x0, r.y0, r.x1, r.y1}; }

Control control_of(const petzval_control* given) {
    const petzval_control c = c::taken(given);
    Control control;
    if (c.progress) control.progress = [c](double done) { return c.progress(c.host, done) != 0; };
    if (c.cancelled || c.stop)
        control.cancelled = [c] {
            return (c.stop && *c.stop != 0) || (c.cancelled && c.cancelled(c.host) != 0);
        };
    const Rect region = rect_of(c.region);
    if (!region.empty()) control.region = region;
    return control;
}

// A frame that a host asks for: compared first, read when all of it fits.
struct Asked {
    c::ComparedShot compared;
    Control control;
    Look look;
    c::TakenShot shot;

    // Errors: InvalidArgument naming the field; Unsupported for pictures that the look names by file.
    Status compare(const petzval_shot* given, const petzval_look* chosen, const petzval_control* how);
    // Errors: also those of Lens::with().
    Status read(const petzval_look* chosen);
    // The pixels that are made.
    Rect window() const {
        const Rect data = compared.place.data_window;
        return control.region ? control.region->intersected(data) : data;
    }
    Status check_out(const ColourView& out, const char* name) const;
};

Status Asked::compare(const petzval_shot* given, const petzval_look* chosen, const petzval_control* how) {
    auto fitting = c::ComparedShot::compare(given);
    if (!fitting) return fitting.error();
    compared = std::move(*fitting);
    control = control_of(how);
    if (chosen) look = chosen->look;
    return c::check_pictures(look);
}

Status Asked::check_out(const ColourView& out, const char* name) const {
    const Rect made = window();
    if (made.empty() || (out.width == made.width() && out.height == made.height())) return Done{};
    return refused(control.region
                       ? std::string(name) + " must have the size of the region's part inside the picture"
                       : std::string(name) + " and the shot's colour must have the same size");
}

Status Asked::read(const petzval_look* chosen) {
    if (const Status taken = c::TakenShot::take(compared, shot); !taken) return taken;
    // The lens that the look was given, so that nothing opens it again.
    if (!chosen || !chosen->lens) return Done{};
    auto lens = c::lens_of(*chosen);
    if (!lens) return lens.error();
    control.lens = std::move(*lens);
    return Done{};
}

// `warnings` of the shot come first.
void give(DefocusReport& frame, const std::vector<std::string>& warnings, petzval_report** report) {
    if (!report) return;
    auto made = std::make_unique<petzval_report>();
    frame.warnings.insert(frame.warnings.begin(), warnings.begin(), warnings.end());
    made->json = c::report_text(frame);
    *report = made.release();
}

petzval_status take_frame(petzval_session& session, Asked& asked, const petzval_look* look,
                          const ColourView& into, petzval_report** report) {
    for (const c::ComparedLayer& layer : asked.compared.layers)
        if (layer.out.width > 0)
            if (const Status ok = asked.check_out(layer.out, "a layer's out"); !ok) return fail(ok.error());
    if (const Status ok = asked.read(look); !ok) return fail(ok.error());
    auto frame = session.session.take(asked.shot.rendered, asked.look, asked.control);
    if (!frame) return fail(frame.error());
    give(*frame, asked.shot.warnings, report);
    write_pixels(frame->image, into);
    for (std::size_t i = 0; i < frame->layers.size(); ++i)
        if (asked.compared.layers[i].out.width > 0)
            write_pixels(frame->layers[i], asked.compared.layers[i].out);
    return PETZVAL_OK;
}

// Fields that a stage after the blur has no use for.
std::vector<std::string> passed_over(const Asked& asked) {
    std::vector<std::string> warnings;
    const auto note = [&](const char* field) {
        warnings.push_back(std::string(field) + " has no effect in a stage after the blur");
    };
    if (!asked.shot.rendered.mask.empty()) note("shot.mask");
    if (!asked.shot.rendered.layers.empty()) note("shot.layers");
    return warnings;
}

// Falloff, glare or both, of a picture that is blurred already.
petzval_status add_light(petzval_session& session, Asked& asked, const petzval_look* look,
                         const ColourView& into, petzval_report** report) {
    if (asked.control.region) return fail(refused("control.region must be empty for this stage"));
    if (const Status ok = asked.read(look); !ok) return fail(ok.error());
    // The picture itself becomes the result; the shot keeps the one that it was read into.
    Picture picture = Picture::uninitialised(into.width, into.height);
    read_pixels(asked.compared.colour, picture);
    const auto lit =
        session.session.add_light(std::move(picture), asked.shot.rendered, asked.look, asked.control);
    if (!lit) return fail(lit.error());
    write_pixels(*lit, into);
    DefocusReport told;
    told.warnings = passed_over(asked);
    give(told, asked.shot.warnings, report);
    return PETZVAL_OK;
}

petzval_status take_stage(petzval_session& session, std::string_view stage, Asked& asked,
                          const petzval_look* look, const ColourView& into, petzval_report** report) {
    const bool is_light = stage == "light";
    if (!is_light && stage != "blur" && stage != "falloff" && stage != "glare")
        return fail(refused("stage must be blur, falloff, glare, or light (falloff and glare)"));
    if (!is_light && stage != "falloff") asked.look.vignetting = false;
    if (!is_light && stage != "glare") asked.look.glare = {};
    if (stage == "blur") return take_frame(session, asked, look, into, report);
    return add_light(session, asked, look, into, report);
}

// Errors: InvalidArgument naming the field.
Result<CodesWanted> codes_wanted(const petzval_codes& c) {
    CodesWanted wanted;
    DevelopSettings& develop = wanted.develop;
    if (c.bits != 0) develop.bits = c.bits;
    if (develop.bits != 8 && develop.bits != 16) return refused("codes.bits must be 8 or 16");
    develop.exposure_stops = c.exposure_stops;
    if (c.contrast != 0) develop.contrast = c.contrast;
    develop.dither = c.no_dither == 0;
    if (c.tone) {
        const auto tone = parse<ToneCurve>(c.tone);
        if (!tone) return refused("codes.tone is " + tone.error().message);
        develop.tone = *tone;
    }
    if (c.transfer) {
        const auto transfer = parse<Transfer>(c.transfer);
        if (!transfer) return refused("codes.transfer is " + transfer.error().message);
        develop.transfer = *transfer;
    }
    wanted.window = rect_of(c.window);
    return wanted;
}

Status check_codes(const petzval_codes& c, const Rect& window) {
    if (!c.data) return refused("codes.data is null");
    if (c.width != window.width() || c.height != window.height())
        return refused("codes are " + std::to_string(c.width) + "x" + std::to_string(c.height) +
                       " and their window " + std::to_string(window.width()) + "x" +
                       std::to_string(window.height()));
    return Done{};
}

void write_codes(const std::vector<std::uint16_t>& codes, const petzval_codes& into) {
    const std::size_t row = 3 * std::size_t(into.width);
    for (int y = 0; y < into.height; ++y) {
        const std::uint16_t* from = codes.data() + row * std::size_t(y);
        auto* const to = static_cast<std::byte*>(into.data) + into.row_stride * y;
        if (into.bits == 16) {
            std::memcpy(to, from, 2 * row);
            continue;
        }
        for (std::size_t i = 0; i < row; ++i) to[i] = std::byte(from[i]);
    }
}

petzval_status take_codes(petzval_session& session, Asked& asked, const petzval_look* look,
                          const petzval_codes& into, petzval_report** report) {
    auto wanted = codes_wanted(into);
    if (!wanted) return fail(wanted.error());
    if (wanted->window.empty()) wanted->window = asked.compared.place.display_window;
    if (const Status ok = check_codes(into, wanted->window); !ok) return fail(ok.error());
    if (const Status ok = asked.read(look); !ok) return fail(ok.error());
    asked.control.codes = *wanted;
    auto frame = session.session.take(asked.shot.rendered, asked.look, asked.control);
    if (!frame) return fail(frame.error());
    if (frame->codes.empty()) return fail(PETZVAL_UNSUPPORTED, "a view of an engine has no display codes");
    give(*frame, asked.shot.warnings, report);
    write_codes(frame->codes, into);
    return PETZVAL_OK;
}

// make(asked, into): writes the frame. Everything is checked before.
template <typename Make>
petzval_status into_picture(const petzval_session* session, const petzval_shot* shot,
                            const petzval_look* look, const petzval_control* control,
                            const petzval_pixels* out, petzval_report** report, const Make& make) {
    if (report) *report = nullptr;
    if (!session) return missing("session");
    return guarded([&] {
        const auto into = c::colour_view(out, "out");
        if (!into) return fail(into.error());
        Asked asked;
        if (const Status ok = asked.compare(shot, look, control); !ok) return fail(ok.error());
        if (const Status ok = asked.check_out(*into, "out"); !ok) return fail(ok.error());
        return make(asked, *into);
    });
}

}  // namespace

petzval_status petzval_defocus(petzval_session* session, const petzval_shot* shot, const petzval_look* look,
                               const petzval_control* control, const petzval_pixels* out,
                               petzval_report** report) {
    return into_picture(session, shot, look, control, out, report, [&](Asked& asked, const ColourView& into) {
        return take_frame(*session, asked, look, into, report);
    });
}

petzval_status petzval_defocus_stage(petzval_session* session, const char* stage, const petzval_shot* shot,
                                     const petzval_look* look, const petzval_control* control,
                                     const petzval_pixels* out, petzval_report** report) {
    if (report) *report = nullptr;
    if (session && !stage) return missing("stage");
    return into_picture(session, shot, look, control, out, report, [&](Asked& asked, const ColourView& into) {
        return take_stage(*session, stage, asked, look, into, report);
    });
}

petzval_status petzval_defocus_codes(petzval_session* session, const petzval_shot* shot,
                                     const petzval_look* look, const petzval_control* control,
                                     const petzval_codes* codes, petzval_report** report) {
    if (report) *report = nullptr;
    if (!session) return missing("session");
    if (!codes) return missing("codes");
    return guarded([&] {
        Asked asked;
        if (const Status ok = asked.compare(shot, look, control); !ok) return fail(ok.error());
        return take_codes(*session, asked, look, c::taken(codes), report);
    });
}

petzval_status petzval_region_margin_px(petzval_session* session, const petzval_shot* shot,
                                        const petzval_look* look, int* margin_px) {
    if (!session) return missing("session");
    if (!margin_px) return missing("margin_px");
    return guarded([&] {
        Asked asked;
        if (const Status ok = asked.compare(shot, look, nullptr); !ok) return fail(ok.error());
        if (const Status ok = asked.read(look); !ok) return fail(ok.error());
        const auto margin = session->session.region_margin_px(asked.shot.rendered, asked.look, asked.control);
        if (!margin) return fail(margin.error());
        *margin_px = *margin;
        return PETZVAL_OK;
    });
}

const char* petzval_report_json(const petzval_report* report) { return report ? report->json.c_str() : ""; }

void petzval_report_close(petzval_report* report) { delete report; }
