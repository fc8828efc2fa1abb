#include "base/number_text.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace petzval {
namespace {

struct Read {
    double value = -99;
    std::size_t length = 0;
    std::errc problem{};
    friend bool operator==(const Read&, const Read&) = default;
};

using Reader = std::from_chars_result (*)(std::string_view, double&);

Read read(Reader reader, std::string_view text) {
    Read r;
    const auto [end, problem] = reader(text, r.value);
    return {r.value, std::size_t(end - text.data()), problem};
}

TEST(NumberText, ReadsTheLongestNumberThatTheTextBeginsWith) {
    for (const Reader reader : {&number_from_text, &number_by_stream}) {
        EXPECT_EQ(read(reader, "12.5mm"), (Read{12.5, 4}));
        EXPECT_EQ(read(reader, "-.5e1e2"), (Read{-5, 5}));
        EXPECT_EQ(read(reader, "7."), (Read{7, 2}));
        EXPECT_EQ(read(reader, "1e"), (Read{1, 1}));
        EXPECT_EQ(read(reader, "0x10"), (Read{0, 1}));
        EXPECT_EQ(read(reader, "1,5"), (Read{1, 1}));
        EXPECT_EQ(read(reader, "5e-324").value, std::numeric_limits<double>::denorm_min());
        EXPECT_EQ(read(reader, "0e-999"), (Read{0, 6}));
        for (const char* none : {"", "-", ".", "e5", "+1", " 1", "inf", "-inf", "nan", "--1"})
            EXPECT_EQ(read(reader, none), (Read{-99, 0, std::errc::invalid_argument})) << none;
        for (const std::string lost : {"1e999", "-1e999", "1e-999"})
            EXPECT_EQ(read(reader, lost), (Read{-99, lost.size(), std::errc::result_out_of_range})) << lost;
    }
}

TEST(NumberText, BothWaysGiveTheSameBits) {
    for (int i = 0; i < 1200; ++i) {
        const std::string text =
            std::to_string(i % 7) + "." + std::to_string(i * 7919) + "e" + std::to_string(i % 600 - 300);
        EXPECT_EQ(read(&number_from_text, text), read(&number_by_stream, text)) << text;
    }
}

}  // namespace
}  // namespace petzval
