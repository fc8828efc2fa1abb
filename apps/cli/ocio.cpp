#include "ocio.h"

#include "values.h"

#ifdef PETZVAL_OCIO
#include "petzval/ocio.h"
#endif

namespace petzval::cli {

void OcioFlags::add_to(Verb& verb) {
    FlagGroup(verb, "Display picture (PNG)")
        .value(
            "--ocio", "DISPLAY,VIEW",
            "display and view of OpenColorIO, by the config in $OCIO, in place of --tone and sRGB; default: "
            "the config's own",
            parse_text, view)
        .value("--ocio-space", "NAME",
               "what the config calls scene-linear Rec.709, if it does not say itself", parse_text, space);
}

void OcioFlags::check() const {
    if (!space.empty() && !is_on()) throw UsageError("--ocio-space has no effect without --ocio");
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
