#include "petzval/reports/devices.h"

#include <gtest/gtest.h>

namespace petzval {
namespace {

const std::vector<DeviceFacts> kDevices{{"cpu", "AVX2", false, ""},
                                        {"gpu:0", "Card 5", false, "64-bit atomics"},
                                        {"gpu:1", "llvmpipe", true, ""}};

TEST(DeviceList, ALineNamesADeviceItsDriverAndTheReasonItCannotBeUsed) {
    EXPECT_EQ(device_list_text(kDevices, ""),
              "cpu  AVX2\n"
              "gpu:0  Card 5; missing: 64-bit atomics\n"
              "gpu:1  llvmpipe, a software driver\n");
    EXPECT_EQ(device_list_text({kDevices[0]}, "no Vulkan driver is installed"),
              "cpu  AVX2\nno gpu: no Vulkan driver is installed\n");
}

TEST(DeviceList, TheRecordHasEveryFactAndNullWhereThereIsNothingToSay) {
    const std::string record = device_list_record(kDevices, "");
    for (const char* part :
         {R"("verb":"devices")", R"({"name":"cpu","title":"AVX2","software":false,"lacks":null})",
          R"("title":"Card 5","software":false,"lacks":"64-bit atomics")",
          R"("title":"llvmpipe","software":true,"lacks":null)", R"("no_gpu":null)"})
        EXPECT_NE(record.find(part), std::string::npos) << part << record;
    EXPECT_NE(device_list_record({}, "why").find(R"("devices":[],"no_gpu":"why")"), std::string::npos);
}

}  // namespace
}  // namespace petzval
