// OpenEXR's view of our files. Reading past the end throws at once; a failed write is remembered by the file,
// because OpenEXR's destructors swallow it.
#pragma once

#include "petzval/workers.h"

#include "files/input_file.h"
#include "files/output_file.h"

#include <memory>
#include <vector>

#include <OpenEXR/ImfIO.h>

namespace petzval {

class ExrInputStream : public Imf::IStream {
public:
    // Reading ends with Cancelled once the workers are cancelled (base/cancel.h): they outlive it.
    ExrInputStream(std::shared_ptr<const InputFile> file, const Workers& workers);

    bool read(char to[], int bytes) override;
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

private:
    std::shared_ptr<const InputFile> file_;
    const Workers& workers_;
    std::uint64_t position_ = 0, buffer_start_ = 0;
    std::vector<char> buffer_;  // headers are read byte by byte
};

class ExrOutputStream : public Imf::OStream {
public:
    explicit ExrOutputStream(OutputFile& file);
    ~ExrOutputStream() override;

    void write(const char from[], int bytes) override;
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override;
    void flush();

private:
    OutputFile& file_;
    std::uint64_t position_ = 0;
    std::vector<char> buffer_;  // the bytes just before position_, not written yet
};

}  // namespace petzval
