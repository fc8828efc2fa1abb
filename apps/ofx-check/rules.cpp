#include "rules.h"

#include <algorithm>
#include <array>
#include <unistd.h>

namespace ofx_check {
namespace {

constexpr const char* kImages = "Images and Clips";
constexpr const char* kRendering = "Rendering";
constexpr const char* kActions = "Actions Passed to An Image Effect";
constexpr const char* kContexts = "Image Effect Contexts";
constexpr const char* kProperties = "Properties Reference";
constexpr const char* kParameters = "Parameters";
constexpr const char* kEffects = "Image Effect Suite";
constexpr const char* kThreads = "Thread and Recursion Safety";
constexpr const char* kStatus = "Status Codes";

constexpr std::array kRules{
    Rule{"bundle.layout", "Packaging OFX Plug-ins", "NAME.ofx.bundle/Contents/Linux-x86-64/NAME.ofx"},
    Rule{"exports.required", "The OFX Core API", "OfxGetNumberOfPlugins and OfxGetPlugin are exported"},
    Rule{"exports.only", "no page: Fusion refuses other names",
         "no other names are exported except OfxSetHost"},
    Rule{"plugin.struct", "The OfxPlugin Struct",
         "its fields state the API, version 1 and a legal identifier"},
    Rule{"process.survives", kStatus, "no action ends the host's process"},
    Rule{"process.returns", kStatus, "every action returns"},
    Rule{"action.status", kActions, "an action returns a status that its page lists"},
    Rule{"action.unknown", kActions, "an action that the plug-in does not handle returns ReplyDefault"},
    Rule{"describe.contexts", kContexts, "Describe names at least one known context"},
    Rule{"describe.depths", kImages, "Describe names the pixel depths"},
    Rule{"clips.mandated", kContexts, "the clips that a context requires are defined"},
    Rule{"clips.components", kImages, "each clip names its components"},
    Rule{"clips.declared", kEffects, "only clips that were defined are asked for"},
    Rule{"clips.optional", kContexts, "optional clips may be missing"},
    Rule{"property.object", kProperties, "a property is set on objects that have it"},
    Rule{"property.type", kProperties, "a property is set and read by its own type"},
    Rule{"property.index", kProperties, "an index lies within the property's dimension"},
    Rule{"property.value", kProperties, "a property with a list of values is set to one of them"},
    Rule{"property.write", kProperties, "properties that the host writes are not set"},
    Rule{"handles.valid", kStatus, "handles come from the host and are still valid"},
    Rule{"params.declared", kParameters, "only parameters that were defined are asked for"},
    Rule{"params.once", kParameters,
         "each parameter is defined once, in DescribeInContext, with a known type"},
    Rule{"params.default", kParameters, "a default lies between minimum and maximum"},
    Rule{"params.write_action", kParameters, "values are not set while rendering"},
    Rule{"params.extremes", kParameters,
         "at its minimum and maximum, each number renders, or fails with a status"},
    Rule{"params.chosen", kActions, "a user may choose every entry of every menu"},
    Rule{"images.released", kImages, "each image is released, once, before its action returns"},
    Rule{"images.action", kImages, "images are fetched only by actions that may fetch them"},
    Rule{"images.after_release", kImages, "the memory of a released image is not used"},
    Rule{"images.input", kImages, "images of inputs are not written"},
    Rule{"images.bounds", kImages, "no memory outside an image's bounds is used"},
    Rule{"render.complete", kRendering, "all pixels of the render window are written"},
    Rule{"render.window", kRendering, "no pixel outside the render window is written"},
    Rule{"render.repeat", kRendering, "the same render gives the same bits"},
    Rule{"render.contexts", kContexts, "an instance renders in each context that Describe names"},
    Rule{"rows.negative", kImages, "row bytes may be negative"},
    Rule{"rows.padding", kImages, "row bytes need not be a multiple of a pixel"},
    Rule{"bounds.offset", kImages, "bounds need not begin at 0, nor be equal"},
    Rule{"scale.half", "Spatial Coordinates", "at render scale 1/2 the picture is the same, smaller"},
    Rule{"window.part", kRendering,
         "a part of the frame has the bits of the whole, where tiles are supported"},
    Rule{"regions.valid", kRendering, "regions are rectangles"},
    Rule{"regions.enough", kRendering, "a part needs nothing outside its region of interest"},
    Rule{"identity.valid", kRendering, "an identity names a clip that exists"},
    Rule{"abort.obeyed", kEffects, "a long render calls abort and obeys it"},
    Rule{"instances.apart", kThreads, "instances share no state"},
    Rule{"threads.same", kThreads,
         "simultaneous renders, as the stated thread safety allows, have the same bits"},
    Rule{"reload.same", "The Loading Sequence", "after unloading, a plug-in loads and renders again"},
    Rule{"reload.threads", "no page: Natron's host library closes a library after OfxActionUnload",
         "no thread of the plug-in runs in a closed library"},
    Rule{"host.missing_suite", "Suites Reference", "a missing suite gives a status, not a crash"},
    Rule{"host.null_handles", kStatus, "null handles and missing properties give a status, not a crash"},
    Rule{"host.loads_again", "no page: MLT loads the plug-in for each instance",
         "OfxActionLoad and Describe, sent again while frames render, change nothing"},
    Rule{"host.no_image", kEffects, "a clip without image counts as black and transparent"},
    Rule{"host.bad_image", kImages, "an image of the wrong format is refused, not read"},
    Rule{"errors.message", kActions, "a render that fails posts a message"},
    Rule{"overlay.survives", "Interacts",
         "the overlay draws and handles the pen, with and without a draw context"},
};

int descriptor = -1;

void write_line(char kind, std::string_view rule, std::string why) {
    std::replace(why.begin(), why.end(), '\n', ' ');
    const std::string line = kind + std::string(rule) + '\t' + why.substr(0, 2000) + '\n';
    if (descriptor >= 0 && write(descriptor, line.data(), line.size()) < 0) descriptor = -1;
}

}  // namespace

std::span<const Rule> rules() { return kRules; }

void report_to(int to) { descriptor = to; }
void held(std::string_view rule) { write_line('+', rule, ""); }
void broken(std::string_view rule, const std::string& why) { write_line('!', rule, why); }
void not_tried(std::string_view rule, const std::string& why) { write_line('-', rule, why); }

void trying(std::string_view rule) { write_line('?', rule, ""); }

std::string tried_rule(const std::string& line) {
    return line.starts_with('?') ? line.substr(1, line.find('\t') - 1) : "";
}

void take(Outcomes& outcomes, const std::string& line, const std::string& check) {
    const auto tab = line.find('\t');
    if (line.empty() || line[0] == '?' || tab == std::string::npos) return;
    Outcome& outcome = outcomes[line.substr(1, tab - 1)];
    const std::string why = line.substr(tab + 1);
    if (line[0] == '+') outcome.tried = true;
    if (line[0] == '-' && outcome.why.empty()) outcome.why = why;
    if (line[0] != '!' || outcome.is_broken) return;
    outcome.tried = outcome.is_broken = true;
    outcome.why = why;
    outcome.check = check;
}

}  // namespace ofx_check
