// petzval lens buffer: a lens for the programs of the shader kit (docs/explain/shader-kit.md).
#include "petzval/lens_report.h"

#include "console/console.h"
#include "console/report.h"
#include "flags/run_flags.h"
#include "flags/values.h"
#include "input.h"
#include "lens/mount.h"
#include "output.h"
#include "verbs.h"

#include <memory>

namespace petzval::cli {
namespace {

struct BufferFlags : MountFlags {
    std::string output;
    Quality quality = Quality::Standard;
    OverwriteFlags overwrite;
    RunFlags run;
};

Status write_buffer(BufferFlags& flags) {
    if (flags.overwrite.skips({flags.output})) return Done{};
    LensBufferFile file{flags.look.look(), flags.camera.choice(), flags.width_px, flags.height_px};
    file.look.quality = flags.quality;
    file.output = flags.output;
    file.overwrite = !flags.overwrite.no_clobber;
    file.max_memory_bytes = process_memory_bytes(0);
    const auto made = make_lens_buffer(std::move(file));
    if (!made) return made.error();
    note("wrote " + flags.output + ": " + made->lens + " (" + camera_text(made->camera) + ")");
    return write_record(made->record, flags.run.json);
}

void check(BufferFlags& flags, const Verb& verb) {
    flags.run.apply();
    flags.overwrite.check();
    require_argument(verb, flags.output, "-o FILE");
    flags.check_lens(verb);
}

}  // namespace

void add_lens_buffer(Verb& lens, Action& chosen) {
    Verb& verb = add_verb(lens, "buffer", "write the lens buffer that the programs of the shader kit read",
                          "petzval lens buffer ideal --blades 7 --fstop 1.4 -o lens.bin\n"
                          "petzval lens buffer petzval-portrait --quality draft -o portrait.bin");
    auto flags = std::make_shared<BufferFlags>();
    flags->add_lens_to(verb);
    FlagGroup(verb, "Buffer")
        .choice<Quality>("--quality", "taps of a disc: draft 24, standard 48 (default), final 127",
                         flags->quality);
    FlagGroup(verb, "Output")
        .writes("-o,--output", "FILE", "32-bit floats, little-endian", flags->output)
        .value("--width", "PX", "width of the frame that the programs draw (default 1920)", parse_size_px,
               flags->width_px)
        .value("--height", "PX", "height of that frame (default 9/16 of the width)", parse_size_px,
               flags->height_px);
    flags->overwrite.add_to(verb, false);
    flags->run.add_json_to(verb);
    flags->run.add_log_to(verb, false);
    when_typed(verb, [flags, &verb, &chosen] {
        check(*flags, verb);
        chosen = [flags] { return write_buffer(*flags); };
    });
}

}  // namespace petzval::cli
