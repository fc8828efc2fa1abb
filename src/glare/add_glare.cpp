// Puts the parts together: what each takes is subtracted where it was, what each throws is added.
#include "petzval/glare.h"

#include "base/parallel.h"
#include "glare/bloom.h"
#include "glare/ghosts.h"
#include "glare/kept_stars.h"
#include "glare/light.h"
#include "glare/streaks.h"
#include "kernel/draw/pupil.h"
#include "kernel/lenses/opened_lens.h"

#include <sstream>
#include <vector>

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
    if (!in(s.threshold, 0, 1e9)) return refuse("glare.threshold", s.threshold, "0 or more");
    if (!in(s.diffraction_px, 0, 1e6))
        return refuse("the size of diffraction", s.diffraction_px, "0 or more");
    if (!in(s.place.pixel_aspect, 0.01, 100))
        return refuse("the pixel aspect", s.place.pixel_aspect, "0.01 to 100");
    if (const Status fine = kernel::check_aperture(s.lens); !fine) return fine;
    if (s.star > 0 && s.lens.aperture.blades < 3)
        return Error{ErrorCode::InvalidArgument,
                     "a round aperture throws no star (glare.star): give lens.blades, as lens.blades 6"};
    return Done{};
}

Picture without_alpha(View<const Rgba> picture, Workers& workers) {
    Picture light = Picture::uninitialised(picture.width(), picture.height());
    parallel_for(light.height(), workers, [&](int y) {
        for (int x = 0; x < light.width(); ++x) light(x, y) = usable(picture(x, y));
    });
    return light;
}

// What stays: finite colour, less what the parts take.
Picture remaining(View<const Rgba> picture, View<const Rgba> highlights, const GlareSettings& s,
                  Workers& workers) {
    const float of_all = float(s.bloom + s.veil), of_highlights = float(s.star + s.ghosts);
    Picture out = Picture::uninitialised(picture.width(), picture.height());
    parallel_for(out.height(), workers, [&](int y) {
        for (int x = 0; x < out.width(); ++x) {
            const Rgba c = picture(x, y);
            const auto finite = [](float v) { return std::isfinite(v) ? v : 0.0f; };
            Rgba left = Rgba{finite(c.r), finite(c.g), finite(c.b), 0} - of_all * usable(c);
            if (!highlights.empty()) left -= of_highlights * highlights(x, y);
            out(x, y) = {left.r, left.g, left.b, c.a};
        }
    });
    return out;
}

// Adds to colour; alpha stays.
void add(Picture& out, const Picture& light, float amount, Workers& workers) {
    parallel_for(out.height(), workers, [&](int y) {
        for (int x = 0; x < out.width(); ++x) {
            const Rgba c = amount * light(x, y);
            out(x, y) += Rgba{c.r, c.g, c.b, 0};
        }
    });
}

void add_veil(Picture& out, const Picture& light, float amount) {
    double r = 0, g = 0, b = 0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const Rgba& c = light.pixels()[i];
        r += double(c.r), g += double(c.g), b += double(c.b);
    }
    const double n = double(light.size());
    const Rgba mean = amount * Rgba{float(r / n), float(g / n), float(b / n), 0};
    for (std::size_t i = 0; i < out.size(); ++i) out.pixels()[i] += mean;
}

Result<GhostModel> ghosts_of(const GlareSettings& s, double height_px, int width_px) {
    const auto lens = s.opened_lens ? Result<Lens>(*s.opened_lens) : Lens::open(s.lens);
    if (!lens) return lens.error();
    if (const optics::Prescription* surfaces = kernel::prescription_of(*lens))
        return prescription_ghosts(*surfaces, s, width_px);
    return sprite_ghosts(s.lens.aperture, height_px, s.place.pixel_aspect);
}

}  // namespace

Result<Picture> add_glare(View<const Rgba> picture, const GlareSettings& settings) {
    glare::KeptStars stars;
    return glare::add_glare(picture, settings, stars);
}

namespace glare {

Result<Picture> add_glare(View<const Rgba> picture, const GlareSettings& settings, KeptStars& stars) {
    GlareSettings s = settings;
    if (s.opened_lens) s.lens = s.opened_lens->choice();
    if (picture.empty()) return Error{ErrorCode::InvalidArgument, "the picture is empty"};
    if (const Status fine = check(s); !fine) return fine.error();
    if (s.bloom == 0 && s.star == 0 && s.ghosts == 0 && s.veil == 0) {
        Picture same = Picture::uninitialised(picture.width(), picture.height());
        for (int y = 0; y < same.height(); ++y)
            std::copy_n(picture.row(y), std::size_t(same.width()), same.row(y));
        return same;
    }
    Rect display = s.place.display_window, data = s.place.data_window;
    if (display.empty()) display = data = picture.rect();
    const double height = display.height() / s.place.pixel_aspect;  // in widths of a pixel, as radii are

    GhostModel ghosts;
    if (s.ghosts > 0) {
        auto model = ghosts_of(s, height, display.width());
        if (!model) return model.error();
        ghosts = std::move(*model);
    }
    const std::shared_ptr<Workers> workers = workers_of(s.threads, s.workers);
    const Picture light = without_alpha(picture, *workers);
    Picture bright;
    if (s.star > 0 || s.ghosts > 0) {
        bright = Picture::uninitialised(light.width(), light.height());
        for (std::size_t i = 0; i < light.size(); ++i)
            bright.pixels()[i] = highlight(light.pixels()[i], float(s.threshold));
    }
    Picture out = remaining(picture, bright, s, *workers);
    if (s.bloom > 0)
        add(out, bloom(light, s.bloom_radius * height, s.place.pixel_aspect, *workers), float(s.bloom),
            *workers);
    if (s.star > 0 && s.star_quality == StarQuality::Draft)
        add_streaks(out, bright, s.lens.aperture, s.star_radius * height, s.place.pixel_aspect, float(s.star),
                    *workers);
    if (s.star > 0 && s.star_quality == StarQuality::Final)
        add_convolved(out, bright,
                      *stars.star(s.lens.aperture, std::max(2.0, s.star_radius * height), s.diffraction_px,
                                  s.place.pixel_aspect, bright.width(), bright.height(), *workers),
                      float(s.star), *workers);
    if (s.ghosts > 0) {
        const kernel::Point middle{display.x0 - data.x0 + 0.5 * display.width(),
                                   display.y0 - data.y0 + 0.5 * display.height()};
        add_ghosts(out, bright, ghosts, middle, float(s.ghosts), *workers);
    }
    if (s.veil > 0) add_veil(out, light, float(s.veil));
    return out;
}

}  // namespace glare
}  // namespace petzval
