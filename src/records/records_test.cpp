#include "petzval/records.h"

#include <gtest/gtest.h>

namespace petzval {
namespace {

TEST(Records, InfinityIsWrittenAsANumberThatReadersTakeForIt) {
    const std::string part = record_of_json(R"({"far_m": 1e999, "near_m": -1e999, "name": "1e999 \"m\""})");
    EXPECT_EQ(finished_record(part, -1),
              "{\"far_m\":1e999,\"near_m\":-1e999,\"name\":\"1e999 \\\"m\\\"\"}\n");
}

TEST(Records, EveryRecordHoldsTheSameKeys) {
    const std::string record = empty_record("lens psf");
    for (const char* key : {"schema", "program", "input", "output", "engine", "lens", "camera", "seconds"})
        EXPECT_NE(record.find("\"" + std::string(key) + "\":"), std::string::npos) << key;
    EXPECT_NE(record.find("\"verb\":\"lens psf\""), std::string::npos);
}

TEST(Records, AFailureIsToldByCodeMessageAndField) {
    const std::string record =
        failure_record("lens psf", {ErrorCode::InvalidArgument, "disc.field 2", "disc.field"}, 2);
    const auto in_words = [](const std::string&) { return std::string("--field 2"); };
    EXPECT_NE(finished_record(record, -1, in_words)
                  .find(R"("failure":{"code":"invalid-argument","message":"--field 2","field":"disc.field",)"
                        R"("exit_code":2})"),
              std::string::npos)
        << record;
    const std::string unread = failure_record("", {ErrorCode::InvalidArgument, "no verb", ""}, 2);
    EXPECT_NE(unread.find(R"("verb":null)"), std::string::npos) << unread;
    EXPECT_NE(unread.find(R"("field":null)"), std::string::npos) << unread;
}

TEST(Records, LinesAreInTheWordsOfTheHost) {
    const auto in_words = [](const std::string& line) { return "<" + line + ">"; };
    EXPECT_EQ(finished_record(R"({"error": "camera.f_number", "output": "a"})", -1, in_words),
              "{\"error\":\"<camera.f_number>\",\"output\":\"a\"}\n");
}

}  // namespace
}  // namespace petzval
