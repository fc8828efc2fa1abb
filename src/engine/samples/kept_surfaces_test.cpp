#include "engine/samples/kept_surfaces.h"

#include "base/parallel.h"

#include <gtest/gtest.h>

namespace petzval::engine {
namespace {

// Surfaces of some bytes.
FoundSurfaces some() {
    FoundSurfaces s;
    s.lamps.rows.resize(100);
    return s;
}

TEST(KeptSurfaces, AreFoundTwiceThenKept) {
    const Picture colour(8, 8, {0.5f, 0.5f, 0.5f, 1});
    const Plane coc(8, 8, 1);
    KeptSurfaces kept;
    EngineView view;
    view.samples.colour = colour, view.samples.coc_px = coc, view.services.surfaces = &kept;
    int searches = 0;
    const auto get = [&] { return kept_or_found(view, colour, {}, 1, [&] { return ++searches, some(); }); };
    get();
    EXPECT_EQ(kept.bytes(), 0u) << "nobody asked for them again";
    const auto second = get();
    EXPECT_EQ(kept.bytes(), some().bytes());
    EXPECT_EQ(get(), second);
    EXPECT_EQ(searches, 2);
    view.services.surfaces = nullptr;
    EXPECT_NE(get(), second);
}

// Everything that the estimate looks at has its part in the name.
TEST(KeptSurfaces, AnotherPictureHasAnotherName) {
    Picture colour(8, 8, {0.5f, 0.5f, 0.5f, 1});
    Plane coc(8, 8, 1);
    EngineView view;
    view.samples.colour = colour, view.samples.coc_px = coc;
    Dim dim{[](int, int, Rgba light) { return light; }, 1, 2, 3};
    const auto name = [&](std::uint64_t rules = 1) { return name_of_surfaces(view, colour, dim, rules); };
    const std::uint64_t before = name();
    EXPECT_EQ(name(), before);
    EXPECT_NE(name(2), before);
    const auto changes_with = [&](auto& value, auto other) {
        const auto own = value;
        value = other;
        EXPECT_NE(name(), before);
        value = own;
        EXPECT_EQ(name(), before);
    };
    changes_with(colour(7, 7).b, 0.6f);
    changes_with(coc(0, 7), 1.5f);
    changes_with(view.samples.nearest_coc_px, -1.0f);
    changes_with(view.samples.farthest_coc_px, 2.0f);
    changes_with(dim.least, 1.5f);
    changes_with(dim.white, 1.5f);
    changes_with(dim.name, 4);
}

}  // namespace
}  // namespace petzval::engine
