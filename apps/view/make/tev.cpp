#include "tev.h"

#include <algorithm>
#include <arpa/inet.h>
#include <bit>
#include <cerrno>
#include <cstring>
#include <limits>
#include <netinet/in.h>
#include <new>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>
#include <utility>

namespace petzval::view {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are sent as they lie in memory");

enum Kind {
    kOpen = 0,
    kReload = 1,
    kClose = 2,
    kUpdate = 3,
    kCreate = 4,
    kUpdate2 = 5,
    kUpdate3 = 6,
    kOpen2 = 7,
    kVectors = 8
};
constexpr std::uint32_t kMostBytes = 1U << 30;  // of a packet
constexpr std::int64_t kMostPixels = std::int64_t(1) << 26;
constexpr int kMostChannels = 64;
constexpr std::size_t kMostPictures = 16;
// Pictures take at most this many times the memory that was brought for them, and this much more in all.
constexpr std::size_t kTimesBrought = 16, kMostBytesAhead = std::size_t(512) << 20;

Error nonsense(const std::string& why) {
    return {ErrorCode::InvalidFile, "the pushed data is not a picture: " + why};
}

std::string letter_of(const std::string& channel) {
    const std::size_t dot = channel.rfind('.');
    const std::string last = dot == std::string::npos ? channel : channel.substr(dot + 1);
    return last == "r" || last == "g" || last == "b" || last == "a" || last == "z"
               ? std::string(1, char(last[0] - 'a' + 'A'))
               : last;
}

sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(std::uint16_t(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

// Waits until there is something to read, and looks up now and then. False: it is to end.
bool is_readable(int socket, const std::atomic<bool>& ending) {
    pollfd asked{socket, POLLIN, 0};
    while (!ending) {
        const int ready = poll(&asked, 1, 100);
        if (ready > 0) return true;
        if (ready < 0 && errno != EINTR) return false;
    }
    return false;
}

}  // namespace

// The fields of a packet, one after the other; what lies beyond its end is empty, and remembered.
class TevInbox::Fields {
public:
    explicit Fields(std::span<const std::byte> packet) : rest_(packet) {}

    template <typename T>
    T number() {
        T value{};
        if (rest_.size() < sizeof(T)) return failed_ = true, value;
        std::memcpy(&value, rest_.data(), sizeof(T));
        rest_ = rest_.subspan(sizeof(T));
        return value;
    }
    std::string text() {
        const auto end = std::find(rest_.begin(), rest_.end(), std::byte{0});
        if (end == rest_.end()) return failed_ = true, std::string();
        const std::size_t length = std::size_t(end - rest_.begin());
        std::string read(reinterpret_cast<const char*>(rest_.data()), length);  // NOLINT: bytes as letters
        rest_ = rest_.subspan(length + 1);
        return read;
    }
    std::span<const std::byte> rest() const { return rest_; }
    bool failed() const { return failed_; }

private:
    std::span<const std::byte> rest_;
    bool failed_ = false;
};

std::size_t TevInbox::Canvas::bytes() const {
    return std::size_t(width) * std::size_t(height) *
           (names.size() * sizeof(float) + sizeof(Rgba) + sizeof(float));
}

// Memory beyond the limit of the received data.
std::size_t TevInbox::Canvas::bytes_ahead() const {
    return bytes() - std::min(bytes(), kTimesBrought * brought_bytes);
}

void TevInbox::Canvas::lay_out() {
    for (const std::string& name : names)
        channels[name].assign(std::size_t(width) * std::size_t(height), 0.0f);
    for (const Part& part : std::exchange(waiting, {})) put(part);
}

void TevInbox::Canvas::put(const Part& part) {
    std::vector<float>& channel = channels.at(part.channel);
    const Rect& r = part.pixels;
    auto from = part.values.begin();
    for (int y = r.y0; y < r.y1; ++y, from += r.width())
        std::copy_n(from, r.width(),
                    channel.begin() + std::ptrdiff_t(y) * std::ptrdiff_t(width) + std::ptrdiff_t(r.x0));
}

bool TevInbox::is_laid_out(Canvas& canvas) {
    if (!canvas.channels.empty() || canvas.names.empty()) return !canvas.names.empty();
    std::size_t ahead = canvas.bytes_ahead();
    for (const auto& [name, other] : canvases_)
        if (!other.channels.empty()) ahead += other.bytes_ahead();
    if (ahead > kMostBytesAhead) return false;
    canvas.lay_out();
    return true;
}

Status TevInbox::take(std::span<const std::byte> packet) {
    Fields fields(packet);
    const int kind = fields.number<std::uint8_t>();
    if (fields.failed()) return nonsense("an empty packet");
    if (kind == kVectors) return Done{};
    if (kind == kCreate) return create(fields);
    if (kind == kUpdate) return update(fields, 1);
    if (kind == kUpdate2) return update(fields, 2);
    if (kind == kUpdate3) return update(fields, 3);
    if (kind != kOpen && kind != kOpen2 && kind != kReload && kind != kClose)
        return nonsense("a packet of kind " + std::to_string(kind));
    if (kind != kClose) fields.number<std::uint8_t>();  // whether to be in front
    const std::string name = fields.text();
    if (fields.failed() || name.empty()) return nonsense("no name");
    if (kind == kClose)
        canvases_.erase(name);
    else
        path_ = name;
    return Done{};
}

Status TevInbox::create(Fields& fields) {
    fields.number<std::uint8_t>();
    const std::string name = fields.text();
    const auto width = fields.number<std::int32_t>(), height = fields.number<std::int32_t>(),
               count = fields.number<std::int32_t>();
    if (fields.failed() || width < 1 || height < 1 || std::int64_t(width) * height > kMostPixels ||
        count < 1 || count > kMostChannels)
        return nonsense("not 1 to 2^26 pixels of 1 to 64 channels");
    if (canvases_.size() >= kMostPictures && !canvases_.contains(name))
        return nonsense("more than " + std::to_string(kMostPictures) + " at once");
    Canvas canvas;
    canvas.width = width, canvas.height = height;
    for (int i = 0; i < count; ++i) {
        const std::string channel = letter_of(fields.text());
        if (fields.failed()) return nonsense("a channel without a name");
        if (std::string("RGBAZ").find(channel) != std::string::npos) canvas.names.insert(channel);
    }
    canvases_[name] = std::move(canvas);
    return Done{};
}

// Versions: one channel; several, one after the other; several, each with where it begins and how far its
// numbers lie apart.
Status TevInbox::update(Fields& fields, int version) {
    fields.number<std::uint8_t>();
    const std::string name = fields.text();
    const auto found = canvases_.find(name);
    if (fields.failed() || found == canvases_.end()) return nonsense("an update of an unknown picture");
    Canvas& canvas = found->second;
    const int count = version == 1 ? 1 : fields.number<std::int32_t>();
    if (fields.failed() || count < 1 || count > kMostChannels) return nonsense("not 1 to 64 channels");
    std::vector<std::string> channels;
    for (int i = 0; i < count; ++i) channels.push_back(letter_of(fields.text()));
    const std::int64_t x = fields.number<std::int32_t>(), y = fields.number<std::int32_t>(),
                       width = fields.number<std::int32_t>(), height = fields.number<std::int32_t>();
    if (fields.failed() || x < 0 || y < 0 || width < 1 || height < 1 || x + width > canvas.width ||
        y + height > canvas.height)
        return nonsense("an update outside its picture");
    const std::int64_t pixels = width * height;
    std::vector<std::int64_t> offsets, strides;
    for (int i = 0; i < count; ++i)
        offsets.push_back(version == 3 ? fields.number<std::int64_t>() : i * pixels);
    for (int i = 0; i < count; ++i) strides.push_back(version == 3 ? fields.number<std::int64_t>() : 1);
    const std::int64_t there = std::int64_t(fields.rest().size() / sizeof(float));
    canvas.brought_bytes += fields.rest().size();
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        const bool fits = offsets[i] >= 0 && offsets[i] < there && strides[i] > 0 && strides[i] < there + 1 &&
                          (pixels - 1) <= (there - 1 - offsets[i]) / strides[i];
        if (fields.failed() || !fits) return nonsense("fewer numbers than pixels");
        const auto later = channels.begin() + std::ptrdiff_t(i) + 1;
        if (!canvas.names.contains(channels[i]) ||
            std::find(later, channels.end(), channels[i]) != channels.end())  // the last of a letter counts
            continue;
        Part part{channels[i], {int(x), int(y), int(x + width), int(y + height)}, {}};
        part.values.resize(std::size_t(pixels));
        for (std::int64_t p = 0; p < pixels; ++p)
            std::memcpy(&part.values[std::size_t(p)],
                        fields.rest().data() + std::size_t(offsets[i] + p * strides[i]) * sizeof(float),
                        sizeof(float));
        if (is_laid_out(canvas))
            canvas.put(part);
        else
            canvas.waiting.push_back(std::move(part));
    }
    if (is_laid_out(canvas)) changed_.insert(name);
    return Done{};
}

std::string TevInbox::take_path() { return std::exchange(path_, {}); }

std::shared_ptr<const Pushed> TevInbox::picture_of(const std::string& name, const Canvas& canvas) {
    auto pushed = std::make_shared<Pushed>();
    pushed->name = name;
    pushed->has_alpha = canvas.channels.contains("A");
    pushed->colour = Picture(canvas.width, canvas.height);
    const auto copy = [&](const char* channel, float Rgba::*to) {
        const auto from = canvas.channels.find(channel);
        for (std::size_t i = 0; i < pushed->colour.size(); ++i)
            pushed->colour.pixels()[i].*to =
                from == canvas.channels.end() ? float(channel[0] == 'A') : from->second[i];
    };
    copy("R", &Rgba::r), copy("G", &Rgba::g), copy("B", &Rgba::b), copy("A", &Rgba::a);
    if (const auto depth = canvas.channels.find("Z"); depth != canvas.channels.end()) {
        pushed->depth_m = Plane(canvas.width, canvas.height);
        for (std::size_t i = 0; i < depth->second.size(); ++i) {
            const float z = depth->second[i];
            pushed->depth_m.pixels()[i] = z > 0 && z < 1e10f ? z : std::numeric_limits<float>::infinity();
        }
    }
    return pushed;
}

std::vector<std::shared_ptr<const Pushed>> TevInbox::take_pictures() {
    std::vector<std::shared_ptr<const Pushed>> pictures;
    for (const std::string& name : std::exchange(changed_, {}))
        if (const auto found = canvases_.find(name); found != canvases_.end())
            pictures.push_back(picture_of(name, found->second));
    return pictures;
}

Result<std::unique_ptr<TevListener>> TevListener::open(int port, std::function<void()> wake) {
    const int made = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int on = 1;
    if (made >= 0) ::setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    const sockaddr_in address = loopback(port);
    const auto* as_any = reinterpret_cast<const sockaddr*>(&address);  // NOLINT: as the call has it
    if (made < 0 || ::bind(made, as_any, sizeof address) != 0 || ::listen(made, 4) != 0) {
        const std::string why = std::strerror(errno);
        if (made >= 0) ::close(made);
        return Error{ErrorCode::Unsupported,
                     "port " + std::to_string(port) + " cannot be opened: " + why + " (is tev running?)"};
    }
    return std::unique_ptr<TevListener>(new TevListener(made, std::move(wake)));
}

TevListener::TevListener(int socket, std::function<void()> wake)
    : socket_(socket), wake_(std::move(wake)), thread_([this] { listen(); }) {}

TevListener::~TevListener() {
    ending_ = true;
    thread_.join();
    ::close(socket_);
}

TevListener::News TevListener::news() {
    const std::lock_guard lock(mutex_);
    return {inbox_.take_path(), std::exchange(wrong_, {}), inbox_.take_pictures()};
}

void TevListener::listen() {
    while (is_readable(socket_, ending_)) {
        const int connection = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
        if (connection < 0) continue;
        serve(connection);
        ::close(connection);
    }
}

void TevListener::serve(int connection) {
    bool ended = false;
    while (!ended) {
        std::vector<std::byte> packet;
        Status done = Done{};
        try {
            done = read_packet(connection, packet, ended);
            if (ended && done) return;
            const std::lock_guard lock(mutex_);
            if (done) done = inbox_.take(packet);
            if (!done) wrong_ = done.error().message;
        } catch (const std::bad_alloc&) {
            const std::lock_guard lock(mutex_);
            wrong_ = "the pushed picture does not fit in memory";
            done = nonsense("too large");
        }
        wake_();
        if (!done) return;
    }
}

Status TevListener::read_packet(int connection, std::vector<std::byte>& packet, bool& ended) {
    std::uint32_t length = 0;
    const auto receive = [&](void* to, std::size_t bytes) {
        auto* at = static_cast<std::byte*>(to);
        while (bytes > 0) {
            if (!is_readable(connection, ending_)) return false;
            const ssize_t got = ::recv(connection, at, bytes, 0);
            if (got <= 0) return false;
            at += got, bytes -= std::size_t(got);
        }
        return true;
    };
    ended = !receive(&length, sizeof length);
    if (ended) return Done{};
    if (length <= sizeof length || length > kMostBytes)
        return nonsense("a packet of " + std::to_string(length) + " bytes");
    // Memory is taken as bytes come, not as they are promised.
    constexpr std::size_t kPiece = 1 << 20;
    std::size_t left = length - sizeof length;
    while (left > 0 && !ended) {
        const std::size_t piece = std::min(left, kPiece), before = packet.size();
        packet.resize(before + piece);
        ended = !receive(packet.data() + before, piece);
        left -= piece;
    }
    if (ended && !ending_) return nonsense("it ends before its length");
    return Done{};
}

namespace {

class Packet {
public:
    explicit Packet(Kind kind) {
        put(std::uint32_t(0));
        put(std::uint8_t(kind));
    }
    template <typename T>
    void put(T number) {
        const auto* from =
            reinterpret_cast<const std::byte*>(&number);  // NOLINT: a number as it lies in memory
        bytes_.insert(bytes_.end(), from, from + sizeof number);
    }
    void put(const std::string& text) {
        for (const char c : text) put(std::uint8_t(c));
        put(std::uint8_t(0));
    }
    bool send(int connection) {
        const std::uint32_t length = std::uint32_t(bytes_.size());
        std::memcpy(bytes_.data(), &length, sizeof length);
        std::size_t sent = 0;
        while (sent < bytes_.size()) {
            const ssize_t now = ::send(connection, bytes_.data() + sent, bytes_.size() - sent, MSG_NOSIGNAL);
            if (now <= 0) return false;
            sent += std::size_t(now);
        }
        return true;
    }

private:
    std::vector<std::byte> bytes_;
};

constexpr const char* kSent[] = {"R", "G", "B", "A"};

bool send_rows(int connection, const std::string& name, const Picture& picture, int y0, int y1) {
    Packet rows(kUpdate3);
    rows.put(std::uint8_t(0)), rows.put(name), rows.put(std::int32_t(4));
    for (const char* channel : kSent) rows.put(std::string(channel));
    for (const int number : {0, y0, picture.width(), y1 - y0}) rows.put(std::int32_t(number));
    for (std::int64_t i = 0; i < 4; ++i) rows.put(i);
    for (int i = 0; i < 4; ++i) rows.put(std::int64_t(4));
    for (int y = y0; y < y1; ++y)
        for (int x = 0; x < picture.width(); ++x)
            for (const float value : {picture(x, y).r, picture(x, y).g, picture(x, y).b, picture(x, y).a})
                rows.put(value);
    return rows.send(connection);
}

}  // namespace

Status push_to_tev(int port, const std::string& name, const Picture& picture) {
    const std::string where = "127.0.0.1:" + std::to_string(port);
    const int connection = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const sockaddr_in address = loopback(port);
    const auto* as_any = reinterpret_cast<const sockaddr*>(&address);  // NOLINT: as the call has it
    const timeval patience{10, 0};
    if (connection >= 0) ::setsockopt(connection, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    if (connection < 0 || ::connect(connection, as_any, sizeof address) != 0) {
        if (connection >= 0) ::close(connection);
        return Error{ErrorCode::OutputFailed, "no program listens on " + where + "; start tev first"};
    }
    Packet create(kCreate);
    create.put(std::uint8_t(1)), create.put(name);
    for (const int number : {picture.width(), picture.height(), 4}) create.put(std::int32_t(number));
    for (const char* channel : kSent) create.put(std::string(channel));
    bool fine = create.send(connection);
    constexpr int kRows = 64;
    for (int y = 0; fine && y < picture.height(); y += kRows)
        fine = send_rows(connection, name, picture, y, std::min(picture.height(), y + kRows));
    ::close(connection);
    if (!fine) return Error{ErrorCode::OutputFailed, where + " hung up"};
    return Done{};
}

}  // namespace petzval::view
