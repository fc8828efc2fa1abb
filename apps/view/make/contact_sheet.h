// Small pictures of a frame through many looks, made on a separate thread.
#pragma once

#include "maker.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace petzval::view {

struct SheetEntry {
    std::string label;                  // as shown
    std::vector<std::string> commands;  // that choose it
    Look look;
    double f_number = 0;  // 0: the camera's
};

struct SheetCell {
    std::size_t entry = 0;
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  // empty: an error
    std::string error;
};

class ContactSheet {
public:
    // `wake` is called, by the sheet's thread, whenever a cell is there.
    ContactSheet(std::shared_ptr<Session> session, std::function<void()> wake);
    ~ContactSheet();  // cancels
    ContactSheet(const ContactSheet&) = delete;
    ContactSheet& operator=(const ContactSheet&) = delete;

    // Replaces the sheet in progress.
    void make(ShotPointer shot, const Camera& camera, std::vector<SheetEntry> entries,
              const DevelopSettings& display);
    void stop();
    std::vector<SheetCell> news();
    bool is_idle() const { return !busy_; }

private:
    void work(const ShotPointer& shot, Camera camera, const std::vector<SheetEntry>& entries,
              const DevelopSettings& display);

    std::shared_ptr<Session> session_;
    std::function<void()> wake_;
    std::mutex mutex_;
    std::vector<SheetCell> done_;
    std::atomic<bool> cancelled_ = false, busy_ = false;
    std::thread thread_;
};

}  // namespace petzval::view
