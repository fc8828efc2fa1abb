#include "checks.h"

#include "rules.h"

#include <chrono>
#include <initializer_list>

namespace ofx_check {

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Scene::Scene(const Setup& setup, std::initializer_list<const char*> rules, const Cast& cast) : stage(setup) {
    std::string why;
    trying("process.survives");  // a plain frame is not a check of a rule
    if (stage.begin()) effect = stage.create(cast);
    if (effect) {
        const double start = seconds_now();
        plain = stage.render(*effect);
        plain_seconds = seconds_now() - start;
        is_ready = plain.fine();
        if (!is_ready)
            why = "a plain frame gives status " + std::to_string(plain.status) +
                  (counts.last_message.empty() ? "" : " (" + counts.last_message + ")") + "; see --param";
    } else {
        why = stage.problem().empty() ? "the plug-in has no context that this host knows" : stage.problem();
    }
    for (const char* rule : rules)
        if (!is_ready) not_tried(rule, why);
    trying(*rules.begin());
}

Scene::~Scene() { stage.destroy(std::move(effect)); }

void expect_same(const char* rule, const Rendered& got, const Picture& wanted, const std::string& where) {
    held(rule);
    if (!got.fine()) return broken(rule, where + ": status " + std::to_string(got.status));
    if (!same(got.picture, wanted)) broken(rule, where + ": " + first_difference(got.picture, wanted));
}

std::vector<Check> all_checks() {
    std::vector<Check> checks{
        {"description", "describe.contexts", check_description},
        {"contexts", "render.contexts", check_contexts},
        {"rows", "bounds.offset", check_rows},
        {"scale", "scale.half", check_scale},
        {"parts", "window.part", check_parts},
        {"optional clips", "clips.optional", check_optional_clips},
        {"abort", "abort.obeyed", check_abort},
        {"instances", "instances.apart", check_instances},
        {"threads", "threads.same", check_threads},
        {"reload", "reload.same", check_reload},
        {"extremes", "params.extremes", check_extremes},
        {"menus", "params.chosen", check_menus},
        {"overlay", "overlay.survives", check_overlay},
        {"null handles", "host.null_handles", check_null_handles},
        {"loads", "host.loads_again", check_loads},
        {"no image", "host.no_image", check_no_image},
    };
    for (const char* suite : {ofx::kPropertySuite, ofx::kImageEffectSuite, ofx::kParameterSuite,
                              ofx::kMessageSuite, ofx::kMemorySuite, ofx::kMultiThreadSuite,
                              ofx::kProgressSuite, ofx::kInteractSuite, ofx::kDrawSuite})
        checks.push_back({std::string("without ") + suite, "host.missing_suite",
                          [suite](const Setup& setup) { check_missing_suite(setup, suite); }});
    struct BadRow {
        const char* name;
        EffectLies::Bad bad;
    };
    for (const BadRow& row : {BadRow{"image of half floats", EffectLies::Bad::WrongDepth},
                              {"image without memory", EffectLies::Bad::NoData},
                              {"image without size", EffectLies::Bad::NoSize}})
        checks.push_back(
            {row.name, "host.bad_image", [bad = row.bad](const Setup& s) { check_bad_image(s, bad); }});
    return checks;
}

}  // namespace ofx_check
