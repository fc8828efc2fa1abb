#include "flags/ocio.h"

#include "flags/values.h"

#include <cmath>
#include <utility>

#ifdef PETZVAL_OCIO
#include "petzval/ocio.h"
#endif

namespace petzval::cli {

void OcioFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Display picture (PNG)")
        .value("--ocio", "DISPLAY,VIEW",
               "OpenColorIO display and view instead of --tone and sRGB, by the config in $OCIO; default: "
               "the config's own",
               parse_text, view)
        .value("--ocio-space", "NAME",
               "the config's name for scene-linear Rec.709, if it does not define one", parse_text, space);
}

void OcioFlags::check(const DevelopFlags& develop, std::optional<Transfer> transfer) const {
    if (!space.empty() && !is_on()) throw UsageError("--ocio-space has no effect without --ocio");
    refuse_both(is_on(), "--ocio", develop.tone.has_value(), "--tone");
    refuse_both(is_on(), "--ocio", develop.contrast.has_value(), "--contrast");
    refuse_both(is_on(), "--ocio", transfer.has_value(), "--transfer");
}

Status OcioFlags::try_out() const {
    Picture light(1, 1);
    DevelopSettings settings;
    std::string used;
    std::vector<std::string> warnings;
    return show(light, settings, used, warnings);
}

Status OcioFlags::show(Picture& light, DevelopSettings& settings, std::string& used,
                       std::vector<std::string>& warnings) const {
    const float exposure = float(std::exp2(settings.exposure_stops));
    for (std::size_t i = 0; i < light.size(); ++i) light.pixels()[i] *= exposure;
    auto found = codes(light, settings.threads, used, warnings);
    if (!found) return found.error();
    light = std::move(*found);
    settings.exposure_stops = 0;
    settings.tone = ToneCurve::None;
    settings.transfer = Transfer::Linear;
    return Done{};
}

ShotRunHost OcioFlags::display(FrameLoopHost host) const {
    ShotRunHost shown;
    static_cast<FrameLoopHost&>(shown) = std::move(host);
    if (is_on())
        shown.to_display = [ocio = *this](Picture& light, DevelopSettings& settings, std::string& used,
                                          std::vector<std::string>& warnings) {
            return ocio.show(light, settings, used, warnings);
        };
    return shown;
}

#ifdef PETZVAL_OCIO
Result<Picture> OcioFlags::codes(View<const Rgba> light, int threads, std::string& used,
                                 std::vector<std::string>& warnings) const {
    OcioView wanted{{}, {}, space};
    if (view != "default") {
        const std::size_t comma = view.find(',');
        wanted.display = view.substr(0, comma);
        if (comma != std::string::npos) wanted.view = view.substr(comma + 1);
    }
    auto shown = ocio_codes(light, wanted, threads);
    if (!shown) return shown.error();
    used = "OpenColorIO: display " + shown->display + ", view " + shown->view + ", from " + shown->space;
    warnings.insert(warnings.end(), shown->warnings.begin(), shown->warnings.end());
    return std::move(shown->codes);
}
#else
Result<Picture> OcioFlags::codes(View<const Rgba>, int, std::string&, std::vector<std::string>&) const {
    return Error{
        ErrorCode::InvalidArgument,
        "--ocio: this petzval was built without OpenColorIO; install libopencolorio-dev and build again"};
}
#endif

}  // namespace petzval::cli
