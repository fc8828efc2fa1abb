#ifdef PETZVAL_GLTF

#include "scene/gltf/numbers.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace petzval::scene {
namespace {

template <typename T>
double read(const unsigned char* from, std::size_t component, bool normalised, double most) {
    T number;
    std::memcpy(&number, from + component * sizeof(T), sizeof(T));
    return normalised ? std::max(double(number) / most, -1.0) : double(number);
}

template <typename List>
bool has(const List& list, int index) {
    return index >= 0 && std::size_t(index) < list.size();
}

}  // namespace

double GltfNumbers::at(std::size_t i, std::size_t component) const {
    const unsigned char* from = first + i * stride;
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return read<std::int8_t>(from, component, normalised, 127);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return read<std::uint8_t>(from, component, normalised, 255);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return read<std::int16_t>(from, component, normalised, 32767);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return read<std::uint16_t>(from, component, normalised, 65535);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return read<std::uint32_t>(from, component, normalised, 4294967295.0);
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return read<float>(from, component, false, 1);
        default:
            return 0;
    }
}

Result<GltfNumbers> gltf_numbers(const tinygltf::Model& model, int accessor, int kind,
                                 const std::string& path) {
    const auto broken = [&](const std::string& why) {
        return Error{ErrorCode::InvalidFile, path + ": " + why};
    };
    if (!has(model.accessors, accessor)) return broken("an accessor is missing");
    const tinygltf::Accessor& a = model.accessors[std::size_t(accessor)];
    if (a.type != kind) return broken("an accessor is of another type than needed");
    if (a.sparse.isSparse || !has(model.bufferViews, a.bufferView))
        return broken("an accessor without a view of a buffer, or a sparse one, which is not read");
    const tinygltf::BufferView& view = model.bufferViews[std::size_t(a.bufferView)];
    if (!has(model.buffers, view.buffer)) return broken("a buffer is missing");
    const auto& data = model.buffers[std::size_t(view.buffer)].data;
    const int stride = a.ByteStride(view),
              size = tinygltf::GetComponentSizeInBytes(std::uint32_t(a.componentType)),
              components = tinygltf::GetNumComponentsInType(std::uint32_t(a.type));
    if (stride <= 0 || size <= 0 || components <= 0) return broken("an accessor of no known layout");
    const std::size_t begin = view.byteOffset + a.byteOffset, item = std::size_t(size * components);
    const bool fits = a.count > 0 && view.byteOffset <= data.size() && a.byteOffset <= data.size() &&
                      begin <= data.size() && item <= data.size() - begin &&
                      (a.count - 1) <= (data.size() - begin - item) / std::size_t(stride);
    if (!fits) return broken("an accessor reaches beyond its buffer");
    return GltfNumbers{data.data() + begin, std::size_t(stride), a.count, a.componentType, a.normalized};
}

}  // namespace petzval::scene

#endif
