#include "lens_files/lens_file.h"

#include "lens_files/sample_texts.h"
#include "lens_files/shelf.h"
#include "optics/paraxial.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace petzval::lens_files {
namespace {

using optics::Prescription;

double focal_length(const Prescription& lens) {
    return optics::first_order(lens, lens.primary_um)->focal_length_mm;
}

LensFile read(const std::string& text) {
    const auto file = read_lens(text, "test");
    EXPECT_TRUE(file) << file.error().message;
    return file ? *file : LensFile{};
}

std::string refusal(const std::string& text) {
    const auto file = read_lens(text, "test");
    return file ? "read without complaint" : file.error().message;
}

bool warns(const LensFile& file, const std::string& part) {
    return std::any_of(file.warnings.begin(), file.warnings.end(),
                       [&](const std::string& w) { return w.find(part) != std::string::npos; });
}

// A lens with named glass, aspheres, a conic, a separate stop, clear apertures.
Prescription rich_lens() {
    Prescription lens = find_lens("double-gauss-sample-f2")->lens;
    lens.surfaces[0].conic = -0.3;
    lens.surfaces[0].asphere = {{4, 1e-7}, {6, -2e-11}, {8, 3e-15}};
    return lens;
}

void expect_same_glass_and_shape(const Prescription& a, const Prescription& b) {
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    EXPECT_EQ(a.stop, b.stop);
    for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
        SCOPED_TRACE(testing::Message() << "surface " << i);
        const optics::Surface &p = a.surfaces[i], &q = b.surfaces[i];
        EXPECT_NEAR(p.curvature_per_mm, q.curvature_per_mm, 1e-15);
        EXPECT_NEAR(p.thickness_mm, q.thickness_mm, 1e-12);
        EXPECT_EQ(p.conic, q.conic);
        EXPECT_NEAR(p.clear_radius_mm, q.clear_radius_mm, 1e-12);
        ASSERT_EQ(p.asphere.size(), q.asphere.size());
        for (std::size_t k = 0; k < p.asphere.size(); ++k) {
            EXPECT_EQ(p.asphere[k].power, q.asphere[k].power);
            EXPECT_EQ(p.asphere[k].coefficient, q.asphere[k].coefficient);
        }
        for (const double w : {0.45, 0.55, 0.65}) EXPECT_EQ(p.after.index(w), q.after.index(w));
    }
}

TEST(LensFile, ZemaxRoundTripKeepsTheLens) {
    const Prescription lens = rich_lens();
    const LensFile file = read(as_zmx(lens));
    EXPECT_EQ(file.format, "Zemax .zmx");
    expect_same_glass_and_shape(lens, file.lens);
    EXPECT_EQ(file.lens.aperture, lens.aperture);
    EXPECT_EQ(file.lens.field, lens.field);
    EXPECT_EQ(file.lens.primary_um, lens.primary_um);
    EXPECT_EQ(file.lens.short_um, lens.short_um);
    EXPECT_EQ(file.lens.long_um, lens.long_um);
    EXPECT_TRUE(warns(file, "HIDE")) << "what is ignored is said";
}

TEST(LensFile, CodeVRoundTripKeepsTheLens) {
    const Prescription lens = rich_lens();
    const LensFile file = read(as_seq(lens));
    EXPECT_EQ(file.format, "CODE V .seq");
    expect_same_glass_and_shape(lens, file.lens);
    EXPECT_EQ(file.lens.aperture, lens.aperture);
    EXPECT_NEAR(file.lens.short_um, lens.short_um, 1e-15);
    EXPECT_EQ(file.lens.name, lens.name);
}

TEST(LensFile, OpticalBenchRoundTripKeepsTheLens) {
    Prescription lens = rich_lens();
    lens.aperture_kind = optics::ApertureKind::FNumber;
    lens.aperture = 2;
    const LensFile file = read(as_optical_bench(lens));
    EXPECT_EQ(file.format, "Optical Bench");
    expect_same_glass_and_shape(lens, file.lens);
    EXPECT_EQ(file.lens.field, lens.field);
    EXPECT_EQ(file.lens.aperture, 2);
}

TEST(LensFile, PbrtRoundTripKeepsTheGeometryAndSaysThatColourIsLost) {
    const Prescription lens = find_lens("double-gauss")->lens;
    const LensFile file = read(as_pbrt(lens));
    EXPECT_EQ(file.format, "pbrt .dat");
    EXPECT_NEAR(focal_length(file.lens), focal_length(lens), 1e-12);
    EXPECT_EQ(file.lens.aperture, 8.55);
    EXPECT_FALSE(file.lens.dispersion_known);
    EXPECT_TRUE(warns(file, "no colour"));
    EXPECT_TRUE(warns(file, "36 x 24"));
}

TEST(LensFile, AnyTextEncodingReadsTheSame) {
    const std::string plain = as_zmx(rich_lens());
    const double expected = focal_length(read(plain).lens);
    for (const bool little : {true, false})
        for (const bool mark : {true, false})
            EXPECT_EQ(focal_length(read(as_utf16(plain, little, mark)).lens), expected) << little << mark;
    EXPECT_EQ(focal_length(read("\xEF\xBB\xBF" + plain).lens), expected);
    std::string latin1 = plain;
    latin1.insert(latin1.find("NAME ") + 5, "Ang\xE9nieux ");
    EXPECT_EQ(focal_length(read(latin1).lens), expected);
    EXPECT_EQ(read(latin1).lens.name.substr(0, 10), "Ang\xC3\xA9nieux");
    std::string dos;
    for (const char c : plain) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(focal_length(read(dos).lens), expected);
}

TEST(LensFile, ZemaxWithoutTypeAndWithEmbeddedModelGlassIsRead) {
    const std::string text =
        "VERS 1\nENPD 10\nUNIT MM\nFTYP 0 0 1 1\nYFLN 5\nWAVM 1 0.5875618 1\nSURF 0\n  DISZ INFINITY\nSURF "
        "1\n  STOP\n"
        "  CURV 0.02\n  DISZ 4\n  GLAS ___BLANK 1 0 1.6 50 0 0 0\n  DIAM 6\nSURF 2\n  CURV -0.02\n  DISZ "
        "40\n  DIAM 6\n"
        "  PARM 2 1e-6\nSURF 3\n  DISZ 0\n";
    const LensFile file = read(text);
    EXPECT_NEAR(file.lens.surfaces[0].after.index(optics::kLineD_um), 1.6, 1e-12);
    EXPECT_NEAR(file.lens.surfaces[0].after.abbe_number(), 50, 1e-9);
    ASSERT_EQ(file.lens.surfaces[1].asphere.size(), 1u);
    EXPECT_EQ(file.lens.surfaces[1].asphere[0].power, 4);
    EXPECT_TRUE(warns(file, "TYPE"));
    EXPECT_TRUE(warns(file, "one wavelength"));
}

TEST(LensFile, ZemaxUnitsAndAperturesOfTheStopAreConverted) {
    const std::string text =
        "MODE SEQ\nUNIT IN X\nFLOA\nSURF 0\n DISZ INFINITY\nSURF 1\n TYPE STANDARD\n CURV 1.0\n DISZ 0.1\n "
        "GLAS N-BK7 0 0 1.5 40\n"
        " STOP\n DIAM 0.25\nSURF 2\n TYPE STANDARD\n CURV 0\n DISZ 1\nSURF 3\n TYPE STANDARD\n";
    const LensFile file = read(text);
    EXPECT_NEAR(file.lens.surfaces[0].curvature_per_mm, 1 / 25.4, 1e-15);
    EXPECT_EQ(file.lens.aperture_kind, optics::ApertureKind::StopRadius);
    EXPECT_NEAR(file.lens.aperture, 6.35, 1e-12);
}

TEST(LensFile, CodeVCurvatureModeGlassCodesAndPrivateGlassAreRead) {
    const LensFile file = read(
        "LEN NEW\nRDM N\nPRV\n PWL 656.27 587.56 486.13\n 'MYGLASS' 1.5143 1.5168 1.5224\nEND\nEPD 5; DIM M\n"
        "WL 587.56\nYAN 3\nso 0 1e11\ns 0.02 3.0 516800.641700\nsto\ns -0.02 2 517.642\ns 0 1 617366\ns 0 1 "
        "'MYGLASS'\n"
        "s 0.01 50 air\nsi 0 -0.1\ngo\n");
    const auto& s = file.lens.surfaces;
    ASSERT_EQ(s.size(), 5u);
    EXPECT_NEAR(s[0].after.index(optics::kLineD_um), 1.5168, 1e-12);
    EXPECT_NEAR(s[0].after.abbe_number(), 64.17, 1e-9);
    EXPECT_NEAR(s[1].after.index(optics::kLineD_um), 1.517, 1e-12);
    EXPECT_NEAR(s[1].after.abbe_number(), 64.2, 1e-9);
    EXPECT_NEAR(s[2].after.index(optics::kLineD_um), 1.617, 1e-12);
    EXPECT_NEAR(s[2].after.abbe_number(), 36.6, 1e-9);
    EXPECT_NEAR(s[3].after.index(0.48613), 1.5224, 1e-9);
    EXPECT_NEAR(s[3].after.index(0.65627), 1.5143, 1e-9);
    EXPECT_TRUE(warns(file, "defocused by -0.1"));
}

TEST(LensFile, CodeVRadiiWithoutTheirModeAreDoubted) {
    const std::string surfaces = "EPD 5\nSO 0 1e11\nS 25 3 517.642\nSTO\nS -25 40\nSI 0 0\n";
    EXPECT_TRUE(warns(read("LEN NEW\n" + surfaces), "put RDM"));
    EXPECT_FALSE(warns(read("RDM;LEN\n" + surfaces), "put RDM"));
}

TEST(LensFile, CodeVUnitsHoldForWhatStandsBeforeThem) {
    const LensFile file = read(
        "RDM\nEPD 1\nYOB 0.5\nDIM I\nSO 0 10\nS 2 0.1 NBK7_SCHOTT\n STO\n CIR EDG 0.7\n"
        "S 0 3 AIR\n CIR EDG 0.8\n CIR 0.6\nSI 0 0\nGO\n");
    EXPECT_NEAR(file.lens.aperture, 25.4, 1e-12);
    EXPECT_NEAR(file.lens.field, 12.7, 1e-12);
    EXPECT_NEAR(file.lens.object_distance_mm, 254, 1e-12);
    EXPECT_NEAR(file.lens.surfaces[0].clear_radius_mm, 0.7 * 25.4, 1e-12);
    EXPECT_NEAR(file.lens.surfaces[1].clear_radius_mm, 0.6 * 25.4,
                1e-12);  // the clear aperture, not the edge
}

TEST(LensFile, OpticalBenchOddTermsStandBetweenTheEvenOnes) {
    const std::string head =
        "[constants]\nAsphericalOddCount\t2\n[variable distances]\nF-Number\t4\nd0\tInfinity\n[lens data]\n"
        "1\t50\t5\t1.5168\t20\t64.2\n2\tAS\t1\t\t18\n3\t-50\t40\t\t20\n[aspherical data]\n";
    const LensFile file = read(head + "1\t50\t0.5\t1e-5\t2e-6\t3e-7\t4e-8\t5e-9\n");
    const auto& terms = file.lens.surfaces[0].asphere;
    ASSERT_EQ(terms.size(), 5u);
    const int powers[] = {3, 4, 5, 6, 8};
    for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(terms[k].power, powers[k]);
    EXPECT_EQ(file.lens.surfaces[0].conic, 0.5);
    EXPECT_EQ(file.lens.stop, 1);
}

TEST(LensFile, JsonMayBringItsOwnGlassAndUnits) {
    const std::string text =
        R"({"units": "in", "glasses": [{"name": "MINE", "formula": "sellmeier", "constant": 1,
        "B": [1.25], "C_um2": [0.01]}], "aperture": {"type": "F_NUMBER", "value": 4}, "max_field_deg": 5, "surfaces": [
        {"radius": 2, "thickness": 0.2, "medium": {"glass": "mine"}, "stop": true},
        {"radius": null, "thickness": 3, "medium": "air", "asphere_even": {"A4": 1e-3}}]})";
    const LensFile file = read(text);
    EXPECT_NEAR(file.lens.surfaces[0].curvature_per_mm, 1 / 50.8, 1e-15);
    EXPECT_NEAR(file.lens.surfaces[0].after.index(0.5), std::sqrt(1 + 1.25 * 0.25 / 0.24), 1e-15);
    EXPECT_NEAR(file.lens.surfaces[1].asphere[0].coefficient, 1e-3 * std::pow(25.4, -3), 1e-20);
    EXPECT_TRUE(warns(file, "vignettes nothing"));
}

TEST(LensFile, WavelengthsOfJsonRise) {
    const auto text = [](const std::string& shortest, const std::string& longest) {
        return R"({"wavelengths_um": {"short": )" + shortest + R"(, "primary": 0.55, "long": )" + longest +
               R"(}, "aperture": {"type": "F_NUMBER", "value": 8}, "surfaces": [
        {"radius": 50, "thickness": 3, "medium": {"nd": 1.5, "Vd": 60}},
        {"radius": -50, "thickness": 90, "medium": "air", "stop": true}]})";
    };
    EXPECT_EQ(read(text("0.45", "0.65")).lens.long_um, 0.65);
    EXPECT_NE(refusal(text("0.65", "0.45")).find("must rise"), std::string::npos);
    EXPECT_NE(refusal(text("0.6", "0.65")).find("must rise"), std::string::npos);
}

TEST(LensFile, ACylinderIsReadAndHasNoOtherRadius) {
    const auto text = [](const std::string& radius) {
        return R"({"units": "mm", "aperture": {"type": "F_NUMBER", "value": 8}, "surfaces": [
        {"radius": )" +
               radius + R"(, "cylinder_radius": -25, "thickness": 3, "medium": {"nd": 1.5, "Vd": 60}},
        {"radius": -40, "thickness": 90, "medium": "air", "stop": true}]})";
    };
    const LensFile file = read(text("null"));
    EXPECT_EQ(file.lens.surfaces[0].cylinder_per_mm, -1.0 / 25);
    EXPECT_EQ(file.lens.surfaces[0].curvature_per_mm, 0);
    EXPECT_EQ(file.lens.surfaces[1].cylinder_per_mm, 0);
    EXPECT_NE(refusal(text("50")).find("surface 1: a cylinder has no radius"), std::string::npos)
        << refusal(text("50"));
}

TEST(LensFile, ANearObjectIsReadWithItsHeight) {
    const std::string surfaces = R"("aperture": {"type": "EPD", "value": 4}, "surfaces": [
        {"radius": 50, "thickness": 2, "medium": {"nd": 1.5, "Vd": 60}}, {"radius": -50, "thickness": 90}])";
    const LensFile file = read("{\"object\": {\"distance\": 120, \"height\": 7}, " + surfaces + "}");
    EXPECT_EQ(file.lens.object_distance_mm, 120);
    EXPECT_EQ(file.lens.field_kind, optics::FieldKind::ObjectHeight);
    EXPECT_EQ(file.lens.field, 7);
    EXPECT_EQ(read("{\"object\": 80, " + surfaces + "}").lens.object_distance_mm, 80);
    EXPECT_TRUE(std::isinf(read("{\"object\": \"infinity\", " + surfaces + "}").lens.object_distance_mm));
    EXPECT_NE(refusal("{\"object\": \"far\", " + surfaces + "}").find("\"object\""), std::string::npos);
}

TEST(LensFile, ErrorsNameTheFileTheLineAndWhatIsNotUnderstood) {
    const std::string zmx = as_zmx(rich_lens()), seq = as_seq(rich_lens()),
                      bench = as_optical_bench(rich_lens());
    const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return text.replace(at, from.size(), to);
    };
    const std::pair<std::string, std::vector<std::string>> cases[] = {
        {"", {"test", "empty"}},
        {"once upon a time", {"test: line 1", "not a lens file"}},
        {replaced(zmx, "N-SSK2", "N-SSK9"), {"line 27", "N-SSK9", "near it", "N-SSK2"}},
        {replaced(zmx, "TYPE EVENASPH", "TYPE COORDBRK"), {"line 18", "COORDBRK"}},
        {replaced(zmx, "GLAS N-SK2", "GLAS MIRROR"), {"line", "mirror"}},
        {replaced(zmx, "HIDE 0 0 0", "WOBBLE 1"), {"line 21", "WOBBLE"}},
        {replaced(zmx, "DISZ 8.75", "DISZ 8,75"), {"line", "8,75", "not a number"}},
        {replaced(zmx, "MODE SEQ", "MODE NSC"), {"line 2", "sequential"}},
        {replaced(zmx, "SURF 3", "SURF 7"), {"SURF 3 is expected"}},
        {replaced(seq, "NSK2", "NSK22"), {"NSK22", "N-SK2"}},
        {replaced(seq, "  STO", "  XDE 1.0"), {"line", "XDE"}},
        {replaced(seq, "S 152", "S abc"), {"abc", "not a number"}},
        {replaced(bench, "\tBf\t", "\tBx\t"), {"Bx", "variable distances"}},
        {replaced(bench, "[notes]", "[magic]"), {"[magic]"}},
        {"1 2 3 4\n5 6\n", {"line 2", "four numbers"}},
        {"1 2 1.5 4\n5 6 1 4\n", {"no stop"}},
        {"{\"surfaces\": [{\"radius\": 5, \"thickness\": 1, \"medium\": {\"glass\": \"SK5\"}}]}",
         {"line 1", "SK5", "N-SK5"}},
        {"{\"surfaces\": [\n{\"radius\": 5, \"thickness\": 1, \"tilt_deg\": 4}]}", {"line 2", "tilt_deg"}},
        {"{\"surfaces\": [\n{\"radius\": 5 \"thickness\": 1}]}", {"line 2", "','"}},
        {"{\"lenses\": [{}, {}]}", {"2 lenses", "save one"}},
    };
    for (const auto& [text, parts] : cases)
        for (const std::string& part : parts)
            EXPECT_NE(refusal(text).find(part), std::string::npos)
                << part << " is missing in: " << refusal(text);
}

TEST(LensFile, NumbersNoLensCanHaveAreRefused) {
    const auto lens = [](const std::string& surface, const std::string& aperture = "4") {
        return refusal("{\"aperture\": {\"type\": \"F_NUMBER\", \"value\": " + aperture +
                       "}, \"surfaces\": [" + surface + "]}");
    };
    const std::string good = "{\"radius\": 50, \"thickness\": 1, \"medium\": {\"nd\": 1.5, \"Vd\": 60}}";
    EXPECT_NE(lens("{\"radius\": 0, \"thickness\": 1}").find("radius of 0"), std::string::npos);
    EXPECT_NE(lens("{\"radius\": 1, \"thickness\": 1e300}").find("thickness"), std::string::npos);
    EXPECT_NE(lens("{\"radius\": 1, \"thickness\": 1, \"medium\": {\"nd\": 77}}").find("refractive index"),
              std::string::npos);
    EXPECT_NE(lens(good, "-2").find("aperture is -2"), std::string::npos);
    EXPECT_NE(lens("{\"radius\": 1, \"thickness\": 1, \"semi_aperture\": -3}").find("clear radius"),
              std::string::npos);
}

TEST(LensFile, AMissingFileIsNamed) {
    const auto missing = load_lens_file("/nowhere/at/all.zmx");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::InvalidFile);
    EXPECT_NE(missing.error().message.find("/nowhere/at/all.zmx"), std::string::npos);
    EXPECT_FALSE(load_lens_file("/"));
}

}  // namespace
}  // namespace petzval::lens_files
