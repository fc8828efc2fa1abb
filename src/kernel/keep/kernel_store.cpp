#include "kernel/keep/kernel_store.h"

#include "base/content_hash.h"
#include "kernel/model/spread.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace petzval::kernel {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMagic = 0x324e5245'4b5a5450u;  // "PTZKERN2", and the order of bytes
constexpr std::size_t kPendingBytes = std::size_t(48) << 20;
constexpr std::size_t kMostRecords = 1 << 22;
constexpr int kLargestSide = 1 << 14;
constexpr std::size_t kMostOpen = 64;  // a process may have 256 files open, or fewer

using LensName = std::array<char, 64>;

struct Header {
    std::uint64_t magic = kMagic, records = 0, index_hash = 0;
    LensName lens{};
};

// Nothing for a key that is empty or too long.
std::optional<LensName> lens_name(const std::string& lens_key) {
    LensName name{};
    if (lens_key.empty() || lens_key.size() >= name.size()) return std::nullopt;
    std::copy(lens_key.begin(), lens_key.end(), name.begin());
    return name;
}

struct Record {
    double coc_radius_px = 0, field_x = 0, field_y = 0;
    std::int32_t level = 0, x0 = 0, y0 = 0, x1 = 0, y1 = 0, neutral = 0;
    std::uint64_t offset = 0, hash = 0;  // of the weights in the file

    Rect extent() const { return {x0, y0, x1, y1}; }
    // Before anything is computed with these numbers.
    bool is_sound(std::size_t file_size) const {
        const auto in = [](std::int32_t n) { return n >= -kLargestSide && n <= kLargestSide; };
        return in(x0) && in(y0) && in(x1) && in(y1) && !extent().empty() && x1 - x0 <= kLargestSide &&
               y1 - y0 <= kLargestSide && offset <= file_size &&
               floats() * sizeof(float) <= file_size - offset;
    }
    // Neutral kernels keep one number per pixel, others r, g and b.
    std::size_t floats() const { return std::size_t(x1 - x0) * std::size_t(y1 - y0) * (neutral ? 1u : 3u); }
};

// Alpha is a function of the colours (spread.h) and is made again.
std::vector<float> packed(const PointSpread& kernel) {
    std::vector<float> floats;
    for (std::size_t i = 0; i < kernel.weights.size(); ++i) {
        const Rgba& w = kernel.weights.pixels()[i];
        floats.push_back(w.r);
        if (!kernel.neutral) floats.push_back(w.g), floats.push_back(w.b);
    }
    return floats;
}

PointSpread unpacked(const Record& r, const std::vector<float>& floats) {
    const Rect e = r.extent();
    PointSpread kernel{e, Image<Rgba>::uninitialised(e.width(), e.height()), r.neutral != 0};
    for (std::size_t i = 0; i < kernel.weights.size(); ++i) {
        Rgba& w = kernel.weights.pixels()[i];
        if (kernel.neutral)
            w = {floats[i], floats[i], floats[i], floats[i]};
        else
            w = {floats[3 * i], floats[3 * i + 1], floats[3 * i + 2], 0}, w.a = alpha_of(w);
    }
    return kernel;
}

// True if a lens may have these weights: finite, none negative, each channel's sum 1.
bool are_weights(const Record& r, const std::vector<float>& floats) {
    const std::size_t channels = r.neutral ? 1 : 3;
    std::array<double, 3> sums{};
    for (std::size_t i = 0; i < floats.size(); ++i) {
        if (!(floats[i] >= 0) || !std::isfinite(floats[i])) return false;
        sums[i % channels] += double(floats[i]);
    }
    return std::all_of(sums.begin(), sums.begin() + std::ptrdiff_t(channels),
                       [](double sum) { return std::abs(sum - 1) < 1e-3; });
}

// True if only this user or the administrator can have put the file there.
bool is_ours(const struct stat& about) {
    return (about.st_uid == geteuid() || about.st_uid == 0) && (about.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

// The reason why an existing folder cannot keep kernels; "" if it can.
std::string why_no_use(const std::string& path) {
    struct stat about {};
    if (stat(path.c_str(), &about) != 0) return "";
    if (!S_ISDIR(about.st_mode)) return "which is not a folder";
    return is_ours(about)
               ? ""
               : "where other users may write: make it your own (chmod -R go-w), or give another folder";
}

// A folder that only this user may enter, if it is new. Failure shows when the segment is written.
void make_private(const fs::path& folder) {
    std::error_code problem;
    fs::create_directories(folder.parent_path(), problem);
    mkdir(folder.c_str(), S_IRWXU);
}

bool same_bits(const PointSpread& a, const PointSpread& b) {
    return a.extent == b.extent && a.neutral == b.neutral &&
           std::memcmp(a.weights.pixels(), b.weights.pixels(), a.weights.bytes()) == 0;
}

// A name that no other process, and nothing else in this one, uses.
std::string own_name() {
    static std::atomic<unsigned> count{0};
    const auto now = std::chrono::system_clock::now().time_since_epoch().count();
    return std::to_string(now) + "-" + std::to_string(getpid()) + "-" + std::to_string(count++);
}

// Removes the segments that were unused for longest, and the remains of runs that died.
void make_room(const std::string& folder, std::size_t max_bytes) {
    struct File {
        fs::file_time_type used;
        std::uintmax_t bytes;
        fs::path path;
    };
    std::vector<File> files;
    std::error_code problem;
    std::uintmax_t bytes = 0;
    for (fs::recursive_directory_iterator i(folder, problem), end; !problem && i != end;
         i.increment(problem)) {
        const std::string suffix = i->path().extension();
        if (suffix != ".kernels" && suffix != ".part") continue;
        std::error_code gone;
        const File file{i->last_write_time(gone), i->file_size(gone), i->path()};
        if (gone) continue;
        const bool left_behind =
            suffix == ".part" && fs::file_time_type::clock::now() - file.used > std::chrono::hours(1);
        if (left_behind) fs::remove(file.path, gone);
        if (suffix == ".part") continue;
        files.push_back(file);
        bytes += file.bytes;
    }
    std::sort(files.begin(), files.end(), [](const File& p, const File& q) { return p.used < q.used; });
    for (const File& file : files) {
        if (bytes <= max_bytes) break;
        fs::remove(file.path, problem);
        fs::remove(file.path.parent_path(), problem);  // succeeds when it is empty
        bytes -= file.bytes;
    }
}

}  // namespace

// A file of the store: checked index, weights read when asked for.
struct KernelStore::Segment {
    int file = -1;
    std::vector<Record> records;

    Segment() = default;
    Segment(const Segment&) = delete;
    Segment& operator=(const Segment&) = delete;
    ~Segment() {
        if (file >= 0) close(file);
    }

    bool read(void* to, std::size_t size, std::uint64_t offset) const {
        for (char* at = static_cast<char*>(to); size > 0;) {
            const ssize_t got = pread(file, at, size, off_t(offset));
            if (got <= 0) return false;
            at += got, offset += std::uint64_t(got), size -= std::size_t(got);
        }
        return true;
    }

    // Null for anything that is not a whole, undamaged segment of this lens, written by us.
    static std::unique_ptr<Segment> opened(const std::string& path, const LensName& lens) {
        auto segment = std::make_unique<Segment>();
        segment->file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // pipes may never answer
        struct stat about {};
        Header header;
        if (segment->file < 0 || fstat(segment->file, &about) != 0 || !S_ISREG(about.st_mode) ||
            !is_ours(about))
            return nullptr;
        if (!segment->read(&header, sizeof header, 0) || header.magic != kMagic || header.lens != lens ||
            header.records == 0 || header.records > kMostRecords)
            return nullptr;
        const std::size_t index = std::size_t(header.records) * sizeof(Record),
                          size = std::size_t(about.st_size);
        if (size < sizeof header + index) return nullptr;
        segment->records.resize(std::size_t(header.records));
        if (!segment->read(segment->records.data(), index, sizeof header) ||
            hash_of(segment->records.data(), index, kMagic) != header.index_hash)
            return nullptr;
        for (const Record& r : segment->records)
            if (!r.is_sound(size)) return nullptr;
        futimens(segment->file, nullptr);  // used now
        return segment;
    }
};

KernelStore::KernelStore(std::string folder, const std::string& lens_key, std::size_t max_bytes)
    : folder_(std::move(folder)),
      lens_folder_(folder_ + "/" + lens_key),
      lens_key_(lens_key),
      max_bytes_(max_bytes) {
    const std::string no_use = why_no_use(folder_).empty() ? why_no_use(lens_folder_) : why_no_use(folder_);
    if (!no_use.empty()) warning_ = "kernels are not kept in " + folder_ + ", " + no_use;
    if (!lens_name(lens_key_) || folder_.empty() || !no_use.empty())
        max_bytes_ = 0;
    else
        open_segments();
}

KernelStore::~KernelStore() {
    const std::lock_guard lock(mutex_);
    write_pending();
}

void KernelStore::open_segments() {
    std::vector<std::string> paths;
    std::error_code problem;
    for (fs::directory_iterator i(lens_folder_, problem), end; !problem && i != end; i.increment(problem))
        if (i->path().extension() == ".kernels") paths.push_back(i->path());
    std::sort(paths.begin(), paths.end(), std::greater<>());  // their names begin with the time
    for (const std::string& path : paths) {
        if (segments_.size() == kMostOpen) break;
        auto segment = Segment::opened(path, *lens_name(lens_key_));
        if (!segment) continue;
        for (std::size_t i = 0; i < segment->records.size(); ++i) {
            const Record& r = segment->records[i];
            places_.try_emplace({r.level, r.coc_radius_px, r.field_x, r.field_y}, Place{segment.get(), i});
        }
        segments_.push_back(std::move(segment));
    }
}

std::optional<PointSpread> KernelStore::find(const Key& key) const {
    const auto place = places_.find(key);
    if (place == places_.end()) return std::nullopt;
    const Record& record = place->second.segment->records[place->second.record];
    std::vector<float> floats(record.floats());
    const std::size_t bytes = floats.size() * sizeof(float);
    if (!place->second.segment->read(floats.data(), bytes, record.offset) ||
        hash_of(floats.data(), bytes, kMagic) != record.hash || !are_weights(record, floats))
        return std::nullopt;
    ++found_;
    return unpacked(record, floats);
}

void KernelStore::add(const Key& key, const PointSpread& kernel) {
    const Record as_record{
        0, 0, 0, 0, kernel.extent.x0, kernel.extent.y0, kernel.extent.x1, kernel.extent.y1, kernel.neutral,
        0, 0};
    const std::size_t bytes = as_record.floats() * sizeof(float) + sizeof(Record);
    const std::lock_guard lock(mutex_);
    if (written_bytes_ + pending_bytes_ + bytes > max_bytes_ / 8) return;
    PointSpread copy{kernel.extent, kernel.weights.clone(), kernel.neutral};
    // Kernels whose alpha or neutral colour is not what it is made from again would come back changed.
    if (!same_bits(unpacked(as_record, packed(copy)), kernel)) return;
    pending_.emplace_back(key, std::move(copy));
    pending_bytes_ += bytes;
    if (pending_bytes_ > kPendingBytes) write_pending();
}

// Requires: mutex_ is held.
void KernelStore::write_pending() {
    if (pending_.empty()) return;
    std::vector<Record> records;
    std::vector<std::vector<float>> weights;
    std::size_t offset = sizeof(Header) + pending_.size() * sizeof(Record);
    for (const auto& [key, kernel] : pending_) {
        weights.push_back(packed(kernel));
        const std::size_t bytes = weights.back().size() * sizeof(float);
        const Rect e = kernel.extent;
        records.push_back({key.coc_radius_px, key.field_x, key.field_y, key.level, e.x0, e.y0, e.x1, e.y1,
                           kernel.neutral, offset, hash_of(weights.back().data(), bytes, kMagic)});
        offset += bytes;
    }
    Header header;
    header.lens = *lens_name(lens_key_);
    header.records = records.size();
    header.index_hash = hash_of(records.data(), records.size() * sizeof(Record), kMagic);

    make_private(folder_);
    make_private(lens_folder_);
    const std::string name = lens_folder_ + "/" + own_name(), part = name + ".part";
    std::ofstream file(part, std::ios::binary);
    const auto write = [&](const void* from, std::size_t bytes) {
        file.write(static_cast<const char*>(from), std::streamsize(bytes));
    };
    write(&header, sizeof header);
    write(records.data(), records.size() * sizeof(Record));
    for (const std::vector<float>& floats : weights) write(floats.data(), floats.size() * sizeof(float));
    file.close();
    std::error_code problem;
    fs::permissions(part, fs::perms::owner_read | fs::perms::owner_write, problem);
    if (file)
        fs::rename(part, name + ".kernels", problem);
    else
        fs::remove(part, problem);
    written_bytes_ += pending_bytes_;
    pending_.clear(), pending_bytes_ = 0;
    make_room(folder_, max_bytes_);
}

namespace {

// A lens whose kernels are looked up first.
class KeptLens final : public LensOver {
public:
    KeptLens(std::unique_ptr<const LensModel> lens, std::shared_ptr<KernelStore> store, int level)
        : LensOver(std::move(lens)), store_(std::move(store)), level_(level) {}

    PointSpread point_spread(double coc_radius_px, FieldPosition field) const override {
        const KernelStore::Key key{level_, coc_radius_px, field.x, field.y};
        if (auto before = store_->find(key)) return std::move(*before);
        PointSpread made = under().point_spread(coc_radius_px, field);
        store_->add(key, made);
        return made;
    }

private:
    std::shared_ptr<KernelStore> store_;
    int level_;
};

}  // namespace

std::unique_ptr<const LensModel> kept(std::unique_ptr<const LensModel> lens,
                                      std::shared_ptr<KernelStore> store, int level) {
    if (lens->is_quick()) return lens;
    return std::make_unique<KeptLens>(std::move(lens), std::move(store), level);
}

}  // namespace petzval::kernel
