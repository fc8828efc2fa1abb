// A field that a host gives is used, refused, or named in a warning: never passed over in silence.
#include "petzval/glare.h"
#include "petzval/session.h"

#include "drawers.h"

#include <functional>
#include <string>
#include <vector>

namespace petzval::conformance {
namespace {

constexpr int kWide = 40, kHigh = 30;

// A near card before a wall, the wall nearly in focus, and the pictures that a host may give beside them.
struct Given {
    Picture colour{kWide, kHigh, {0.3f, 0.5f, 0.2f, 1}};
    Picture other{kWide, kHigh, {0.1f, 0.1f, 0.4f, 1}};
    Plane depth_m{kWide, kHigh, 4}, mask{kWide, kHigh, 0.5f};
    DeepPicture deep, behind, holdout;
    std::vector<LightPoint> lights{{.x = 12, .y = 11, .r = 40, .g = 40, .b = 40, .depth_m = 1.2f}};

    Given() {
        for (int y = 8; y < 22; ++y)
            for (int x = 10; x < 30; ++x) depth_m(x, y) = 1.5f, colour(x, y) = {0.9f, 0.4f, 0.1f, 1};
        const auto everywhere = [](const std::vector<DeepSample>& samples) {
            return DeepPicture::made_of(kWide, kHigh, [&](int, int, std::vector<DeepSample>& into) {
                into.insert(into.end(), samples.begin(), samples.end());
            });
        };
        deep = everywhere({{.colour = {0.2f, 0.1f, 0.1f, 0.5f}, .depth = 1.2f, .depth_back = 1.2f},
                           {.colour = {0.1f, 0.6f, 0.1f, 1}, .depth = 8, .depth_back = 8}});
        behind = everywhere({{.colour = {0.1f, 0.1f, 0.9f, 1}, .depth = 6, .depth_back = 6}});
        holdout = everywhere({{.colour = {0, 0, 0, 0.7f}, .depth = 1, .depth_back = 1}});
    }
    Rendered rendered() const {
        Rendered r;
        r.place = Place::whole(colour.rect());
        r.camera = {200, 36, 1.4, 3.6};
        r.colour = colour;
        r.depth = PlanarDepth{depth_m};
        return r;
    }
};

struct Field {
    const char* name;
    std::function<void(Rendered&, const Given&)> give;
};

// A new member of Rendered ends the compilation here; then it belongs into fields().
[[maybe_unused]] void all_members_are_known(const Rendered& r) {
    [[maybe_unused]] const auto& [place, camera, colour, depth, deep, behind, holdout, mask, layers, lights] =
        r;
}

std::vector<Field> fields() {
    return {{"place",
             [](Rendered& r, const Given&) {
                 r.place.display_window = {-60, 0, kWide, kHigh};
             }},
            {"place.pixel_aspect", [](Rendered& r, const Given&) { r.place.pixel_aspect = 2; }},
            {"camera.f_number", [](Rendered& r, const Given&) { r.camera.f_number = 2.8; }},
            {"colour", [](Rendered& r, const Given& given) { r.colour = given.other; }},
            {"depth", [](Rendered& r, const Given& given) { r.depth = SignedRadii{given.depth_m}; }},
            {"deep", [](Rendered& r, const Given& given) { r.deep = &given.deep; }},
            {"behind", [](Rendered& r, const Given& given) { r.behind = &given.behind; }},
            {"holdout", [](Rendered& r, const Given& given) { r.holdout = &given.holdout; }},
            {"mask", [](Rendered& r, const Given& given) { r.mask = given.mask; }},
            {"layers", [](Rendered& r, const Given& given) { r.layers.push_back({given.other}); }},
            {"layers.spectrum",
             [](Rendered& r, const Given& given) {
                 r.layers.push_back({given.other, true, LightSpectrum::Sodium});
             }},
            {"lights", [](Rendered& r, const Given& given) { r.lights = &given.lights; }}};
}

bool names(const std::vector<std::string>& warnings, const std::string& field) {
    const std::string word = field.substr(0, field.find('.'));
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const std::string& line) { return line.find(word) != std::string::npos; });
}

// True for fields whose own picture is in the report.
bool made_more(const DefocusReport& report) { return !report.layers.empty(); }

class GivenField : public EveryDrawer {};

TEST_P(GivenField, IsUsedRefusedOrNamed) {
    static const Given given;
    kept_open.keep(drawer().device);
    Session session(drawer().session());
    Look look;
    look.engine = drawer().engine, look.pupil_points = 64;
    const auto before = session.take(given.rendered(), look);
    ASSERT_TRUE(before) << before.error().message;
    for (const Field& field : fields()) {
        SCOPED_TRACE(field.name);
        Rendered rendered = given.rendered();
        field.give(rendered, given);
        const auto after = session.take(rendered, look);
        if (!after) {
            EXPECT_FALSE(after.error().message.empty());
            continue;
        }
        EXPECT_TRUE(largest_difference(before->image, after->image) > 0 || made_more(*after) ||
                    names(after->warnings, field.name))
            << "is given, changes nothing, and nobody says so";
    }
}

PETZVAL_EVERY_DRAWER(GivenField);

DefocusJob job_of(const Given& given) {
    const Rendered rendered = given.rendered();
    DefocusJob job;
    job.place = rendered.place, job.camera = rendered.camera, job.colour = rendered.colour;
    job.depth_m = given.depth_m;
    return job;
}

// Warnings of a job in a session that has its own settings.
TEST(GivenFields, OfAJobThatTheSessionDecidesAreNamed) {
    const Given given;
    Session session({.threads = 1});
    const auto silent = session.defocus(job_of(given));
    ASSERT_TRUE(silent) << silent.error().message;
    EXPECT_TRUE(silent->warnings.empty());
    auto workers = own_workers(2);
    DefocusJob job = job_of(given);
    job.threads = 3, job.workers = workers.get(), job.max_memory_bytes = std::size_t(1) << 30;
    job.kernel_cache_folder = "/tmp", job.kernel_cache_bytes = 1;
    job.progress = [](double) { return true; };
    const auto told = session.defocus(job);
    ASSERT_TRUE(told) << told.error().message;
    for (const char* field : {"job.threads", "job.workers", "job.max_memory_bytes", "job.kernel_cache_folder",
                              "job.kernel_cache_bytes", "progress"})
        EXPECT_TRUE(std::any_of(told->warnings.begin(), told->warnings.end(), [&](const std::string& line) {
            return line.find(field) != std::string::npos;
        })) << field;
}

// Session::defocus() is the blur alone.
TEST(GivenFields, OfALookThatABlurLeavesOutAreNamed) {
    const Given given;
    Session session;
    Look look;
    look.vignetting = true, look.glare.bloom = 0.2, look.expand_highlights = true;
    const auto told = session.defocus(given.rendered(), look);
    ASSERT_TRUE(told) << told.error().message;
    for (const char* field : {"look.vignetting", "look.glare", "look.expand_highlights"})
        EXPECT_TRUE(names(told->warnings, field)) << field;
    EXPECT_EQ(told->warnings.size(), 3u);
}

}  // namespace
}  // namespace petzval::conformance
