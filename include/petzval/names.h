// Names of the values of enums, one table per enum. Flags, looks and reports use these names; after a
// change, the old name is still accepted.
#pragma once

#include "petzval/camera.h"
#include "petzval/depth.h"
#include "petzval/develop.h"
#include "petzval/engine_options.h"
#include "petzval/export.h"
#include "petzval/glare.h"
#include "petzval/lens_choice.h"
#include "petzval/result.h"

#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace petzval {

// A value, its name, and a short description.
template <typename E>
struct Named {
    E value;
    const char* name;
    const char* meaning;
};

// Every value of the enum once, in reading order. For the enums below only.
template <typename E>
std::span<const Named<E>> names();

template <>
PETZVAL_API std::span<const Named<Quality>> names();
template <>
PETZVAL_API std::span<const Named<Fill>> names();
template <>
PETZVAL_API std::span<const Named<ScatterView>> names();
template <>
PETZVAL_API std::span<const Named<GatherStage>> names();
template <>
PETZVAL_API std::span<const Named<GaussianStyle>> names();
template <>
PETZVAL_API std::span<const Named<GaussianView>> names();
template <>
PETZVAL_API std::span<const Named<SpriteBackground>> names();
template <>
PETZVAL_API std::span<const Named<FocusMode>> names();
template <>
PETZVAL_API std::span<const Named<LightSpectrum>> names();
template <>
PETZVAL_API std::span<const Named<ImageScale>> names();
template <>
PETZVAL_API std::span<const Named<StarQuality>> names();
template <>
PETZVAL_API std::span<const Named<LensCoating>> names();
template <>
PETZVAL_API std::span<const Named<ToneCurve>> names();
template <>
PETZVAL_API std::span<const Named<Transfer>> names();
template <>
PETZVAL_API std::span<const Named<DepthKind>> names();
template <>
PETZVAL_API std::span<const Named<DepthEdges>> names();
template <>
PETZVAL_API std::span<const Named<ErrorCode>> names();

// "standard"; "?" for a number that is not a value of the enum.
template <typename E>
requires std::is_enum_v<E>
const char* name_of(E value) {
    for (const Named<E>& known : names<E>())
        if (known.value == value) return known.name;
    return "?";
}

// The value of that name. Errors: InvalidArgument, "not one of draft, standard, final".
template <typename E>
requires std::is_enum_v<E> Result<E> parse(const std::string& text) {
    std::string all;
    for (const Named<E>& known : names<E>()) {
        if (text == known.name) return known.value;
        all += (all.empty() ? "" : ", ") + std::string(known.name);
    }
    return Error{ErrorCode::InvalidArgument, "not one of " + all};
}

// " (did you mean X?)" if a known word is similar to the given one, else empty. For messages.
PETZVAL_API std::string did_you_mean(const std::string& given, const std::vector<std::string>& known);

}  // namespace petzval
