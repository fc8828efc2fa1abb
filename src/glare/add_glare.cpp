// Puts the parts together: what each takes is subtracted where it was, what each throws is added.
#include "petzval/glare.h"

#include "base/parallel.h"
#include "device/device.h"
#include "glare/bloom.h"
#include "glare/ghosts.h"
#include "glare/kept_stars.h"
#include "glare/plan.h"
#include "glare/streaks.h"
#include "kernel/draw/pupil.h"
#include "kernel/lenses/opened_lens.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>

namespace petzval {
namespace {

using namespace glare;

// "glare.bloom" of "bloom (glare.bloom)"; nothing where no or several fields are named.
std::string field_in(const std::string& what) {
    const std::size_t start = what.find("glare.");
    if (start == std::string::npos || what.find("glare.", start + 1) != std::string::npos) return "";
    return what.substr(start, what.find_first_of(") ", start) - start);
}

Error refuse(const std::string& what, double got, const std::string& accepted) {
    std::ostringstream text;
    text << what << " is " << got << "; it must be " << accepted;
    return {ErrorCode::InvalidArgument, text.str(), field_in(what)};
}

Status check_amounts(const GlareSettings& s) {
    const std::pair<const char*, double> amounts[] = {{"bloom (glare.bloom)", s.bloom},
                                                      {"star (glare.star)", s.star},
                                                      {"ghosts (glare.ghosts)", s.ghosts},
                                                      {"veil (glare.veil)", s.veil}};
    double sum = 0;
    for (const auto& [name, amount] : amounts) {
        if (!(amount >= 0 && amount <= 1)) return refuse(name, amount, "0 to 1, a share of the light");
        sum += amount;
    }
    if (sum > 1)
        return refuse("the sum of glare.bloom, glare.star, glare.ghosts and glare.veil", sum, "at most 1");
    return Done{};
}

Status check(const GlareSettings& s) {
    if (const Status fine = check_amounts(s); !fine) return fine;
    const auto in = [](double x, double low, double high) { return x >= low && x <= high; };  // false for NaN
    if (!in(s.bloom_radius, 1e-4, 1))
        return refuse("glare.bloom_radius", s.bloom_radius, "0.0001 to 1 heights");
    if (!in(s.star_radius, 1e-3, 2)) return refuse("glare.star_radius", s.star_radius, "0.001 to 2 heights");
    if (!in(s.threshold, 0, 1e9)) return refuse("glare.threshold", s.threshold, "0 to 1e9");
    if (!in(s.bloom_threshold, 0, 1e9)) return refuse("glare.bloom_threshold", s.bloom_threshold, "0 to 1e9");
    if (!in(s.diffraction_px, 0, 1e6))
        return refuse("the size of diffraction", s.diffraction_px, "0 or more");
    if (!in(s.place.pixel_aspect, 0.01, 100))
        return refuse("the pixel aspect", s.place.pixel_aspect, "0.01 to 100");
    if (const Status fine = kernel::check_aperture(s.lens); !fine) return fine;
    if (s.star > 0 && s.lens.aperture.blades < 3)
        return Error{ErrorCode::InvalidArgument,
                     "a round aperture makes no star (glare.star): give lens.blades, such as lens.blades 6"};
    return Done{};
}

Result<GhostModel> ghost_model(const GlareSettings& s, double height_px, int width_px) {
    const auto lens = s.opened_lens ? Result<Lens>(*s.opened_lens) : Lens::open(s.lens);
    if (!lens) return lens.error();
    if (const optics::Prescription* surfaces = kernel::prescription_of(*lens))
        return prescription_ghosts(*surfaces, s, width_px);
    return sprite_ghosts(s.lens.aperture, height_px, s.place.pixel_aspect);
}

// All but the light of ghosts. height: of the display window, in widths of a pixel.
GlarePlan plan_of(const GlareSettings& s, double height, const Rect& picture, KeptStars& stars,
                  Workers& workers) {
    GlarePlan plan;
    plan.bloom = float(s.bloom), plan.star = float(s.star), plan.ghosts = float(s.ghosts);
    plan.veil = float(s.veil), plan.threshold = float(s.threshold);
    plan.bloom_threshold = float(s.bloom_threshold);
    const bool blooms_all = s.bloom_threshold == 0;
    plan.of_all = float(blooms_all ? s.bloom + s.veil : s.veil);
    plan.of_bloom_light = float(blooms_all ? 0 : s.bloom);
    plan.of_highlights = float(s.star + s.ghosts);
    const ApertureShape& aperture = s.lens.aperture;
    if (s.bloom > 0) plan.bloom_layers = plan_bloom(s.bloom_radius * height, s.place.pixel_aspect);
    if (s.star > 0 && s.star_quality == StarQuality::Draft)
        plan.streaks = plan_streaks(aperture, s.star_radius * height, s.place.pixel_aspect);
    if (s.star > 0 && s.star_quality == StarQuality::Final)
        plan.filter = stars.star(aperture, std::max(2.0, s.star_radius * height), s.diffraction_px,
                                 s.place.pixel_aspect, picture.width(), picture.height(), workers);
    return plan;
}

}  // namespace

namespace glare {

Status add_glare(device::Canvas& picture, const GlareSettings& settings, KeptStars& stars,
                 const device::Device& device, const device::Passed& passed) {
    GlareSettings s = settings;
    if (s.opened_lens) s.lens = s.opened_lens->choice();
    const Rect all{0, 0, picture.width(), picture.height()};
    if (all.empty()) return Error{ErrorCode::InvalidArgument, "the picture is empty"};
    if (const Status fine = check(s); !fine) return fine.error();
    if (s.bloom == 0 && s.star == 0 && s.ghosts == 0 && s.veil == 0) return Done{};
    Rect display = s.place.display_window, data = s.place.data_window;
    if (display.empty()) display = data = all;
    const double height = display.height() / s.place.pixel_aspect;  // in widths of a pixel, as radii are

    const std::shared_ptr<Workers> workers = workers_of(s.threads, s.workers);
    Picture thrown;
    if (s.ghosts > 0) {
        const auto model = ghost_model(s, height, display.width());
        if (!model) return model.error();
        const kernel::Point middle{display.x0 - data.x0 + 0.5 * display.width(),
                                   display.y0 - data.y0 + 0.5 * display.height()};
        const Picture bright = device.highlights(picture, float(s.threshold), *workers);
        thrown = ghosts_of(bright, *model, middle, *workers);
        if (passed) passed("ghosts");
    }
    GlarePlan plan = plan_of(s, height, all, stars, *workers);
    plan.ghost_light = thrown;
    if (passed && s.star > 0) passed("star's pattern");
    if (!device.add_glare(plan, picture, *workers, passed))
        return Error{ErrorCode::Unsupported, std::string(device.name()) + " cannot draw this glare"};
    return Done{};
}

}  // namespace glare
}  // namespace petzval
