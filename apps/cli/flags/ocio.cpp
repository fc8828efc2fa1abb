#include "flags/ocio.h"

#include "flags/values.h"

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

Status OcioFlags::try_out() const {
    Picture light(1, 1);
    DevelopSettings settings;
    std::string used;
    std::vector<std::string> warnings;
    return show(light, settings, used, warnings);
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
Status OcioFlags::show(Picture& light, DevelopSettings& settings, std::string& used,
                       std::vector<std::string>& warnings) const {
    OcioView wanted = ocio_view(view);
    wanted.space = space;
    return show_by_ocio(light, settings, wanted, used, warnings);
}
#else
Status OcioFlags::show(Picture&, DevelopSettings&, std::string&, std::vector<std::string>&) const {
    return Error{
        ErrorCode::InvalidArgument,
        "--ocio: this petzval was built without OpenColorIO; install libopencolorio-dev and build again"};
}
#endif

}  // namespace petzval::cli
