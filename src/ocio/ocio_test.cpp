#include "petzval/ocio.h"

#include <cstdlib>

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(OcioView, IsReadFromDisplayAndViewOrTheDefault) {
    const OcioView both = ocio_view("sRGB,Film, warm");
    EXPECT_EQ(both.display, "sRGB");
    EXPECT_EQ(both.view, "Film, warm") << "only the first comma separates";
    EXPECT_EQ(ocio_view("sRGB").display, "sRGB");
    EXPECT_EQ(ocio_view("sRGB").view, "");
    EXPECT_EQ(ocio_view("default").display, "") << "the config's own";
}

TEST(ShowByOcio, WithoutAConfigTheRemainingStepsStayAsTheyWere) {
    ::unsetenv("OCIO");
    Picture light(2, 1, {1, 1, 1, 1});
    DevelopSettings settings;
    settings.tone = ToneCurve::Filmic;
    std::string used;
    std::vector<std::string> warnings;
    EXPECT_EQ(show_by_ocio(light, settings, {}, used, warnings).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(settings.tone, ToneCurve::Filmic);
    EXPECT_EQ(used, "");
}

}  // namespace
}  // namespace petzval
