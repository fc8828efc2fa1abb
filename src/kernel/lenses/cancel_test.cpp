// A wide kernel takes seconds: whoever makes one asks all the while whether it is still wanted.
#include "base/cancel.h"

#include "base/parallel.h"
#include "kernel/lenses/kernel_testing.h"

#include <string>

#include <gtest/gtest.h>

namespace petzval::kernel {
namespace {

struct Case {
    std::string name;
    LensChoice choice;
};

std::vector<Case> lenses() {
    std::vector<Case> all;
    for (const char* name : {"ideal", "uncorrected", "double-gauss"}) {
        all.push_back({name, {}});
        all.back().choice.name = name;
    }
    all.push_back({"uncorrected, cut by the barrel", all[1].choice});
    all.back().choice.cats_eye = 0.7;
    all.push_back({"uncorrected, coma", all[1].choice});
    all.back().choice.coma = 1;
    all.push_back({"waves", all[0].choice});
    all.back().choice.wave = true;
    return all;
}

TEST(Cancel, AKernelThatIsBeingMadeEndsWhenItIsNotWantedAnyMore) {
    for (const Case& lens : lenses()) {
        const auto model = lens_of(lens.choice, full_frame(4));
        int asked = 0, most = 1 << 30;
        const Progress progress({}, [&] { return ++asked > most; });
        CancellableWorkers workers(one_thread(), progress);
        const WorksFor these(workers);
        const PointSpread whole = model->point_spread(40, {0.6, 0.3});
        asked = 0;  // without what a lens makes once
        (void)model->point_spread(40, {0.6, 0.3});
        EXPECT_GE(asked, 40) << lens.name;
        most = asked / 2, asked = 0;
        EXPECT_THROW((void)model->point_spread(41, {0.6, 0.3}), Cancelled) << lens.name;
        most = 1 << 30;
        EXPECT_EQ(largest_difference(model->point_spread(40, {0.6, 0.3}), whole), 0) << lens.name;
    }
}

}  // namespace
}  // namespace petzval::kernel
