// Pictures to and from other programs, by the protocol of the viewer tev (github.com/Tom94/tev, src/Ipc.cpp):
// a renderer that pushes to tev pushes to this window as well. Of this machine alone: 127.0.0.1.
//
// A packet is its length in bytes, itself included (32 bits, little-endian), one byte that says what it is,
// and its fields: numbers of 32 or 64 bits, strings that end with a 0, floats.
#pragma once

#include "petzval/image.h"
#include "petzval/result.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace petzval::view {

inline constexpr int kTevPort = 14158;

// A picture that was pushed, as far as it has come.
struct Pushed {
    std::string name;
    Picture colour;  // R, G, B and A, that is 1 where there is none
    Plane depth_m;   // Z; empty: none
    bool has_alpha = false;
};

// Builds pictures from packets.
class TevInbox {
public:
    // Takes one packet, without its length. Errors: InvalidFile for an invalid packet; earlier pictures stay.
    Status take(std::span<const std::byte> packet);
    // Changes since the last call: a file to open, or a picture.
    std::string take_path();
    std::vector<std::shared_ptr<const Pushed>> take_pictures();

private:
    // Numbers of one channel, as an update brought them.
    struct Part {
        std::string channel;
        Rect pixels;
        std::vector<float> values;
    };
    // A picture as it comes. A sender may announce any size: until enough has come, memory holds the parts
    // alone.
    struct Canvas {
        int width = 0, height = 0;
        std::set<std::string> names;                         // of the channels that are shown
        std::map<std::string, std::vector<float>> channels;  // empty: too little has come
        std::vector<Part> waiting;
        std::size_t brought_bytes = 0;

        std::size_t bytes() const;  // of all channels and of the picture that is shown
        std::size_t bytes_ahead() const;
        void lay_out();
        void put(const Part& part);
    };
    class Fields;
    static std::shared_ptr<const Pushed> picture_of(const std::string& name, const Canvas& canvas);
    Status create(Fields& fields);
    Status update(Fields& fields, int version);
    // Takes memory for the picture if it has come far enough. False: it has not.
    bool is_laid_out(Canvas& canvas);

    std::map<std::string, Canvas> canvases_;
    std::string path_;
    std::set<std::string> changed_;
};

// Listens until it is gone. Its thread keeps one connection at a time; one that sends nonsense is closed.
class TevListener {
public:
    // `wake` is called, by the listener's thread, whenever there is news. Errors: Unsupported where the port
    // cannot be had.
    static Result<std::unique_ptr<TevListener>> open(int port, std::function<void()> wake);
    ~TevListener();
    TevListener(const TevListener&) = delete;
    TevListener& operator=(const TevListener&) = delete;

    struct News {
        std::string path, wrong;  // empty: none
        std::vector<std::shared_ptr<const Pushed>> pictures;
    };
    News news();

private:
    TevListener(int socket, std::function<void()> wake);
    void listen();
    void serve(int connection);
    Status read_packet(int connection, std::vector<std::byte>& packet, bool& ended);

    int socket_;
    std::function<void()> wake_;
    std::mutex mutex_;
    TevInbox inbox_;
    std::string wrong_;
    std::atomic<bool> ending_ = false;
    std::thread thread_;
};

// Errors: OutputFailed where nobody listens, or hangs up.
Status push_to_tev(int port, const std::string& name, const Picture& picture);

}  // namespace petzval::view
