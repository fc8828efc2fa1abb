// Any bytes get an answer, soon, in bounded memory. Mutations are seeded, so a failure repeats.
#include "lens_files/lens_file.h"
#include "lens_files/sample_texts.h"
#include "lens_files/shelf.h"
#include "optics/traced_lens.h"

#include <random>

#include <gtest/gtest.h>

namespace petzval::lens_files {
namespace {

std::string mutated(std::string text, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return std::size_t(random() % std::max<std::size_t>(n, 1)); };
    const std::string alphabet = "0123456789.-+eE \t\n\r\"'[]{},:;!#&\\\xFF\x01";
    for (std::size_t change = 0; change <= below(6) && !text.empty(); ++change) {
        const std::size_t at = below(text.size()),
                          length = 1 + below(std::min<std::size_t>(40, text.size() - at));
        switch (random() % 6) {
            case 0:
                text[at] = alphabet[below(alphabet.size())];
                break;
            case 1:
                text.erase(at, length);
                break;
            case 2:
                text.insert(at, text.substr(below(text.size()), length));
                break;
            case 3:
                text.resize(at);
                break;
            case 4:
                text[at] = char(random());
                break;
            default:
                text.insert(at, std::string(1, alphabet[below(alphabet.size())]));
                break;
        }
    }
    return text;
}

// Reads and, if it is a lens, uses it as the program would.
void exercise(const std::string& bytes) {
    const auto file = read_lens(bytes, "mutant");
    if (!file) {
        EXPECT_EQ(file.error().message.substr(0, 7), "mutant:");
        return;
    }
    const auto lens = optics::TracedLens::make(file->lens, {});
    if (!lens) return;
    const auto beam = lens->beam(file->lens.primary_um, 0.1);
    if (beam) (void)beam->ray(0.3, 0.4);
}

TEST(DamagedFiles, MutantsOfEveryFormatAreAnsweredWithoutHarm) {
    optics::Prescription lens = find_lens("double-gauss-sample-f2")->lens;
    lens.surfaces[0].asphere = {{4, 1e-7}, {6, -2e-11}};
    std::string json;
    for (const ShelfItem& item : shelf())
        if (item.name == "phone") json = item.text;
    const std::string originals[] = {
        as_zmx(lens),           as_seq(lens), as_pbrt(find_lens("double-gauss")->lens),
        as_optical_bench(lens), json,         as_utf16(as_zmx(lens), true, true)};
    std::mt19937 random(20250101);
    for (int round = 0; round < 400; ++round)
        for (const std::string& original : originals) exercise(mutated(original, random));
}

TEST(DamagedFiles, NoiseIsNoLens) {
    std::mt19937 random(7);
    for (int round = 0; round < 300; ++round) {
        std::string bytes(random() % 2000, '\0');
        for (char& c : bytes) c = char(random());
        EXPECT_FALSE(read_lens(bytes, "noise"));
    }
}

TEST(DamagedFiles, BombsAreRefusedSoon) {
    EXPECT_FALSE(read_lens(std::string(100000, '['), "deep"));
    EXPECT_FALSE(read_lens("{\"surfaces\":" + std::string(100000, '['), "deep"));
    std::string wide = "{\"surfaces\":[";
    for (int i = 0; i < 400000; ++i) wide += "0,";
    EXPECT_FALSE(read_lens(wide + "0]}", "wide"));
    EXPECT_FALSE(read_lens(std::string(kLargestLensFile + 1, ' '), "large"));
    std::string surfaces;
    for (int i = 0; i < 100000; ++i) surfaces += "1 1 1 1\n";
    EXPECT_FALSE(read_lens(surfaces, "many"));
    std::string continued = "RDM\n";
    for (int i = 0; i < 200000; ++i) continued += "S 1 &\n";
    EXPECT_FALSE(read_lens(continued, "continued"));
}

}  // namespace
}  // namespace petzval::lens_files
