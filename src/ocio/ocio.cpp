#include "petzval/ocio.h"

#include "base/parallel.h"

#include <OpenColorIO/OpenColorIO.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <utility>

namespace petzval {
namespace {

namespace OCIO = OCIO_NAMESPACE;

Error invalid(const std::string& message) { return {ErrorCode::InvalidArgument, message}; }

// The first line of a message; OpenColorIO's run over several.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

template <typename Name>
std::string listed(int count, const Name& name) {
    std::string text;
    for (int i = 0; i < count; ++i) text += (i ? ", " : "") + std::string(name(i));
    return text;
}

template <typename Name>
bool holds(int count, const Name& name, const std::string& wanted) {
    for (int i = 0; i < count; ++i)
        if (wanted == name(i)) return true;
    return false;
}

// The conversion from scene-linear Rec.709 to the config's colour space `space`.
struct Source {
    std::string space;
    OCIO::GroupTransformRcPtr before = OCIO::GroupTransform::Create();
    std::vector<std::string> warnings;
};

// Rec.709 to CIE XYZ with D65 as white (SMPTE RP 177 from the primaries of ITU-R BT.709), and OpenColorIO's
// own way on to ACES2065-1.
void add_way_to_aces(OCIO::GroupTransform& group) {
    const double matrix[16] = {0.4123907993,
                               0.3575843394,
                               0.1804807884,
                               0,
                               0.2126390059,
                               0.7151686788,
                               0.0721923154,
                               0,
                               0.0193308187,
                               0.1191947798,
                               0.9505321522,
                               0,
                               0,
                               0,
                               0,
                               1};
    auto to_xyz = OCIO::MatrixTransform::Create();
    to_xyz->setMatrix(matrix);
    group.appendTransform(to_xyz);
    auto to_aces = OCIO::BuiltinTransform::Create();
    to_aces->setStyle("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD");
    to_aces->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
    group.appendTransform(to_aces);
}

Result<Source> source_of(const OCIO::Config& config, const std::string& asked) {
    Source source;
    if (!asked.empty()) {
        if (!config.getColorSpace(asked.c_str()))
            return invalid("ocio.working_space " + asked + ": not in the config, which has " +
                           listed(config.getNumColorSpaces(),
                                  [&](int i) { return config.getColorSpaceNameByIndex(i); }));
        source.space = asked;
        return source;
    }
    if (config.hasRole(OCIO::ROLE_INTERCHANGE_SCENE)) {
        source.space = OCIO::ROLE_INTERCHANGE_SCENE;
        add_way_to_aces(*source.before);
        return source;
    }
    for (const char* usual :
         {"lin_rec709", "lin_rec709_srgb", "lin_srgb", "Linear Rec.709 (sRGB)", "Utility - Linear - Rec.709",
          "Utility - Linear - sRGB", "Linear Rec.709", "Linear BT.709", "Linear"})
        if (config.getColorSpace(usual)) {
            source.space = usual;
            return source;
        }
    if (!config.hasRole(OCIO::ROLE_SCENE_LINEAR))
        return invalid(
            "the config has no role scene_linear; give ocio.working_space, the name it has for "
            "scene-linear Rec.709");
    source.space = OCIO::ROLE_SCENE_LINEAR;
    source.warnings.emplace_back(
        "the config does not say which space is scene-linear Rec.709; its "
        "scene_linear is taken for it (ocio.working_space names another)");
    return source;
}

Result<OcioView> completed(const OCIO::Config& config, OcioView view) {
    const auto display = [&](int i) { return config.getDisplay(i); };
    if (view.display.empty()) view.display = config.getDefaultDisplay();
    if (!holds(config.getNumDisplays(), display, view.display))
        return invalid("ocio.view: the config has no display '" + view.display + "'; it has " +
                       listed(config.getNumDisplays(), display));
    const char* const name = view.display.c_str();
    const auto view_name = [&](int i) { return config.getView(name, i); };
    if (view.view.empty()) view.view = config.getDefaultView(name);
    if (!holds(config.getNumViews(name), view_name, view.view))
        return invalid("ocio.view: display '" + view.display + "' has no view '" + view.view + "'; it has " +
                       listed(config.getNumViews(name), view_name));
    return view;
}

Rgba shown_over_black(Rgba c) {
    const auto fix = [](float v) { return std::isnan(v) ? 0.0f : std::clamp(v, -65504.0f, 65504.0f); };
    return {fix(c.r), fix(c.g), fix(c.b), 1};
}

Result<OcioPicture> codes_by(const OCIO::Config& config, View<const Rgba> picture, const OcioView& asked,
                             Workers& workers) {
    auto view = completed(config, asked);
    if (!view) return view.error();
    auto source = source_of(config, asked.space);
    if (!source) return source.error();
    auto to_display = OCIO::DisplayViewTransform::Create();
    to_display->setSrc(source->space.c_str());
    to_display->setDisplay(view->display.c_str());
    to_display->setView(view->view.c_str());
    source->before->appendTransform(to_display);
    const auto processor = config.getProcessor(source->before)->getDefaultCPUProcessor();
    OcioPicture result{Picture::uninitialised(picture.width(), picture.height()), view->display, view->view,
                       source->space, source->warnings};
    parallel_for(picture.height(), workers, [&](int y) {
        Rgba* const row = result.codes.row(y);
        for (int x = 0; x < picture.width(); ++x) row[x] = shown_over_black(picture(x, y));
        OCIO::PackedImageDesc pixels(row, picture.width(), 1, 4);
        processor->apply(pixels);
    });
    return result;
}

}  // namespace

Result<OcioPicture> ocio_codes(View<const Rgba> picture, const OcioView& view, int threads,
                               Workers* workers) {
    const char* const path = std::getenv("OCIO");
    if (!path || !*path)
        return invalid(
            "ocio.view: $OCIO is not set; set it to a config file, such as /shows/one/config.ocio");
    std::error_code missing;
    const auto kind = std::filesystem::status(path, missing).type();
    if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found)
        return Error{ErrorCode::InvalidFile, "$OCIO " + std::string(path) + ": is not a regular file"};
    try {
        OCIO::SetLoggingLevel(OCIO::LOGGING_LEVEL_NONE);
        return codes_by(*OCIO::Config::CreateFromFile(path), picture, view, *workers_of(threads, workers));
    } catch (const OCIO::Exception& wrong) {
        return Error{ErrorCode::InvalidFile,
                     "$OCIO " + std::string(path) + ": cannot be used: " + first_line(wrong.what())};
    }
}

OcioView ocio_view(const std::string& text) {
    if (text == "default") return {};
    const std::size_t comma = text.find(',');
    return {text.substr(0, comma), comma == std::string::npos ? "" : text.substr(comma + 1), {}};
}

Status show_by_ocio(Picture& light, DevelopSettings& settings, const OcioView& view, std::string& used,
                    std::vector<std::string>& warnings) {
    const float exposure = float(std::exp2(settings.exposure_stops));
    for (std::size_t i = 0; i < light.size(); ++i) light.pixels()[i] *= exposure;
    auto shown = ocio_codes(light, view, settings.threads, settings.workers);
    if (!shown) return shown.error();
    light = std::move(shown->codes);
    used = "OpenColorIO: display " + shown->display + ", view " + shown->view + ", from " + shown->space;
    warnings.insert(warnings.end(), shown->warnings.begin(), shown->warnings.end());
    settings.exposure_stops = 0;
    settings.tone = ToneCurve::None;
    settings.transfer = Transfer::Linear;
    return Done{};
}

}  // namespace petzval
