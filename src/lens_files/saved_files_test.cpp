// Files as the programs themselves save them, with all that stands around a lens. The triplet is the
// well-known 50 mm f/5 of 20 degrees, its numbers facts; its first-order values were computed from them apart
// from this code.
#include "lens_files/lens_file.h"
#include "optics/paraxial.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace petzval::lens_files {
namespace {

// A Zemax file; `surface_head` and `tail` stand in every surface.
std::string zemax_triplet(const std::string& aperture = "ENPD 1.0E+1", const std::string& unit = "MM",
                          const std::string& flint = "F2 0 0 1.62 36.37 0 0 0 0 0 0",
                          const std::string& type = "  TYPE STANDARD\n") {
    std::string text =
        "VERS 180120 258 30000 L30000\nMODE SEQ\nNAME A SIMPLE COOKE TRIPLET.\nPFIL 0 0 0\n"
        "LANG 0\nUNIT " +
        unit + " X W X CM MR CPMM\n" + aperture +
        "\nENVD 2.0E+1 1 0\nGFAC 0 0\nGCAT SCHOTT MISC\nRAIM 0 0 1 1 0 0 0 0 0 1\n"
        "PUSH 0 0 0 0 0 0\nSDMA 0 1 0\nFTYP 0 0 3 3 0 0 0 1\nROPD 2\nPICB 1\n"
        "XFLN 0 0 0 0\nYFLN 0 1.4E+1 2.0E+1 0\nFWGN 1 1 1 1\nVDXN 0 0 0 0\nVDYN 0 0 0 0\n"
        "VCXN 0 0 0 0\nVCYN 0 0 0 0\nVANN 0 0 0 0\nWAVM 1 4.861327E-1 1\n"
        "WAVM 2 5.875618E-1 1\nWAVM 3 6.562725E-1 1\nWAVM 4 5.5E-1 1\nPWAV 2\n"
        "POLS 1 0 1 0 0 1 0\nGLRS 1 0\nNSCD 100 500 0 1.0E-3 5 1.0E-6 0 0\n"
        "COFN COATING.DAT SCATTER_PROFILE.DAT ABG_DATA.DAT PROFILE.GRD\n";
    const struct {
        const char *curvature, *thickness, *glass, *radius;
    } surfaces[] = {{"0.0", "INFINITY", "", "0"},
                    {"4.542803805E-2", "3.25", "SK16 0 0 1.62041 60.32 0 0 0 0 0 0", "9.5"},
                    {"-2.2944304E-3", "6.0", "", "9.5"},
                    {"-4.501755E-2", "1.0", "F2", "5"},
                    {"4.928055E-2", "4.75", "", "5"},
                    {"1.254904E-2", "3.0", "SK16 0 0 1.62041 60.32 0 0 0 0 0 0", "7.5"},
                    {"-5.436008E-2", "4.22E+1", "", "7.5"},
                    {"0.0", "0", "", "18.2"}};
    for (int i = 0; i < 8; ++i) {
        const auto& s = surfaces[i];
        text += "SURF " + std::to_string(i) + "\n" + (i == 4 ? "  STOP\n" : "") + type +
                "  FIMP \n\n  CURV " + s.curvature +
                " 1 0 0 0 \"\"\n  HIDE 0 0 0 0 0 0\n  MIRR 2 0\n  SLAB 1\n  COMM element\n" + "  DISZ " +
                s.thickness + "\n";
        const std::string glass = std::string(s.glass) == "F2" ? flint : s.glass;
        if (!glass.empty()) text += "  GLAS " + glass + "\n";
        text += std::string("  DIAM ") + s.radius + " 1 0 0 1 \"\"\n  MAZH 0 0\n  POPS 0 0 0 0 0 0 0 0 1 1\n";
    }
    return text +
           "TOL TOFF   0   0              0              0   0 0 0 0 0\nMNUM 1 1\n"
           "MOFF   0   1 \"\" 0 0 0 1 1 0 0.0 \"\" 0\n";
}

// EFL from an independent paraxial trace with the same radii and catalogue indices at the d line.
double efl_of_triplet(double crown, double flint) {
    const double c[] = {4.542803805e-2, -2.2944304e-3, -4.501755e-2, 4.928055e-2, 1.254904e-2, -5.436008e-2};
    const double t[] = {3.25, 6, 1, 4.75, 3, 0}, n[] = {1, crown, 1, flint, 1, crown, 1};
    double y = 1, nu = 0;
    for (int i = 0; i < 6; ++i) {
        nu -= y * (n[i + 1] - n[i]) * c[i];
        y += t[i] * nu / n[i + 1];
    }
    return -1 / nu;
}

double efl(const LensFile& file) {
    return optics::first_order(file.lens, file.lens.primary_um)->focal_length_mm;
}

LensFile read(const std::string& text) {
    const auto file = read_lens(text, "saved");
    EXPECT_TRUE(file) << file.error().message;
    return file ? *file : LensFile{};
}

std::string refusal(const std::string& text) {
    const auto file = read_lens(text, "saved");
    return file ? "read without complaint" : file.error().message;
}

TEST(SavedZemax, ATripletAsSavedIsTheTriplet) {
    const LensFile file = read(zemax_triplet());
    EXPECT_NEAR(efl(file), efl_of_triplet(1.62041, 1.62004), 2e-3);
    EXPECT_EQ(file.lens.surfaces.size(), 6u);
    EXPECT_EQ(file.lens.stop, 3);
    EXPECT_EQ(file.lens.aperture, 10);
    EXPECT_EQ(file.lens.field, 20);
    EXPECT_EQ(file.lens.surfaces[2].clear_radius_mm, 5);
    EXPECT_EQ(file.warnings.size(), 1u) << "what is ignored, in one line";
}

TEST(SavedZemax, InchesFNumbersAndFloatingStopsAreRead) {
    EXPECT_NEAR(efl(read(zemax_triplet("ENPD 1.0E+1", "IN"))), 25.4 * efl_of_triplet(1.62041, 1.62004), 0.05);
    const LensFile by_number = read(zemax_triplet("FNUM 5.0 0"));
    EXPECT_NEAR(optics::first_order(by_number.lens, by_number.lens.primary_um)->f_number, 5, 1e-9);
    const LensFile floating = read(zemax_triplet("FLOA"));
    EXPECT_EQ(floating.lens.aperture_kind, optics::ApertureKind::StopRadius);
    EXPECT_EQ(floating.lens.aperture, 5);
}

TEST(SavedZemax, ModelGlassAndUnknownGlassWithNumbersAreReadWithAWarning) {
    for (const char* flint :
         {"___BLANK 1 0 1.62004 36.37 0 0 0 0 0 0", "FROBNIUM 0 0 1.62004 36.37 0 0 0 0 0 0"}) {
        const LensFile file = read(zemax_triplet("ENPD 10", "MM", flint));
        EXPECT_NEAR(efl(file), efl_of_triplet(1.62041, 1.62004), 2e-3) << flint;
        EXPECT_GE(file.warnings.size(), 2u) << flint;
    }
    EXPECT_NE(refusal(zemax_triplet("ENPD 10", "MM", "FROBNIUM 0 0 0 0 0 0 0 0 0 0")).find("FROBNIUM"),
              std::string::npos);
}

TEST(SavedZemax, WithoutTypesItIsTheSameLens) {
    EXPECT_EQ(efl(read(zemax_triplet("ENPD 10", "MM", "F2 0 0 1.62 36.37", ""))), efl(read(zemax_triplet())));
}

TEST(SavedZemax, MirrorsAndTiltsAreErrorsThatNameTheLine) {
    const std::string mirror = refusal(zemax_triplet("ENPD 10", "MM", "MIRROR 0 0 1.5 40"));
    EXPECT_NE(mirror.find("line "), std::string::npos);
    EXPECT_NE(mirror.find("mirror"), std::string::npos);
    const std::string tilt = refusal(zemax_triplet("ENPD 10", "MM", "F2", "  TYPE COORDBRK\n"));
    EXPECT_NE(tilt.find("line "), std::string::npos);
    EXPECT_NE(tilt.find("COORDBRK"), std::string::npos);
}

TEST(SavedZemax, OfSeveralConfigurationsTheSavedOneIsReadAndSaid) {
    std::string text = zemax_triplet();
    text.replace(text.find("MNUM 1 1"), 8, "MNUM 2 1\nTHIC   4   1 4.75 0\nTHIC   4   2 5.5 0");
    const LensFile file = read(text);
    EXPECT_EQ(efl(file), efl(read(zemax_triplet())));
    ASSERT_EQ(file.warnings.size(), 2u);
    EXPECT_NE(file.warnings[0].find("configurations"), std::string::npos);
    EXPECT_EQ(file.warnings[1].find("THIC"), std::string::npos) << "it has an effect elsewhere";
}

TEST(SavedZemax, AFileThatEndsTooSoonIsRefused) {
    const std::string whole = zemax_triplet();
    int refused = 0;
    for (const char* surface : {"SURF 2", "SURF 3", "SURF 4", "SURF 5", "SURF 6"})
        for (const char* last : {"  HIDE", "  DIAM"}) {  // after the curvature, and after thickness and glass
            const std::string text = whole.substr(0, whole.find(last, whole.find(surface)));
            const std::string answer = refusal(text);
            if (answer.find("line ") != std::string::npos) ++refused;
        }
    // Cut after a thickness behind which there is air, what is left looks like a lens and its image.
    EXPECT_EQ(refused, 7);
}

// The same triplet with everything that CODE V writes around it.
std::string code_v_triplet(const std::string& aperture = "EPD 10.0", const std::string& unit = "M",
                           const std::string& flint = "F2_SCHOTT") {
    return "! saved from a session\nRDM;LEN       \"VERSION: 10.2       LENS VERSION: 25\"\n"
           "TITLE 'Triplet'\n" +
           aperture + "\nDIM   " + unit +
           "\nWL    656.2725 587.5618 486.1327\nREF   2\nWTW   1 2 1\nINI   'abc'\nXAN   0.0 0.0 0.0\n"
           "YAN   0.0 14.0 20.0\nWTF   1.0 1.0 1.0\nVUX   0.0 0.0 0.0\nVLX   0.0 0.0 0.0\n"
           "VUY   0.0 0.1 0.2\nVLY   0.0 0.1 0.2\nPFR   1.0 1.0 1.0\nPTP   0.0 0.0 0.0\nPOR   0.0 0.0 0.0\n"
           "SO    0.0 0.1e14\nS     22.01283 3.25 SK16_SCHOTT\n  SLB \"front\"\n  CCY 0; THC 0\n"
           "S     -435.8380 6.0\nS     -22.21356 1.0 " +
           flint +
           "\nS     20.29198 4.75\n  STO\n  CIR 5.0\nS     79.68737 3.0 SK16_SCHOTT\n"
           "S     -18.39585 42.2\n  PIM\nSI    0.0 0.0\nGO\n";
}

TEST(SavedCodeV, ATripletAsSavedIsTheTriplet) {
    const LensFile file = read(code_v_triplet());
    EXPECT_NEAR(efl(file), efl_of_triplet(1.62041, 1.62004), 5e-3);
    EXPECT_EQ(file.lens.stop, 3);
    EXPECT_EQ(file.lens.surfaces[3].clear_radius_mm, 5);
    EXPECT_EQ(file.lens.field, 20);
    EXPECT_NEAR(efl(read(code_v_triplet("FNO 5", "I"))), 25.4 * efl(file), 1e-6);
    EXPECT_NEAR(efl(read(code_v_triplet("FNO 5", "C"))), 10 * efl(file), 1e-6);
    EXPECT_NEAR(efl(read(code_v_triplet("EPD 10", "M", "620.364"))), efl(file), 7e-3) << "a glass code";
}

TEST(SavedCodeV, OfAZoomTheFirstPositionIsReadAndSaid) {
    std::string text = code_v_triplet();
    text.replace(text.find("GO\n"), 3, "ZOO 2\nZOO THI S4 4.75 5.5\nGO\n");
    const LensFile file = read(text);
    EXPECT_EQ(efl(file), efl(read(code_v_triplet())));
    EXPECT_TRUE(std::any_of(file.warnings.begin(), file.warnings.end(),
                            [](const std::string& w) { return w.find("zoom") != std::string::npos; }));
}

TEST(SavedCodeV, TheStopMayBeNamedByNumber) {
    std::string text = code_v_triplet();
    text.replace(text.find("  STO\n"), 6, "");
    text.replace(text.find("GO\n"), 3, "");
    const auto with = [&](const std::string& line) {
        std::string whole = text;
        return whole.insert(whole.find("SI "), line + "\n");
    };
    EXPECT_EQ(read(with("STO S4")).lens.stop, 3);
    EXPECT_EQ(read(with("STO 2")).lens.stop, 1);
    for (const char* wrong : {"STO S9", "STO S0", "STO SX", "STO 1.5"})
        EXPECT_NE(refusal(with(wrong)).find("line 31"), std::string::npos) << refusal(with(wrong));
}

TEST(SavedCodeV, MirrorsUnknownGlassAndUnknownWordsAreErrorsThatNameTheLine) {
    EXPECT_NE(refusal(code_v_triplet("EPD 10", "M", "REFL")).find("line 25"), std::string::npos);
    EXPECT_NE(refusal(code_v_triplet("EPD 10", "M", "FROBNIUM")).find("line 25"), std::string::npos);
    EXPECT_NE(refusal(code_v_triplet("FROB 10")).find("line 4"), std::string::npos);
}

TEST(SavedPbrt, AnotherCountOfNumbersIsSaidWithItsLine) {
    EXPECT_NE(refusal("29.475 3.76 1.67 25.2 60\n").find("line 1: a pbrt lens has four numbers"),
              std::string::npos);
    EXPECT_NE(refusal("# a lens\n29.475 3.76 1.67\n").find("line 2: a pbrt lens has four numbers"),
              std::string::npos);
}

TEST(SavedPbrt, CommentsTabsAndCarriageReturnsDoNotMatter) {
    const std::string plain =
        "29.475 3.76 1.67 25.2\n84.83 0.12 1 25.2\n19.275 4.025 1.67 23\n40.77 3.275 1.699 23\n"
        "12.75 5.705 1 18\n0 4.5 0 17.1\n-14.495 1.18 1.603 17\n40.77 6.065 1.658 20\n"
        "-20.385 0.19 1 20\n437.065 3.22 1.717 20\n-39.73 0 1 20\n";
    std::string other = "# a comment\r\n\r\n";
    for (const char c : plain)
        other += c == ' ' ? std::string("\t ") : c == '\n' ? " # end\r\n" : std::string(1, c);
    EXPECT_EQ(efl(read(plain)), efl(read(other)));
    EXPECT_EQ(read(plain).lens.stop, 5);
    EXPECT_NEAR(read(plain).lens.surfaces[5].clear_radius_mm, 17.1 / 2, 1e-12) << "the format has diameters";
}

}  // namespace
}  // namespace petzval::lens_files
