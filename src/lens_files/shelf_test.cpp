#include "lens_files/shelf.h"

#include "lens_files/expected_values.h"
#include "lens_files/glass_catalogue.h"
#include "lens_files/json.h"
#include "optics/traced_lens.h"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

namespace petzval::lens_files {
namespace {

TEST(Shelf, EveryLensReadsFocusesAndPassesLightUpToItsField) {
    ASSERT_GE(shelf().size(), 12u);
    for (const ShelfItem& item : shelf()) {
        SCOPED_TRACE(item.name);
        const auto file = find_lens(std::string(item.name));
        ASSERT_TRUE(file) << file.error().message;
        const auto traced = optics::TracedLens::make(file->lens, {});
        ASSERT_TRUE(traced) << traced.error().message;
        const double edge = optics::field_angle_deg(file->lens, traced->first_order());
        for (const double share : {0.0, 0.5, 0.98}) {
            const auto beam = traced->beam(file->lens.primary_um, share * edge * std::numbers::pi / 180);
            ASSERT_TRUE(beam) << beam.error().message;
            EXPECT_TRUE(beam->ray(0, 0).reached) << share;
        }
    }
}

TEST(Shelf, TheClearAperturesOfEveryLensPassItsFNumber) {
    for (const ShelfItem& item : shelf())
        EXPECT_EQ(f_number_problem(find_lens(std::string(item.name)).value().lens), "") << item.name;
}

TEST(Shelf, EveryLensNamesItsSourceAndTellsItsHistory) {
    std::set<std::string> classes;
    for (const ShelfItem& item : shelf()) {
        const auto lens = find_lens(std::string(item.name)).value().lens;
        EXPECT_EQ(lens.id, item.name);
        EXPECT_FALSE(lens.name.empty()) << item.name;
        EXPECT_GT(lens.source.size(), 10u) << item.name;
        EXPECT_GT(lens.history.size(), 80u) << item.name;
        classes.insert(lens.kind);
    }
    for (const char* kind : {"petzval", "triplet", "tessar", "double gauss", "telephoto",
                             "retrofocus wide angle", "fisheye", "ernostar", "landscape lens", "phone lens"})
        EXPECT_TRUE(classes.contains(kind)) << kind;
}

TEST(Shelf, ALensIsFoundByItsIdAtTheSourceToo) {
    EXPECT_EQ(find_lens("kodak-petzval-us2500046")->lens.id, "petzval-projection");
    EXPECT_EQ(find_lens("petzval-projection")->lens.id, "petzval-projection");
}

TEST(Shelf, ALensIsFoundByTheNamesThatPeopleUse) {
    for (const auto& [given, id] : {std::pair("Biotar", "biotar"),
                                    {"helios", "biotar"},
                                    {"Helios 44-2", "biotar"},
                                    {"speed panchro", "speed-panchro"},
                                    {"Planar", "planar"},
                                    {"SONNAR", "sonnar-fe-55"},
                                    {"Super-Takumar", "takumar"},
                                    {"Nikkor 50mm f/1.4", "nikkor-50-14"}})
        EXPECT_EQ(find_lens(given).value().lens.id, id) << given;
}

TEST(Shelf, NoTwoLensesShareAName) {
    std::set<std::string> all;
    for (const ShelfItem& item : shelf()) {
        const auto lens = find_lens(std::string(item.name)).value().lens;
        for (const std::string& name : lens.names) {
            EXPECT_TRUE(all.insert(name).second) << name;
            EXPECT_EQ(find_lens(name).value().lens.id, lens.id) << name;
        }
    }
}

TEST(Shelf, AnUnknownNameIsRefusedWithTheListOfKnownOnes) {
    const auto refused = find_lens("sonar");
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(refused.error().message.find("\"sonar\""), std::string::npos);
    EXPECT_NE(refused.error().message.find("tessar"), std::string::npos);
}

TEST(Shelf, EveryGlassGivesTheIndexAndAbbeNumberItsCataloguePrints) {
    const auto json = parse_json(glasses_text()).value();
    int checked = 0;
    for (const Json& item : json.find("glasses")->items) {
        const optics::Glass* glass = glass_catalogue().find(item.find("name")->string);
        ASSERT_NE(glass, nullptr);
        EXPECT_FALSE(glass->source.empty());
        const Json* printed = item.find("catalogue");
        if (!printed) continue;
        ++checked;
        EXPECT_NEAR(glass->index(optics::kLineD_um), printed->find("nd")->number, 5e-6) << glass->name;
        EXPECT_NEAR(glass->abbe_number(), printed->find("Vd")->number, 5e-3) << glass->name;
    }
    EXPECT_GE(checked, 60);
}

TEST(Shelf, GlassNamesMatchHoweverProgramsSpellThemButNeverAnotherGlass) {
    for (const char* name : {"N-BK7", "NBK7", "n-bk7", "N_BK7"})
        EXPECT_NE(glass_catalogue().find(name), nullptr) << name;
    EXPECT_NE(glass_catalogue().find("SK16"), glass_catalogue().find("N-SK16"));
    EXPECT_EQ(glass_catalogue().find("BK7"), nullptr);
    EXPECT_EQ(glass_catalogue().similar_names("BK7").front(), "N-BK7");
}

TEST(Shelf, TransmittanceFollowsBeersLawAndTheCatalogue) {
    const optics::Glass* flint = glass_catalogue().find("SF6");
    ASSERT_NE(flint, nullptr);
    ASSERT_FALSE(flint->transmittance.empty());
    const double ten = flint->internal_transmittance(420, 10);
    EXPECT_LT(ten, 0.99);
    EXPECT_NEAR(flint->internal_transmittance(420, 20), ten * ten, 1e-12);
    EXPECT_GT(flint->internal_transmittance(600, 10), ten);
    EXPECT_EQ(optics::Glass{}.internal_transmittance(420, 10), 1);
}

}  // namespace
}  // namespace petzval::lens_files
