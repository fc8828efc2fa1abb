// Keeps the surfaces that were found in a picture, for the next frame of the same picture.
#pragma once

#include "base/kept.h"
#include "engine/samples/flat_surfaces.h"
#include "engine/samples/lamps.h"

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>

namespace petzval::engine {

struct FoundSurfaces {
    FlatSurfaces flat;
    HiddenLamps lamps;
    std::size_t bytes() const { return flat.bytes() + lamps.bytes(); }
};

// The estimate depends on the picture, its radii and the quality alone, and takes up to half of a frame. So a
// frame through another lens, or with other blades or glare, has the surfaces of the frame before. Any number
// of threads may use it at once.
class KeptSurfaces {
public:
    // True from the second time on. Frames of a shot are asked for once, and nothing is kept for them.
    bool was_asked_for(std::uint64_t outline);
    // The surfaces of this name, or find(), which are kept.
    template <typename Find>
    std::shared_ptr<const FoundSurfaces> get(std::uint64_t name, const Find& find) {
        return surfaces_.get(name, find);
    }
    std::size_t bytes() const { return surfaces_.bytes(); }
    void trim(std::size_t max_bytes) { surfaces_.trim(max_bytes); }

private:
    Kept<std::uint64_t, FoundSurfaces> surfaces_;
    std::mutex mutex_;                    // of asked_for_
    std::list<std::uint64_t> asked_for_;  // the last first
};

// A name for all that decides the surfaces of this picture besides `rules`: its light, its radii, and its
// light without lamps. As good as certainly, other pictures have other names. every_row: the name looks at
// one row in so many.
std::uint64_t name_of_surfaces(const EngineView& input, View<const Rgba> colour, const Dim& dim,
                               std::uint64_t rules, int every_row = 1);

// find(), or what the session keeps of it.
template <typename Find>
std::shared_ptr<const FoundSurfaces> kept_or_found(const EngineView& input, View<const Rgba> colour,
                                                   const Dim& dim, std::uint64_t rules, const Find& find) {
    constexpr int kEveryRow = 16;  // the whole name would cost every frame of a shot 1 to 2 %
    KeptSurfaces* const kept = input.services.surfaces;
    if (!kept || !kept->was_asked_for(name_of_surfaces(input, colour, dim, rules, kEveryRow)))
        return std::make_shared<const FoundSurfaces>(find());
    return kept->get(name_of_surfaces(input, colour, dim, rules), find);
}

}  // namespace petzval::engine
