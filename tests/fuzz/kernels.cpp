// Segments of the store of kernels. The first bytes of an input are records of 64 bytes, the rest is weights;
// the target adds a sound header and sound hashes, or leaves them as they are, so that the checks behind the
// hashes are reached as well.
#include "base/content_hash.h"
#include "fuzz/held_file.h"
#include "kernel/keep/kernel_store.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <span>
#include <sys/stat.h>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMagic = 0x324e5245'4b5a5450u;
constexpr std::size_t kHeader = 88, kRecord = 64, kHashAt = 56, kOffsetAt = 48;

template <typename Number>
void put(std::vector<char>& file, std::size_t at, Number value) {
    std::memcpy(file.data() + at, &value, sizeof value);
}

template <typename Number>
Number get(const std::vector<char>& file, std::size_t at) {
    Number value;
    std::memcpy(&value, file.data() + at, sizeof value);
    return value;
}

// Gives each record the hash of the weights that it names, where these lie in the file.
void hash_weights(std::vector<char>& file, std::size_t records) {
    for (std::size_t i = 0; i < records; ++i) {
        const std::size_t at = kHeader + i * kRecord;
        const auto x0 = get<std::int32_t>(file, at + 28), y0 = get<std::int32_t>(file, at + 32),
                   x1 = get<std::int32_t>(file, at + 36), y1 = get<std::int32_t>(file, at + 40);
        const auto offset = get<std::uint64_t>(file, at + kOffsetAt);
        const bool is_neutral = get<std::int32_t>(file, at + 44) != 0;
        const std::int64_t width = std::int64_t(x1) - x0, height = std::int64_t(y1) - y0;
        if (width <= 0 || height <= 0 || width > 4096 || height > 4096 || offset > file.size()) continue;
        const std::size_t bytes = std::size_t(width * height) * (is_neutral ? 4 : 12);
        if (bytes > file.size() - offset) continue;
        put(file, at + kHashAt, petzval::hash_of(file.data() + offset, bytes, kMagic));
    }
}

std::vector<char> segment(std::span<const std::uint8_t> bytes) {
    const unsigned how = bytes.empty() ? 0 : bytes[0];
    const auto rest = bytes.subspan(std::min<std::size_t>(1, bytes.size()));
    std::vector<char> file(kHeader);
    put(file, 0, kMagic);
    std::strcpy(file.data() + 24, "lens");
    file.insert(file.end(), rest.begin(), rest.end());
    const std::size_t records = std::min<std::size_t>(how % 8, rest.size() / kRecord);
    put(file, 8, std::uint64_t(records));
    if (how & 8) hash_weights(file, records);
    put(file, 16, petzval::hash_of(file.data() + kHeader, records * kRecord, kMagic));
    // Or a file that is none of ours.
    if (how & 16 && rest.size() >= kHeader) file.assign(rest.begin(), rest.end());
    return file;
}

// Makes a folder of this process, which is removed when the process ends.
const std::string& folder() {
    static const std::string path = petzval::fuzz::held_file(nullptr, 0, ".unused") + ".store";
    static const bool is_made = [] {
        std::atexit([] { fs::remove_all(path); });
        ::mkdir(path.c_str(), S_IRWXU);
        return ::mkdir((path + "/lens").c_str(), S_IRWXU) == 0;
    }();
    static_cast<void>(is_made);
    return path;
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const std::vector<char> file = segment({bytes, size});
    const std::string path = folder() + "/lens/1.kernels";
    std::ofstream(path, std::ios::binary).write(file.data(), std::streamsize(file.size()));
    ::chmod(path.c_str(), S_IRUSR | S_IWUSR);
    const petzval::kernel::KernelStore store(folder(), "lens", std::size_t(1) << 20);
    for (std::size_t at = kHeader; at + kRecord <= file.size() && at < kHeader + 8 * kRecord; at += kRecord) {
        const petzval::kernel::KernelStore::Key key{get<std::int32_t>(file, at + 24), get<double>(file, at),
                                                    get<double>(file, at + 8), get<double>(file, at + 16)};
        const auto kernel = store.find(key);
        if (kernel && (kernel->extent.empty() || kernel->weights.size() == 0)) std::abort();
    }
    return 0;
}
