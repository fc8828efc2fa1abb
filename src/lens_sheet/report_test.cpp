#include "petzval/lens_report.h"

#include "base/parallel.h"
#include "lens_sheet/figures.h"

#include <numbers>

#include <gtest/gtest.h>

namespace petzval::lens_sheet {
namespace {

const std::shared_ptr<Workers> g_workers = own_workers();

std::vector<std::string> lens_names() {
    std::vector<std::string> names;
    for (const LensSummary& lens : lens_list()) names.push_back(lens.name);
    return names;
}

Subject subject_of(const std::string& name) {
    auto subject = Subject::make(name, *g_workers);
    EXPECT_TRUE(subject) << name << ": " << subject.error().message;
    return std::move(*subject);
}

// The first fault of a drawing, outside of pictures.
std::string fault_of(const Figure& figure) {
    for (const char* word : {"nan", "inf", "\"\"", "e+", "e-"}) {
        const std::string& text = figure.drawing;
        for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
            const std::size_t uri = text.rfind("base64,", at), quote = text.rfind('"', at);
            if (uri != std::string::npos && uri > quote) continue;
            // In a number: a digit, a sign or the quote of an attribute stands beside it.
            const char before = at > 0 ? text[at - 1] : ' ';
            if (std::string("0123456789 -\"LM").find(before) != std::string::npos &&
                text.substr(at, 5) != "inf f" && text.rfind('>', at) < text.rfind('<', at))
                return text.substr(at > 40 ? at - 40 : 0, 80);
        }
    }
    return figure.drawing.find("<svg") == std::string::npos &&
                   figure.drawing.find("<table") == std::string::npos
               ? "no drawing"
               : "";
}

TEST(Number, IsWrittenAsPeopleDo) {
    EXPECT_EQ(number(1.5, 3), "1.5");
    EXPECT_EQ(number(-0.0001, 2), "0");
    EXPECT_EQ(number(std::nan(""), 2), "–");
    EXPECT_EQ(significant(0.012345), "0.0123");
    EXPECT_EQ(significant(1234.5), "1230");
    EXPECT_EQ(significant(9.996, 3), "10");
    EXPECT_EQ(escaped("a<b & \"c\"\n"), "a&lt;b &amp; &quot;c&quot; ");
    EXPECT_EQ(escaped("-3 µm, f-2 --coma -1"), "−3 µm, f-2 --coma −1");
}

TEST(Base64, AgreesWithRfc4648) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Axial, TableAgreesWithTheLens) {
    const Subject subject = subject_of("doublet");
    const AxialBands bands = subject.axis().bands(1);
    const auto exact = subject.axis().height_um(559.0, 0);
    EXPECT_NEAR(bands[0].height_um(0, 100), 0, 1e-9);
    // Checks between its points, and that it is linear in the defocus.
    for (const double rho : {0.123, 0.5, 0.987})
        EXPECT_NEAR(bands[0].height_um(rho, 200) - bands[0].height_um(rho, 0), 200 * rho, 0.05);
    EXPECT_NEAR(std::abs(bands[0].height_um(0.987, 0)), std::abs(exact(0.987)), 12);
}

TEST(Axial, DiscIsTheLensesOwnKernel) {
    // The rings and ovals of the page against the kernel that engines use, on one lens of each kind.
    for (const char* name : {"doublet", "double-gauss", "schneider-anamorphic"}) {
        const Subject subject = subject_of(name);
        const double coc_um = 3 * subject.blur_um(), um_per_px = coc_um / 20;
        const auto ours = subject.axis().disc(coc_um, um_per_px);
        const auto lens = subject.mounted(subject.f_number(), {}, um_per_px);
        ASSERT_TRUE(lens);
        const auto theirs = (*lens)->point_spread(coc_um / um_per_px, {});
        double difference = 0;
        for (int y = -30; y <= 30; ++y)
            for (int x = -30; x <= 30; ++x) {
                const auto at = [&](const kernel::PointSpread& s) {
                    return s.extent.contains(x, y) ? s.weights(x - s.extent.x0, y - s.extent.y0).g : 0.0f;
                };
                difference += 0.5 * std::abs(double(at(ours)) - double(at(theirs)));
            }
        EXPECT_LT(difference, 0.02) << name;  // share of the light that lies elsewhere
    }
}

TEST(SquaredColumn, AgreesForAPerfectLensAndNotForOthers) {
    EXPECT_NE(squared_column(subject_of("ideal")).caption.find("agree within 2 %"), std::string::npos);
    EXPECT_EQ(squared_column(subject_of("doublet")).caption.find("agree within"), std::string::npos);
}

TEST(ZoneCurves, AreThoseOfTheLens) {
    const Subject subject = subject_of("doublet");
    const LongitudinalAberrationFacts& lsa = subject.facts().longitudinal_aberration;
    for (const std::size_t w : {5U, 11U, 18U}) {
        const auto foci = subject.zone_foci(1000 * lsa.wavelengths_um[w]);
        EXPECT_NEAR(foci.front().x, lsa.shift_mm[w].front(), 2e-3);
        EXPECT_NEAR(foci.back().x, lsa.shift_mm[w].back(), 2e-3);
    }
}

TEST(ZoneCurves, SayWhichDiscsAreSharp) {
    // The talk's law: a marginal focus towards the lens sharpens the near edge.
    EXPECT_NE(zone_curves(subject_of("uncorrected")).caption.find("<b>in front</b>"), std::string::npos);
    EXPECT_NE(zone_curves(subject_of("doublet-overcorrected")).caption.find("<b>behind</b>"),
              std::string::npos);
    EXPECT_EQ(zone_curves(subject_of("asphere")).caption.find("<b>"), std::string::npos);
}

// The place list of the first path of a class.
std::string path_of(const std::string& svg, const std::string& css) {
    const std::size_t at = svg.find("<path class=\"" + css + "\" d=\"");
    if (at == std::string::npos) return "";
    const std::size_t from = svg.find(" d=\"", at) + 4;
    return svg.substr(from, svg.find('"', from) - from);
}

TEST(Slices, OfThreeAreRedGreenAndBlue) {
    const auto three = slices(3);
    EXPECT_EQ(slice_colour(three[0].r, three[0].g, three[0].b), "rgb(255,0,0)");
    EXPECT_EQ(slice_colour(three[1].r, three[1].g, three[1].b), "rgb(0,255,0)");
    EXPECT_EQ(slice_colour(three[2].r, three[2].g, three[2].b), "rgb(0,0,255)");
    EXPECT_GT(three[0].wavelength_nm, three[1].wavelength_nm);
    EXPECT_GT(three[1].wavelength_nm, three[2].wavelength_nm);
}

TEST(DrawnSection, LensesHaveOutlinesOfTheirOwnAndASlantedBeam) {
    const auto count = [](const std::string& name, const std::string& what) {
        const std::string drawing = cross_section(subject_of(name)).drawing;
        std::size_t found = 0;
        for (std::size_t at = drawing.find(what); at != std::string::npos; at = drawing.find(what, at + 1))
            ++found;
        return found;
    };
    EXPECT_EQ(count("uncorrected", "<path class=\"ghost"), 1U);
    EXPECT_EQ(count("doublet", "<path class=\"ghost"), 2U);
    EXPECT_EQ(count("triplet", "<path class=\"ghost"), 3U);
    EXPECT_EQ(count("doublet", "<path class=\"ghost flint"), 1U);
    for (const char* name : {"ideal", "doublet"}) EXPECT_EQ(count(name, "<path class=\"ray1"), 5U) << name;
    EXPECT_NE(cross_section(subject_of("asphere")).drawing, cross_section(subject_of("diffractive")).drawing);
}

TEST(ComaPrinciple, ZonesLandOnCirclesTwiceAroundThatTouchTwoLines) {
    // In focus: of the zone at rho, circles of radius C rho^2 about 2 C rho^2 outward; a line through the
    // origin at 30 degrees to the axis touches all of them.
    const std::string rim = path_of(coma_principle(subject_of("doublet")).drawing, "ray0 bold");
    ASSERT_NE(rim, "");
    // Read back the places: "Mx yLx y...".
    std::vector<Point> points;
    for (std::size_t at = 0; at < rim.size();) {
        const double x = std::stod(rim.substr(at + 1)), y = std::stod(rim.substr(rim.find(' ', at) + 1));
        points.push_back({x, y});
        at = rim.find('L', at + 1);
    }
    ASSERT_EQ(points.size(), 73U);
    const Point middle{250 + 30 + 125, 30 + 125};  // of the second panel
    double steepest = 0, farthest = 0;
    for (const Point& p : points) {
        const Point d = p - middle;
        EXPECT_LE(d.y, 0.05) << "outward is up";
        farthest = std::max(farthest, -d.y);
        steepest = std::max(steepest, std::abs(d.x) / std::max(1.0, -d.y));
    }
    EXPECT_NEAR(steepest, std::tan(std::numbers::pi / 6), 0.01);
    EXPECT_NEAR(points[0].x, points[36].x, 0.05);  // twice around
    EXPECT_NEAR(points[0].y, points[36].y, 0.05);
    EXPECT_GT(farthest, 20);
}

TEST(ControlRing, TurnsEveryKindOfLensBothWays) {
    for (const char* name : {"ideal", "doublet", "tessar"}) {
        const auto figure = control_ring(subject_of(name));
        ASSERT_TRUE(figure) << name;
        EXPECT_EQ(fault_of(*figure), "") << name;
        EXPECT_NE(figure->caption.find("--add-spherical"), std::string::npos);
    }
}

TEST(BlurByDistance, IsTheLawOfAThinLens) {
    const std::vector<Figure> figures = blur_by_distance(subject_of("doublet"));
    ASSERT_EQ(figures.size(), 2U);
    const std::string curve = path_of(figures[1].drawing, "curve0");
    std::vector<double> heights;  // of every hundredth of the focus distance
    for (std::size_t at = curve.find(' '); at != std::string::npos; at = curve.find(' ', at + 1))
        heights.push_back(std::stod(curve.substr(at + 1)));
    ASSERT_EQ(heights.size(), 600U);
    const double infinity = (heights[599] - heights[99]) / (1 - 1.0 / 6);
    EXPECT_NEAR((heights[199] - heights[99]) / infinity, 1 - 1.0 / 2, 1e-3);
    EXPECT_NEAR((heights[49] - heights[99]) / infinity, 1 - 2.0, 1e-3);
}

TEST(SumOfDiscs, IsDrawnOfEveryKindOfLens) {
    for (const char* name : {"ideal", "doublet", "tessar"}) {
        const auto figure = sum_of_discs(subject_of(name));
        ASSERT_TRUE(figure) << name;
        EXPECT_EQ(fault_of(*figure), "") << name;
    }
}

TEST(Contrast, OfAPerfectLensIsTheDiffractionLimitAndOfOthersLess) {
    const std::string perfect = mtf_figures(subject_of("ideal")).front().drawing;
    EXPECT_NE(path_of(perfect, "mark"), "");
    EXPECT_EQ(path_of(perfect, "ray0 bold"), path_of(perfect, "mark"));
    const std::string doublet = mtf_figures(subject_of("doublet")).front().drawing;
    EXPECT_NE(path_of(doublet, "ray0 bold"), path_of(doublet, "mark"));
}

TEST(EveryLens, HasAllFiguresWithoutAFault) {
    const std::vector<std::string> names = lens_names();
    ASSERT_GT(names.size(), 35U);
    std::vector<std::string> faults(names.size());
    parallel_for(int(names.size()), *g_workers, [&](int i) {
        const auto subject = Subject::make(names[std::size_t(i)], *g_workers);
        if (!subject) {
            faults[std::size_t(i)] = subject.error().message;
            return;
        }
        std::vector<Figure> figures{cross_section(*subject),      zone_curves(*subject),
                                    colour_curve(*subject),       axial_fan(*subject),
                                    rays_near_focus(*subject, 3), spot_diagrams(*subject),
                                    squared_column(*subject)};
        if (!subject->prescription()) figures.push_back(coma_principle(*subject));
        const bool traced = subject->prescription() != nullptr;
        for (const auto& more :
             {ray_fan_figures(*subject), field_curves(*subject), seidel_figures(*subject)}) {
            if (more.empty() && traced && subject->facts().field_deg > 0.05) faults[std::size_t(i)] = "none";
            figures.insert(figures.end(), more.begin(), more.end());
        }
        for (Figure& figure : blur_by_distance(*subject)) figures.push_back(std::move(figure));
        for (const Figure& figure : figures) faults[std::size_t(i)] += fault_of(figure);
    });
    for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(faults[i], "") << names[i];
}

TEST(Sheets, NameEveryCardAndLinkToIt) {
    std::vector<LensCard> cards;
    for (const char* name : {"doublet", "tessar"}) {
        auto card = lens_card(name);
        ASSERT_TRUE(card);
        cards.push_back(std::move(*card));
    }
    for (const std::string& sheet : {lens_index(cards), lens_comparison(cards)}) {
        EXPECT_NE(sheet.find("href=\"doublet.html\""), std::string::npos);
        EXPECT_NE(sheet.find("href=\"tessar.html\""), std::string::npos);
    }
    EXPECT_NE(lens_contact_sheet(cards).find(">tessar</text>"), std::string::npos);
    EXPECT_EQ(lens_card("doublet")->discs, cards[0].discs);  // the same bytes
}

}  // namespace
}  // namespace petzval::lens_sheet
