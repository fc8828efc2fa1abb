#include "base/build_id.h"

#ifdef __linux__
#include <cstring>
#include <elf.h>
#include <link.h>

namespace petzval {
namespace {

struct Search {
    ElfW(Addr) inside = 0;  // an address of the object that is looked for
    std::string id;
};

bool holds(const dl_phdr_info& object, ElfW(Addr) address) {
    for (int i = 0; i < object.dlpi_phnum; ++i) {
        const ElfW(Phdr)& part = object.dlpi_phdr[i];
        const ElfW(Addr) begin = object.dlpi_addr + part.p_vaddr;
        if (part.p_type == PT_LOAD && address >= begin && address < begin + part.p_memsz) return true;
    }
    return false;
}

// Notes follow each other: sizes and type, name and content, each padded to four bytes (ELF specification).
std::string id_in_notes(const char* notes, std::size_t size) {
    const auto padded = [](std::size_t n) { return (n + 3) / 4 * 4; };
    while (size >= sizeof(ElfW(Nhdr))) {
        ElfW(Nhdr) note;
        std::memcpy(&note, notes, sizeof note);
        const std::size_t content = sizeof note + padded(note.n_namesz),
                          end = content + padded(note.n_descsz);
        if (end > size) return {};
        if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 &&
            std::memcmp(notes + sizeof note, "GNU", 4) == 0)
            return {notes + content, note.n_descsz};
        notes += end, size -= end;
    }
    return {};
}

int look(dl_phdr_info* object, std::size_t, void* data) {
    Search& search = *static_cast<Search*>(data);
    if (!holds(*object, search.inside)) return 0;
    for (int i = 0; i < object->dlpi_phnum && search.id.empty(); ++i) {
        const ElfW(Phdr)& part = object->dlpi_phdr[i];
        if (part.p_type != PT_NOTE) continue;
        // NOLINTNEXTLINE(performance-no-int-to-ptr): addresses are numbers in ELF
        search.id =
            id_in_notes(reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr), part.p_memsz);
    }
    return 1;
}

}  // namespace

std::string build_id() {
    static const char here = 0;
    Search search;
    search.inside = reinterpret_cast<ElfW(Addr)>(&here);
    dl_iterate_phdr(look, &search);
    return search.id;
}

}  // namespace petzval
#else
namespace petzval {

std::string build_id() { return {}; }

}  // namespace petzval
#endif
