#include "library.h"

#include "effect.h"

#include <algorithm>
#include <cstring>
#include <dlfcn.h>
#include <elf.h>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace ofx_check {
namespace {

namespace fs = std::filesystem;
constexpr const char* kArchitecture = "Linux-x86-64";

// A table of an ELF file, empty where it does not lie inside of the file.
template <typename T>
std::vector<T> table(const std::string& bytes, std::size_t offset, std::size_t size) {
    std::vector<T> rows;
    if (offset > bytes.size() || size > bytes.size() - offset) return rows;
    rows.resize(size / sizeof(T));
    std::memcpy(rows.data(), bytes.data() + offset, rows.size() * sizeof(T));
    return rows;
}

}  // namespace

Bundle find_bundle(const std::string& path) {
    std::error_code ignored;
    fs::path folder(path);
    if (fs::is_regular_file(folder, ignored)) {
        const fs::path bundle = fs::absolute(folder).parent_path().parent_path().parent_path();
        return {path, bundle.filename() == folder.filename().string() + ".bundle"
                          ? find_bundle(bundle.string()).problem
                          : "the library is not in a bundle of its name"};
    }
    if (!folder.has_filename()) folder = folder.parent_path();
    const std::string name = folder.filename().string();
    if (!fs::is_directory(folder, ignored)) return {"", path + " is not a folder"};
    const fs::path binaries = folder / "Contents" / kArchitecture;
    const fs::path expected = binaries / folder.stem();
    if (!name.ends_with(".ofx.bundle")) return {"", name + " does not end with .ofx.bundle"};
    if (fs::is_regular_file(expected, ignored)) return {expected.string(), ""};
    for (const auto& entry : fs::recursive_directory_iterator(folder, ignored))
        if (entry.path().extension() == ".ofx")
            return {entry.path().string(), entry.path().string() + " is not " + expected.string()};
    return {"", expected.string() + " is missing"};
}

std::vector<std::string> exported_names(const std::string& library) {
    std::ifstream file(library, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    const auto headers = table<Elf64_Ehdr>(bytes, 0, sizeof(Elf64_Ehdr));
    if (headers.empty() || std::memcmp(headers[0].e_ident, ELFMAG, SELFMAG) != 0) return {};
    const auto sections =
        table<Elf64_Shdr>(bytes, headers[0].e_shoff, headers[0].e_shnum * sizeof(Elf64_Shdr));
    std::vector<std::string> names;
    for (const Elf64_Shdr& section : sections) {
        if (section.sh_type != SHT_DYNSYM || section.sh_link >= sections.size()) continue;
        const Elf64_Shdr& strings = sections[section.sh_link];
        const auto text = table<char>(bytes, strings.sh_offset, strings.sh_size);
        for (const Elf64_Sym& symbol : table<Elf64_Sym>(bytes, section.sh_offset, section.sh_size)) {
            const unsigned bind = ELF64_ST_BIND(symbol.st_info), look = ELF64_ST_VISIBILITY(symbol.st_other);
            const bool visible = look == STV_DEFAULT || look == STV_PROTECTED;
            if (symbol.st_shndx == SHN_UNDEF || symbol.st_shndx == SHN_ABS || bind == STB_LOCAL || !visible)
                continue;
            if (symbol.st_name < text.size()) names.emplace_back(text.data() + symbol.st_name);
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

Library::Library(const std::string& path, std::string& problem)
    : handle_(dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (handle_) return;
    const char* why = dlerror();
    problem = why ? why : "cannot be loaded";
}

Library::~Library() {
    if (handle_) dlclose(handle_);
}

template <typename Function>
Function* Library::function(const char* name) const {
    return handle_ ? reinterpret_cast<Function*>(dlsym(handle_, name)) : nullptr;
}

int Library::plugin_count() const {
    if (auto* set_host = function<int(const ofx::Host*)>("OfxSetHost");
        set_host && set_host(the_host()) == ofx::kFailed)
        return 0;
    auto* count = function<int()>("OfxGetNumberOfPlugins");
    return count ? count() : 0;
}

ofx::Plugin* Library::plugin(int nth) const {
    auto* get = function<ofx::Plugin*(int)>("OfxGetPlugin");
    return get ? get(nth) : nullptr;
}

}  // namespace ofx_check
