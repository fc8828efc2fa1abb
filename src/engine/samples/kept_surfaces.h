// Keeps the surfaces that were found in a picture, for the next frame of the same picture.
#pragma once

#include "base/kept.h"
#include "engine/samples/flat_surfaces.h"
#include "engine/samples/lamps/lamps.h"

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

// Estimated surfaces depend only on the picture, its radii and the quality, and take up to half of the time
// of a frame. A frame through another lens, or with other blades or glare, reuses those of the frame before.
// Any number of threads may use an object at once.
class KeptSurfaces {
public:
    // True from the second call on. Each frame of a shot is asked for once, so nothing is kept for it.
    bool was_asked_for(std::uint64_t outline);
    // The surfaces of this name; if there are none, keeps the result of find().
    template <typename Find>
    std::shared_ptr<const FoundSurfaces> get(std::uint64_t name, const Find& find) {
        return surfaces_.get(name, find);
    }
    std::size_t bytes() const { return surfaces_.bytes(); }
    void trim(std::size_t max_bytes) { surfaces_.trim(max_bytes); }

private:
    Kept<std::uint64_t, FoundSurfaces> surfaces_;
    std::mutex mutex_;                    // guards asked_for_
    std::list<std::uint64_t> asked_for_;  // latest first
};

// Hash of everything that determines the surfaces of this picture: `rules`, its light, its radii, and its
// light without lamps. every_row: only one row in so many is hashed.
std::uint64_t name_of_surfaces(const EngineView& input, View<const Rgba> colour, const Dim& dim,
                               std::uint64_t rules, int every_row = 1);

// The surfaces that the session keeps for this picture; without them, the result of find(). Names say
// nothing of plates, so what is found with those is not kept.
template <typename Find>
std::shared_ptr<const FoundSurfaces> kept_or_found(const EngineView& input, View<const Rgba> colour,
                                                   const Dim& dim, std::uint64_t rules, const Find& find) {
    constexpr int kEveryRow = 16;  // the whole name would cost every frame of a shot 1 to 2 %
    KeptSurfaces* const kept = input.services.surfaces;
    if (!kept || !input.samples.plate.empty() ||
        !kept->was_asked_for(name_of_surfaces(input, colour, dim, rules, kEveryRow)))
        return std::make_shared<const FoundSurfaces>(find());
    return kept->get(name_of_surfaces(input, colour, dim, rules), find);
}

}  // namespace petzval::engine
