#include "engine/samples/behind/shared_answers.h"

#include <vector>

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

HiddenGuess guess(float coc_px) {
    HiddenGuess g;
    g.seen.coc_px = coc_px;
    return g;
}

TEST(SharedAnswers, ArePixelsOfOneSquareAndOneSurface) {
    SharedAnswers answers;
    answers.add(9, 17, -5, 4, {.begin = 3, .count = 1});
    EXPECT_NE(answers.find(11, 19, -5), nullptr);
    EXPECT_EQ(answers.find(12, 19, -5), nullptr) << "the next square";
    EXPECT_EQ(answers.find(11, 19, -6), nullptr) << "another surface";
    answers.clear();
    EXPECT_EQ(answers.find(9, 17, -5), nullptr);
}

TEST(SharedAnswers, SquaresGrowWithTheBlurOfWhatIsHidden) {
    FillRule rule;
    const auto side = [&](float coc_px) {
        return shared_square(std::vector<HiddenGuess>{guess(30 * coc_px), guess(coc_px)}, rule, 1e9f);
    };
    const float from = rule.shared_from_px;
    EXPECT_EQ(side(0.9f * from), 1);
    EXPECT_EQ(side(1.1f * from), 2);
    EXPECT_EQ(side(-2.1f * from), 4);
    EXPECT_EQ(side(6.1f * from), kLargestSquare);
}

TEST(SharedAnswers, NoSquareCrossesAHiddenOutline) {
    FillRule rule;
    const std::vector<HiddenGuess> blurred{guess(10 * rule.shared_from_px)};
    EXPECT_EQ(shared_square(blurred, rule, 7), 8);
    EXPECT_EQ(shared_square(blurred, rule, 6.9f), 4);
    EXPECT_EQ(shared_square(blurred, rule, 2.5f), 2);
    EXPECT_EQ(shared_square(blurred, rule, 0), 1);
}

}  // namespace
}  // namespace petzval::engine
