#include "lens_files/lens_file.h"
#include "lens_files/shelf.h"
#include "optics/paraxial.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace petzval::lens_files {
namespace {

LensFile read(const std::string& text) {
    auto file = read_lens(text, "pasted");
    EXPECT_TRUE(file) << (file ? "" : file.error().message);
    return file ? *file : LensFile{};
}

std::string refusal(const std::string& text) {
    const auto file = read_lens(text, "pasted");
    return file ? "accepted" : file.error().message;
}

double focal_length(const LensFile& file) {
    return optics::first_order(file.lens, file.lens.primary_um)->focal_length_mm;
}

// US 2,673,491 as a patent prints it; the same numbers ship as double-gauss.
constexpr const char* kTronnier = R"(Double Gauss  f = 50  F/2
No  R        d      nd     V     diameter
1   29.475   3.76   1.67   47.1  25.2
2   84.83    0.12                25.2
3   19.275   4.025  1.67   47.1  23
4   40.77    3.275  1.699  30.1  23
5   12.75    5.705               18
6   stop  ∞  4.5                 17.1
7   −14.495  1.18   1.603  38.0  17
8   40.77    6.065  1.658  57.3  20
9   −20.385  0.19                20
10  437.065  3.22   1.717  48.0  20
11  −39.73   36.1                20
)";

TEST(Table, APatentsTableIsTheLensThatShips) {
    const LensFile file = read(kTronnier);
    EXPECT_EQ(file.format, "table of surfaces");
    const auto shipped = find_lens("double-gauss");
    ASSERT_TRUE(shipped);
    ASSERT_EQ(file.lens.surfaces.size(), shipped->lens.surfaces.size());
    EXPECT_EQ(file.lens.stop, shipped->lens.stop);
    for (std::size_t i = 0; i < file.lens.surfaces.size(); ++i) {
        SCOPED_TRACE(i + 1);
        EXPECT_DOUBLE_EQ(file.lens.surfaces[i].curvature_per_mm, shipped->lens.surfaces[i].curvature_per_mm);
        EXPECT_DOUBLE_EQ(file.lens.surfaces[i].clear_radius_mm, shipped->lens.surfaces[i].clear_radius_mm);
        EXPECT_NEAR(file.lens.surfaces[i].after.index(0.5875618),
                    shipped->lens.surfaces[i].after.index(0.5875618), 1e-9);
    }
    EXPECT_NEAR(focal_length(file), 50.36, 0.01);
}

// The same text with all of these replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

TEST(Table, DashesOfPrintAreMinusSigns) {
    for (const char* dash : {"\u2010", "\u2011", "\u2013", "-"})
        EXPECT_NEAR(focal_length(read(with(kTronnier, "−", dash))), 50.36, 0.01) << dash;
}

TEST(Table, DecimalCommasAreReadInColumnsOfTabsOrSemicolons) {
    for (const char* column : {"\t", ";"}) {
        std::string text = with(kTronnier, "  ", " ");
        while (text.find("  ") != std::string::npos) text = with(text, "  ", " ");
        text = with(with(with(with(text, "f = 50", "f=50"), "Double Gauss ", ""), " ", column), ".", ",");
        const LensFile file = read(text);
        ASSERT_EQ(file.lens.surfaces.size(), 11u);
        EXPECT_NEAR(focal_length(file), 50.36, 0.01);
        EXPECT_EQ(file.lens.surfaces[0].clear_radius_mm, 12.6);
    }
}

TEST(Table, ObjectAndImageAreNoSurfaces) {
    const std::string text =
        with(kTronnier, "1   29.475", "0 inf inf Object\n1   29.475") + "12 inf 0 43 Image\n";
    EXPECT_EQ(read(text).lens.surfaces.size(), 11u);
    EXPECT_EQ(read(with(text, "0 inf inf Object", "OBJ inf inf")).lens.surfaces.size(), 11u);
}

TEST(Table, TheHeadingSaysWhetherDiametersAreHalves) {
    EXPECT_EQ(read(with(kTronnier, "Double Gauss", "Semi-wide lens")).lens.surfaces[0].clear_radius_mm, 12.6);
    for (const char* semi : {"Semi-Diameter", "semi aperture"}) {
        const LensFile file = read(with(kTronnier, "diameter", semi));
        EXPECT_EQ(file.lens.surfaces[0].clear_radius_mm, 25.2);
        EXPECT_NE(std::find_if(file.warnings.begin(), file.warnings.end(),
                               [](const std::string& w) { return w.starts_with("the last column is"); }),
                  file.warnings.end());
    }
}

// Left out, surfaces 2 and 6 would make another lens.
TEST(Table, ALineOfNumbersThatIsNoRowIsRefused) {
    EXPECT_NE(refusal(with(kTronnier, "2   84.83    0.12", "R2  84.83    0.12")).find("line 4: is not a row"),
              std::string::npos);
    const std::string unnumbered = "F/4 stop first\n50 3 1.5 60\n-50 d2 1.6 40\n-80 90\n";
    EXPECT_NE(refusal(unnumbered).find("line 3: is not a row"), std::string::npos) << refusal(unnumbered);
    EXPECT_EQ(read(with(unnumbered, "-50 d2", "# 7 8\nGroup 1\n-50 2")).lens.surfaces.size(), 3u);
}

TEST(Table, AFirstOrLastLineThatIsNoRowIsRefused) {
    EXPECT_NE(refusal(with(kTronnier, "1   29.475", "1*  29.475")).find("line 3: is not a row"),
              std::string::npos);
    EXPECT_NE(refusal(with(kTronnier, "11  −39.73", "11* −39.73")).find("line 13: is not a row"),
              std::string::npos);
    const std::string unnumbered = "F/4 stop first\n50 3 1.5 60\n-50 2\n-80\n";
    EXPECT_NE(refusal(unnumbered).find("line 4: is not a row"), std::string::npos) << refusal(unnumbered);
}

TEST(Table, TheDistanceBehindTheLastSurfaceMayBeMissingOrAWord) {
    const double expected = focal_length(read(kTronnier));
    EXPECT_DOUBLE_EQ(focal_length(read(with(kTronnier, "36.1                20", ""))), expected);
    EXPECT_DOUBLE_EQ(focal_length(read(with(kTronnier, "36.1", "bf"))), expected);
    EXPECT_NE(refusal(with(kTronnier, "5.705", "d5")).find("line 7: the thickness is not a finite number"),
              std::string::npos);
    EXPECT_NE(refusal(with(kTronnier, "6   stop  ∞  4.5", "6   stop  ∞  v")).find("line 8: the thickness"),
              std::string::npos);
}

TEST(Table, LengthsInAnotherUnitAreRefused) {
    for (const char* unit : {"R [cm]", "R(in)", "R in inches", "R (in inches)"})
        EXPECT_NE(refusal(with(kTronnier, "R     ", unit)).find("line 2: lengths in "), std::string::npos)
            << unit;
    EXPECT_EQ(read(with(kTronnier, "R     ", "R [mm]")).lens.surfaces.size(), 11u);
    EXPECT_EQ(read(with(kTronnier, "Double Gauss", "2 inch Gauss")).lens.surfaces.size(), 11u);
}

TEST(Table, LinesBelowAreNamed) {
    const LensFile file = read(std::string(kTronnier) + "after Tronnier\nAspheric: K=0.5 A4=1.2e-5\n");
    EXPECT_EQ(std::count_if(file.warnings.begin(), file.warnings.end(),
                            [](const std::string& w) { return w.starts_with("line 15 below the table"); }),
              1);
}

TEST(Table, ColumnsMayBePartedByTabsCommasOrBars) {
    const double expected = focal_length(read(kTronnier));
    for (const char separator : {',', ';', '|', '\t'}) {
        std::string text = kTronnier;
        const std::size_t rows = text.find("\n1 ");
        for (std::size_t at = rows; at < text.size(); ++at)
            if (text[at] == ' ') text[at] = separator;
        EXPECT_DOUBLE_EQ(focal_length(read(text)), expected) << separator;
    }
}

TEST(Table, TheRowOfTheStopMayHaveNoNumber) {
    std::string counted = kTronnier;
    counted.replace(counted.find("6   stop"), 8, "    stop");
    std::string not_counted = counted;
    for (int number = 7; number <= 11; ++number) {
        const std::string row = "\n" + std::to_string(number) + " ";
        not_counted.replace(not_counted.find(row), row.size(), "\n" + std::to_string(number - 1) + " ");
    }
    for (const std::string& text : {counted, not_counted}) {
        const LensFile file = read(text);
        ASSERT_EQ(file.lens.surfaces.size(), 11u) << text;
        EXPECT_EQ(file.lens.stop, 5);
        EXPECT_DOUBLE_EQ(focal_length(file), focal_length(read(kTronnier))) << text;
    }
}

TEST(Table, AStopThatNoRowMarksIsPutIntoTheWidestGapAndReported) {
    const LensFile file = read("F/3\n50 4 N-BK7\n-50 12\n60 4 N-BK7\n-60 30\n");
    ASSERT_EQ(file.lens.surfaces.size(), 5u);
    EXPECT_EQ(file.lens.stop, 2);
    EXPECT_DOUBLE_EQ(file.lens.surfaces[1].thickness_mm, 6);
    ASSERT_FALSE(file.warnings.empty());
    EXPECT_NE(file.warnings[0].find("behind surface 2"), std::string::npos) << file.warnings[0];
}

TEST(Table, TheNumbersPrintedAboveAreKept) {
    std::string text = kTronnier;
    text.replace(text.find("f = 50"), 6, "f = 75");
    EXPECT_EQ(read(text).printed_focal_length_mm, 75);
    EXPECT_EQ(read(text).printed_f_number, 2);
}

TEST(Table, RefusalsNameTheLine) {
    EXPECT_NE(refusal("F/2\n50 4 N-BK77777\n-50 40\n").find("line 2: glass \"N-BK77777\""),
              std::string::npos);
    EXPECT_NE(refusal("F/2\n50 4 1.5 60 20 9\n-50 40\n").find("line 2: \"9\" was not expected"),
              std::string::npos);
    EXPECT_NE(refusal("50 4 N-BK7\n-50 40\n").find("put \"F/2.8\" above it"), std::string::npos);
}

}  // namespace
}  // namespace petzval::lens_files
