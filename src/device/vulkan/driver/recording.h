// Commands for a device, from the first to the end of the last.
#pragma once

#include "device/vulkan/driver/context.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace petzval::device::vulkan {

// Groups of a pass, at least one each.
struct Groups {
    std::uint32_t x = 1, y = 1, z = 1;
};
// In rows of the most groups that any device takes.
inline Groups groups_of(std::size_t groups) {
    constexpr std::size_t kMost = 65535;
    return {std::uint32_t(std::min(groups, kMost)), std::uint32_t((groups + kMost - 1) / kMost)};
}
// Groups of 256 invocations.
inline Groups invocations(std::size_t count) { return groups_of((count + 255) / 256); }

// Passes that follow each other see what those before them wrote. Throws Failed.
class Recording {
public:
    explicit Recording(Context& context);
    ~Recording();
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;

    // A new piece on the device that holds these bytes once the recording has run. It lives at least until
    // then.
    Piece uploaded(std::span<const std::byte> bytes);
    template <typename T>
    Piece uploaded(std::span<const T> values) {
        return uploaded(std::as_bytes(values));
    }
    // The same of several parts, one after the other.
    Piece uploaded(const std::vector<std::span<const std::byte>>& parts);
    // buffers, push: as the program declares them.
    template <typename Push>
    void pass(const char* name, const Program& program, std::initializer_list<const Piece*> buffers,
              const Push& push, Groups groups, const PassWork& work = {}) {
        pass(name, program, buffers, std::as_bytes(std::span(&push, 1)), groups, work);
    }
    // Call these around commands that other code records, to time them.
    void begin_pass(const char* name, const PassWork& work = {});
    void end_pass();
    // Copies from one piece to another, from that byte offset on.
    void copy(const Piece& from, const Piece& to, std::size_t bytes, std::size_t from_byte = 0,
              std::size_t to_byte = 0);
    // The piece's bytes once the recording has run, in memory that the host sees. They live as long as this.
    const std::byte* downloaded(const Piece& piece, std::size_t bytes);
    // The command buffer, for other recording code: uploads may be copied from here on.
    VkCommandBuffer commands() const { return commands_; }
    void wait_for_uploads() { order(VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_READ_BIT); }
    // Runs the commands and waits for their end. Nothing may be recorded afterwards. Returns the seconds that
    // it took.
    double run();

private:
    void pass(const char* name, const Program& program, std::initializer_list<const Piece*> buffers,
              std::span<const std::byte> push, Groups groups, const PassWork& work);
    // Descriptor pools for any number of passes, 64 passes each.
    struct Pools {
        VkDescriptorPool sets = VK_NULL_HANDLE;
        VkQueryPool queries = VK_NULL_HANDLE;  // null: not timed
    };
    Pools& pools_of_next();
    void add_pools();
    void write_time(std::size_t query);
    VkDescriptorSet set_for(const Program& program, std::initializer_list<const Piece*> buffers);
    void check_range(const Piece& piece) const;
    void order(VkPipelineStageFlags to, VkAccessFlags access);
    void note_times();

    static constexpr std::uint32_t kPassesOfPools = 64, kQueriesOfPools = 2 * kPassesOfPools;
    Context& context_;
    const Functions& vk_;
    const bool times_passes_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    std::vector<Pools> pools_;
    VkFence fence_ = VK_NULL_HANDLE;
    bool submitted_ = false;
    std::vector<Piece> staging_;
    struct Timed {
        std::string name;
        PassWork work;
    };
    std::vector<Timed> passes_;
};

}  // namespace petzval::device::vulkan
