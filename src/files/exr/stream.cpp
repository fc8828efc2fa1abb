#include "files/exr/stream.h"

#include "base/cancel.h"

#include <algorithm>
#include <cstring>

#include <OpenEXR/Iex.h>

namespace petzval {
namespace {

constexpr std::uint64_t kReadAhead = 1 << 14;
constexpr std::size_t kWriteBehind = 1 << 20;

}  // namespace

ExrInputStream::ExrInputStream(std::shared_ptr<const InputFile> file, const Workers& workers)
    : Imf::IStream(file->path().c_str()), file_(std::move(file)), workers_(workers) {}

bool ExrInputStream::read(char to[], int bytes) {
    const std::uint64_t wanted = std::uint64_t(std::max(bytes, 0));
    if (position_ > file_->bytes() || wanted > file_->bytes() - position_)
        throw Iex::InputExc("it ends too early");
    const bool held = position_ >= buffer_start_ && position_ + wanted <= buffer_start_ + buffer_.size();
    if (!held) check_cancelled(workers_);
    if (!held && wanted < kReadAhead) {
        buffer_start_ = position_;
        buffer_.resize(std::size_t(std::min(kReadAhead, file_->bytes() - position_)));
        if (!file_->read_at(position_, buffer_.data(), buffer_.size()))
            throw Iex::InputExc("it cannot be read");
    }
    if (!held && wanted >= kReadAhead) {
        if (!file_->read_at(position_, to, std::size_t(wanted))) throw Iex::InputExc("it cannot be read");
    } else {
        std::memcpy(to, buffer_.data() + (position_ - buffer_start_), std::size_t(wanted));
    }
    position_ += wanted;
    return position_ < file_->bytes();
}

ExrOutputStream::ExrOutputStream(OutputFile& file) : Imf::OStream(file.path().c_str()), file_(file) {
    buffer_.reserve(kWriteBehind);
}

ExrOutputStream::~ExrOutputStream() {
    file_.write_at(position_ - buffer_.size(), buffer_.data(), buffer_.size());
}

void ExrOutputStream::write(const char from[], int bytes) {
    if (buffer_.size() + std::size_t(bytes) > kWriteBehind) flush();
    if (std::size_t(bytes) > kWriteBehind) {
        if (!file_.write_at(position_, from, std::size_t(bytes))) throw Iex::IoExc("it cannot be written");
    } else {
        buffer_.insert(buffer_.end(), from, from + bytes);
    }
    position_ += std::uint64_t(bytes);
}

void ExrOutputStream::seekp(std::uint64_t position) {
    flush();
    position_ = position;
}

void ExrOutputStream::flush() {
    const bool written = file_.write_at(position_ - buffer_.size(), buffer_.data(), buffer_.size());
    buffer_.clear();
    if (!written) throw Iex::IoExc("it cannot be written");
}

}  // namespace petzval
