#include "describe.h"

#include "petzval/version.h"

#include "depth.h"
#include "overlay.h"
#include "params.h"

#include <array>
#include <string>

namespace petzval::plugin {
namespace {

struct ClipRow {
    const char* name;
    const char* label;
    bool optional, is_mask, any_channels;
    const char* colourspace;
};
constexpr std::array kClips{
    ClipRow{ofx::kSource, "Source", false, false, false, ofx::kSceneLinear},
    ClipRow{kDepthClip, "Depth", true, false, true, ofx::kRaw},
    ClipRow{kPlateClip, "Clean plate", true, false, false, ofx::kSceneLinear},
    ClipRow{kPlateDepthClip, "Depth of the clean plate", true, false, true, ofx::kRaw},
    ClipRow{kMaskClip, "Mask", true, true, true, ofx::kRaw},
    ClipRow{ofx::kOutput, "Output", false, false, false, nullptr},
};

void define_clip(ofx::Effect* descriptor, const ClipRow& row) {
    ofx::PropertySet* set = nullptr;
    if (suites().effect->clip_define(descriptor, row.name, &set) != ofx::kOk) return;
    Properties clip(set);
    clip.set(ofx::kLabel, row.label).set(ofx::kTiles, 1).set(ofx::kTemporalAccess, 0);
    int components = 0;
    if (row.is_mask) clip.set(ofx::kComponentsSupported, ofx::kAlpha, components++);
    clip.set(ofx::kComponentsSupported, ofx::kRgba, components++);
    if (row.any_channels) clip.set(ofx::kComponentsSupported, ofx::kRgb, components++);
    if (row.any_channels && !row.is_mask) clip.set(ofx::kComponentsSupported, ofx::kAlpha, components++);
    if (row.optional) clip.set(ofx::kOptional, 1);
    if (row.is_mask) clip.set(ofx::kIsMask, 1);
}

}  // namespace

int describe(ofx::Effect* descriptor) {
    Properties p = properties_of(descriptor);
    p.set(ofx::kLabel, "petzval")
        .set(ofx::kGrouping, "Filter")
        .set(ofx::kDescription,
             "Gives a rendered picture the depth of field of a real lens. "
             "Needs depth: a clip, or a file.")
        .set(ofx::kVersionLabel, PETZVAL_VERSION)
        .set(ofx::kContexts, ofx::kContextGeneral, 0)
        .set(ofx::kContexts, ofx::kContextFilter, 1)
        .set(ofx::kPixelDepths, ofx::kFloat)
        .set(ofx::kSingleInstance, 0)
        .set(ofx::kThreadSafety, ofx::kFullySafe)
        .set(ofx::kHostFrameThreading, 0)
        .set(ofx::kTiles, 1)
        .set(ofx::kMultiResolution, 1)
        .set(ofx::kTemporalAccess, 0)
        .set(ofx::kMultipleDepths, 0)
        .set(ofx::kMultipleAspects, 0)
        .set(ofx::kColourStyle, ofx::kColourCore);
    if (suites().draw) p.set(ofx::kOverlayV2, reinterpret_cast<void*>(&overlay_main));
    return ofx::kOk;
}

// The same in both contexts: hosts that have one clip alone leave the optional ones away.
int describe_in_context(ofx::Effect* descriptor) {
    for (const ClipRow& row : kClips) define_clip(descriptor, row);
    define_params(descriptor);
    return ofx::kOk;
}

int clip_preferences(ofx::Effect* effect, Properties out) {
    out.set(ofx::kPreMultiplication, ofx::kPreMultiplied);
    out.set((std::string(ofx::kComponentsOf) + ofx::kOutput).c_str(), ofx::kRgba);
    for (const ClipRow& row : kClips)
        if (row.colourspace && (!row.optional || is_connected(effect, row.name)))
            out.set((std::string(ofx::kColourspacesFor) + row.name).c_str(), row.colourspace);
    return ofx::kOk;
}

}  // namespace petzval::plugin
