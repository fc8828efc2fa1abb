#include "petzval/shots/compare_files.h"
#include "petzval/shots/inspection.h"

#include <gtest/gtest.h>

namespace petzval {
namespace {

ComparedFiles compared(double psnr_lin) {
    Comparison c{};
    c.psnr_lin = psnr_lin;
    return {c, {{Rect{0, 0, int(psnr_lin), 1}, 0.1}}, ""};
}

TEST(ComparedShot, ShowsTheMeanAndTheFirstOfTheWorstFrames) {
    ComparedShot shot;
    EXPECT_EQ(shot.text(), "");
    EXPECT_EQ(shot.worst_frame(), std::nullopt);
    for (const auto& [frame, psnr] : {std::pair(7, 40.0), std::pair(8, 30.0), std::pair(9, 30.0)})
        shot.add(frame, compared(psnr));
    EXPECT_EQ(shot.worst_frame(), 8);
    const std::string text = shot.text();
    EXPECT_NE(text.find("mean             33.33"), std::string::npos) << text;  // (40 + 30 + 30) / 3
    EXPECT_NE(text.find("worst is frame 8\n"), std::string::npos) << text;
    EXPECT_NE(text.find("0,0 to 30,1"), std::string::npos) << text;
    EXPECT_EQ(text.find("0,0 to 40,1"), std::string::npos) << text;
}

InspectedFile file_at(double f_number) {
    InspectedFile file;
    file.shot.place = Place::whole({0, 0, 8, 4});
    file.shot.camera.f_number = FoundNumber{f_number, "test"};
    return file;
}

TEST(InspectedShot, SeparatesConstantValuesFromThoseThatChange) {
    InspectedShot shot;
    EXPECT_EQ(shot.text(), "");
    shot.add(1, file_at(2));
    EXPECT_NE(shot.text().find("nothing changes\n"), std::string::npos);
    shot.add(12, file_at(2.8));
    const std::string text = shot.text();
    EXPECT_NE(text.find("  display window: 8 x 4 at 0,0\n"), std::string::npos) << text;
    EXPECT_TRUE(
        text.ends_with("what changes\n"
                       "  frame   f-number\n"
                       "      1          2\n"
                       "     12        2.8\n"))
        << text;
}

TEST(InspectionText, NamesMissingNumbersInTheWordsOfTheHost) {
    const InspectedFile file = file_at(2);
    const std::string fields = inspection_text({}, file);
    EXPECT_NE(fields.find("give camera.focal_length_mm\n"), std::string::npos) << fields;
    EXPECT_NE(fields.find("f-number        2  (test)\n"), std::string::npos) << fields;
    const auto words = [](const std::string& field) { return "<" + field + ">"; };
    EXPECT_NE(inspection_text({}, file, words).find("give <camera.focal_length_mm>\n"), std::string::npos);
}

}  // namespace
}  // namespace petzval
