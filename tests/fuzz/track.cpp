// Tracks as CSV and as JSON; values are asked at four frames.
#include "petzval/track.h"

#include "fuzz/held_file.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const auto track = petzval::Track::read(petzval::fuzz::held_file(bytes, size, ".track"));
    if (!track) {
        petzval::fuzz::check_message(track.error().message);
        return 0;
    }
    for (const int frame : {track->first(), 1001, 1012, track->last()}) track->at(frame);
    return 0;
}
