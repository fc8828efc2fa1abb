#include "petzval/lens_facts.h"

#include "base/temporary_folder.h"

#include <cmath>
#include <fstream>
#include <set>

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(LensFacts, EveryListedLensHasFacts) {
    std::set<std::string> names;
    int prescriptions = 0;
    for (const LensSummary& summary : lens_list()) {
        SCOPED_TRACE(summary.name);
        EXPECT_TRUE(names.insert(summary.name).second) << "listed twice";
        EXPECT_FALSE(summary.title.empty());
        const auto facts = lens_facts(summary.name);
        ASSERT_TRUE(facts) << facts.error().message;
        EXPECT_EQ(facts->summary.name, summary.name);
        EXPECT_EQ(facts->has_prescription, summary.model == LensModelKind::Prescription);
        if (!facts->has_prescription) continue;
        ++prescriptions;
        EXPECT_EQ(facts->efl_mm, summary.focal_length_mm);
        EXPECT_GE(facts->field.size(), 1u);
        EXPECT_NEAR(facts->efl_mm / facts->entrance_pupil_diameter_mm, facts->f_number, 1e-9);
        EXPECT_EQ(facts->longitudinal_aberration.zones.size(), 10u);
    }
    EXPECT_GE(prescriptions, 12);
    EXPECT_TRUE(names.contains("ideal"));
}

TEST(LensFacts, SumsAreThoseOfTheSurfaces) {
    const auto facts = lens_facts("tessar").value();
    SeidelFacts sum;
    for (const SeidelFacts& s : facts.seidel_per_surface) sum.s1 += s.s1, sum.s5 += s.s5, sum.c2 += s.c2;
    EXPECT_NEAR(sum.s1, facts.seidel.s1, 1e-15);
    EXPECT_NEAR(sum.s5, facts.seidel.s5, 1e-15);
    EXPECT_NEAR(sum.c2, facts.seidel.c2, 1e-15);
}

TEST(LensFacts, ALensHasTheFormatThatIsStatedOrThatItsFieldFills) {
    EXPECT_EQ(lens_facts("preset-ccd-doublet-8mm")->sensor_width_mm, 4.8);
    EXPECT_EQ(lens_facts("doublet-ccd")->sensor_width_mm, 4.8);
    // 37.5 degrees of 100 mm reach 76.7 mm, half the diagonal of 127.7 x 85.1 mm.
    const auto wide = lens_facts("retrofocus").value();
    EXPECT_NEAR(wide.sensor_width_mm, 1.277 * wide.efl_mm, 1e-3 * wide.efl_mm);
    const auto unstated = lens_facts("asphere-singlet").value();
    EXPECT_NEAR(unstated.sensor_width_mm, 0.72 * unstated.efl_mm, 1e-9);
    EXPECT_EQ(lens_facts("ideal")->sensor_width_mm, 0);
}

TEST(LensFacts, AnUnknownNameListsTheLensesAndADamagedFileItsLine) {
    const auto unknown = lens_facts("no-such-lens");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().code, ErrorCode::InvalidArgument);
    EXPECT_NE(unknown.error().message.find("double-gauss"), std::string::npos);
    EXPECT_NE(lens_facts("tess").error().message.find("near it: tessar, tessar-laikin"), std::string::npos);

    const test::TemporaryFolder folder;
    const std::string path = folder / "lens.json";
    std::ofstream(path) << "{\"surfaces\": [\n{\"radius\": 5,, }]}";
    const auto damaged = lens_facts(path);
    ASSERT_FALSE(damaged);
    EXPECT_EQ(damaged.error().code, ErrorCode::InvalidFile);
    EXPECT_NE(damaged.error().message.find(path + ": line 2"), std::string::npos) << damaged.error().message;
}

TEST(LensFacts, APlaneParallelPlateIsNoLens) {
    const test::TemporaryFolder folder;
    const std::string path = folder / "lens.json";
    std::ofstream(path) << R"({"aperture": {"type": "EPD", "value": 5}, "surfaces": [
        {"radius": null, "thickness": 5, "medium": {"nd": 1.5}}, {"radius": null, "thickness": 5}]})";
    const auto plate = lens_facts(path);
    ASSERT_FALSE(plate);
    EXPECT_EQ(plate.error().code, ErrorCode::InvalidFile);
    EXPECT_NE(plate.error().message.find("no power"), std::string::npos);
}

TEST(LensFacts, ANearObjectIsReportedWithItsMagnification) {
    // A thin lens of f = 100 at 2 f images at 2 f, upside down, at its own size.
    const test::TemporaryFolder folder;
    const std::string path = folder / "lens.json";
    std::ofstream(path)
        << R"({"object": 200, "max_object_height": 10, "aperture": {"type": "OBJECT_NA", "value": 0.02},
        "surfaces": [{"radius": 51.68, "thickness": 0, "medium": {"nd": 1.5168, "Vd": 64.2}, "stop": true},
        {"radius": null, "thickness": 200}]})";
    const auto facts = lens_facts(path);
    ASSERT_TRUE(facts) << facts.error().message;
    EXPECT_NEAR(facts->magnification, -1, 1e-9);
    EXPECT_NEAR(facts->image_distance_mm, 200, 1e-9);
    EXPECT_NEAR(facts->entrance_pupil_diameter_mm, 2 * 200 * std::tan(std::asin(0.02)), 1e-9);
    EXPECT_NEAR(facts->field.back().image_height_mm, 10, 0.05);  // with some distortion, stop on the lens
}

TEST(LensFacts, OrderedListsEndWithLensesWithoutTheNumber) {
    std::vector<LensSummary> lenses(3);
    lenses[0].name = "b", lenses[0].f_number = 4, lenses[0].year = "1902";
    lenses[1].name = "c";  // no numbers
    lenses[2].name = "a", lenses[2].f_number = 2, lenses[2].focal_length_mm = 50, lenses[2].year = "1896";
    const auto names = [&](LensOrder order) {
        std::string text;
        for (const LensSummary& lens : in_order(lenses, order)) text += lens.name;
        return text;
    };
    EXPECT_EQ(names(LensOrder::Shelf), "bca");
    EXPECT_EQ(names(LensOrder::Name), "abc");
    EXPECT_EQ(names(LensOrder::Year), "abc");
    EXPECT_EQ(names(LensOrder::FNumber), "abc");
    EXPECT_EQ(names(LensOrder::FocalLength), "abc");
}

}  // namespace
}  // namespace petzval
