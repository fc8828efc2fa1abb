// Checks of descriptions, in each context.
#include "checks.h"
#include "rules.h"

#include <algorithm>
#include <cstring>

namespace ofx_check {
namespace {

void check_clips(const ofx::Effect& described, const std::string& context) {
    held("clips.mandated");
    std::vector<const char*> mandated{ofx::kOutput};
    if (context == ofx::kContextFilter) mandated.push_back(ofx::kSource);
    for (const char* clip : mandated)
        if (!described.find(clip)) broken("clips.mandated", context + " has no clip '" + clip + "'");
    for (const auto& clip : described.clips) {
        held("clips.components");
        if (clip->properties.texts(ofx::kComponentsSupported).empty())
            broken("clips.components", "'" + clip->name + "' names none");
        const bool others =
            context == ofx::kContextFilter && clip->name != ofx::kSource && clip->name != ofx::kOutput;
        if (others && clip->properties.integer(ofx::kOptional) == 0)
            broken("clips.mandated", "'" + clip->name + "' is not optional, in a filter");
    }
}

// Value i of a property that has integers or doubles.
bool number_of(const ofx::PropertySet& set, const char* name, std::size_t i, double& number) {
    const auto slot = set.slots.find(name);
    if (slot == set.slots.end()) return false;
    const auto* whole = std::get_if<std::vector<int>>(&slot->second);
    const auto* doubles = std::get_if<std::vector<double>>(&slot->second);
    if (whole && i < whole->size()) number = (*whole)[i];
    if (doubles && i < doubles->size()) number = (*doubles)[i];
    return (whole && i < whole->size()) || (doubles && i < doubles->size());
}

void check_param(const ofx::Param& param) {
    const ofx::PropertySet& p = param.properties;
    held("params.default");
    for (std::size_t i = 0; i < 4; ++i) {
        double usual = 0, least = 0, most = 0;
        if (!number_of(p, ofx::param::kDefault, i, usual)) continue;
        const bool low = number_of(p, ofx::param::kMin, i, least) && usual < least;
        const bool high = number_of(p, ofx::param::kMax, i, most) && usual > most;
        if (low || high) broken("params.default", "'" + param.name + "': " + std::to_string(usual));
    }
    const std::size_t options = p.texts(ofx::param::kChoiceOption).size();
    if (param.type == ofx::param::kChoice && options > 0 &&
        std::size_t(p.integer(ofx::param::kDefault)) >= options)
        broken("params.default",
               "'" + param.name + "': option " + std::to_string(p.integer(ofx::param::kDefault)));
}

}  // namespace

void check_description(const Setup& setup) {
    Stage stage(setup);
    if (!stage.begin()) return broken("describe.contexts", stage.problem());
    held("describe.contexts"), held("describe.depths");
    const auto& p = stage.descriptor().properties;
    if (p.texts(ofx::kContexts).empty()) broken("describe.contexts", "no context is named");
    if (p.texts(ofx::kPixelDepths).empty()) broken("describe.depths", "no pixel depth is named");
    for (const std::string& context : stage.contexts()) {
        const ofx::Effect* described = stage.described_in(context);
        if (!described) {
            broken("describe.contexts", stage.problem());
            continue;
        }
        check_clips(*described, context);
        for (const auto& param : described->params.params) check_param(*param);
    }
    held("action.unknown");
    const int status = stage.plugin()->main_entry("OfxActionOfTomorrow", nullptr, nullptr, nullptr);
    if (status != ofx::kReplyDefault)
        broken("action.unknown", "an unknown action returned " + std::to_string(status));
}

}  // namespace ofx_check
