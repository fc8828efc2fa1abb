// Comparison of two pictures behind the C API.
#include "petzval/compare.h"

#include "petzval/petzval_c.h"

#include "c/handles.h"
#include "c/lent.h"

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

namespace {

using namespace petzval;
using petzval::c::fail;
using petzval::c::guarded;
using petzval::c::missing;

Picture read_picture(const ColourView& view) {
    Picture picture = Picture::uninitialised(view.width, view.height);
    read_pixels(view, picture);
    return picture;
}

// JSON has no infinity: 1e999, which readers take as one.
std::string number(double value) {
    if (std::isnan(value)) return "null";
    if (std::isinf(value)) return value > 0 ? "1e999" : "-1e999";
    return nlohmann::json(value).dump();
}

std::string comparison_text(const Comparison& c) {
    std::string text = "{";
    struct Row {
        const char* name;
        double value;
    };
    for (const auto& [name, value] :
         {Row{"psnr_lin", c.psnr_lin}, Row{"psnr_srgb", c.psnr_srgb}, Row{"psnr_log", c.psnr_log},
          Row{"ssim_lin", c.ssim_lin}, Row{"ssim_srgb", c.ssim_srgb}, Row{"max_error", c.max_error},
          Row{"energy_ratio", c.energy_ratio}})
        text.append("\"").append(name).append("\": ").append(number(value)).append(", ");
    return text + "\"max_error_at\": [" + std::to_string(c.max_error_x) + ", " +
           std::to_string(c.max_error_y) + "]}";
}

petzval_status compare_pixels(const petzval_pixels* reference, const petzval_pixels* test,
                              const petzval_plane* mask, double exposure, petzval_text** text) {
    const auto first = c::colour_view(reference, "reference"), second = c::colour_view(test, "test");
    if (!first) return fail(first.error());
    if (!second) return fail(second.error());
    Plane counts;
    if (mask) {
        if (const Status ok = c::check_plane(mask, first->width, first->height, "mask"); !ok)
            return fail(ok.error());
        counts = c::read_plane(mask);
    }
    CompareSettings settings;
    if (exposure != 0) settings.exposure = exposure;
    settings.mask = counts.view();
    const Picture a = read_picture(*first), b = read_picture(*second);
    const auto compared = compare(a.view(), b.view(), settings);
    if (!compared) return fail(compared.error());
    *text = new petzval_text{comparison_text(*compared)};
    return PETZVAL_OK;
}

}  // namespace

petzval_status petzval_compare(const petzval_pixels* reference, const petzval_pixels* test,
                               const petzval_plane* mask, double exposure, petzval_text** text) {
    if (!text) return missing("text");
    *text = nullptr;
    return guarded([&] { return compare_pixels(reference, test, mask, exposure, text); });
}
