// The checks: each runs a plug-in through some frames in a separate process.
#pragma once

#include "stage.h"

#include <functional>
#include <string>
#include <vector>

namespace ofx_check {

struct Check {
    std::string name;
    const char* rule;  // broken as well if the process ends or hangs
    std::function<void(const Setup&)> run;
};

void check_description(const Setup& setup);
void check_contexts(const Setup& setup);
void check_rows(const Setup& setup);
void check_scale(const Setup& setup);
void check_parts(const Setup& setup);
void check_optional_clips(const Setup& setup);
void check_abort(const Setup& setup);
void check_instances(const Setup& setup);
void check_threads(const Setup& setup);
void check_reload(const Setup& setup);
void check_extremes(const Setup& setup);
void check_menus(const Setup& setup);
void check_overlay(const Setup& setup);
void check_missing_suite(const Setup& setup, const char* suite);
void check_null_handles(const Setup& setup);
void check_loads(const Setup& setup);
void check_no_image(const Setup& setup);
void check_bad_image(const Setup& setup, EffectLies::Bad bad);

std::vector<Check> all_checks();

// A plain frame with the plug-in's defaults. If there is none, the rules are reported as not tried, with the
// reason.
struct Scene {
    explicit Scene(const Setup& setup, std::initializer_list<const char*> rules, const Cast& cast = {});
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;
    explicit operator bool() const { return is_ready; }

    Stage stage;
    std::unique_ptr<ofx::Effect> effect;
    Rendered plain;
    double plain_seconds = 0;
    bool is_ready = false;
};
// Holds if two pictures have the same bits.
void expect_same(const char* rule, const Rendered& got, const Picture& wanted, const std::string& where);
double seconds_now();

}  // namespace ofx_check
