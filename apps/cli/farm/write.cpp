// petzval farm write: a shot as a job for a render farm.
#include "petzval/farm/jobs.h"

#include "flags/defocus_flags.h"
#include "guard.h"
#include "verbs.h"

#include <filesystem>
#include <memory>

namespace petzval::cli {
namespace {

namespace fs = std::filesystem;

struct WriteFlags {
    std::vector<std::string> words;  // of petzval defocus, as typed
    std::string folder;
    std::optional<FarmSystem> system;
    int chunk = 0;  // 0: measured
    DefocusFlags shot;
};

constexpr const char* kExample =
    "petzval farm write --for slurm -o job -- beauty.####.exr -o out.####.exr --frames 1001-1100 --fstop 2";

// The words without `name` and, where it has one, its value.
std::vector<std::string> without(const std::vector<std::string>& words, const std::string& name) {
    std::vector<std::string> left;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] == name)
            ++i;
        else if (!words[i].starts_with(name + "="))
            left.push_back(words[i]);
    }
    return left;
}

void check(WriteFlags& flags, const Verb& verb) {
    if (!flags.system)
        throw UsageError(std::string("farm write needs --for SYSTEM; for example: ") + kExample);
    require_argument(verb, flags.folder, "-o FOLDER");
    if (flags.words.empty())
        throw UsageError(std::string("farm write needs the shot after --; for example: ") + kExample);
    read_words(
        "defocus", [&](Verb& defocus) { flags.shot.add_to(defocus); }, flags.words);
    DefocusFlags& shot = flags.shot;
    require_argument(verb, shot.input.path, "an input picture after --");
    require_argument(verb, shot.output, "the output frames after --, as -o OUT");
    shot.check(verb);
    if (!shot.is_shot)
        throw UsageError("a farm renders frames: neither the input nor -o contains #### or %04d");
    if (!shot.frames.report.empty())
        throw UsageError(
            "--report: the job writes a record of every frame to its folder records; leave out --report");
    if (shot.overwrite.overwrite)
        throw UsageError(
            "--overwrite: a chunk that runs again keeps complete frames; remove old frames first");
}

// The command of a chunk: this program, the words, and that complete frames are kept.
std::vector<std::string> command_of(const WriteFlags& flags) {
    std::error_code unknown;
    const fs::path self = fs::read_symlink("/proc/self/exe", unknown);
    std::vector<std::string> words = without(without(flags.words, "--frames"), "--threads");
    words.insert(words.begin(), {unknown ? "petzval" : self.string(), "defocus"});
    const ExistingOutputs existing = flags.shot.overwrite.existing();
    if (existing == ExistingOutputs::Replace) words.emplace_back("--no-clobber");
    return words;
}

FarmJob job_of(const WriteFlags& flags) {
    FarmJob job{.folder = flags.folder, .system = *flags.system, .chunk = flags.chunk};
    job.settings = flags.shot.settings();
    job.command = command_of(flags);
    job.threads = flags.shot.run.threads;
    job.memory_bytes = flags.shot.max_memory_bytes;
    job.look_file = flags.shot.look.file();
    return job;
}

Status write(const WriteFlags& flags) {
    Session session(flags.shot.session());
    return write_farm_job(session, job_of(flags), &run_files(), terminal());
}

}  // namespace

static void add_farm_write(Verb& farm, Action& chosen) {
    Verb& verb = add_verb(farm, "write", "write a shot as a job for a render farm", kExample);
    auto flags = std::make_shared<WriteFlags>();
    FlagGroup(verb, "Job")
        .words("SHOT", "after --: the arguments of petzval defocus", flags->words)
        .choice(
            "--for",
            "the farm: list, one command per line for make, xargs or cuecmd; slurm; flamenco; openjd, Open "
            "Job Description; opencue",
            farm_systems(), flags->system)
        .value("-o,--output", "FOLDER", "folder of the job, on a disk that all machines can access",
               parse_text, flags->folder)
        .value("--chunk", "N",
               "frames per process (default: about a minute of work; the middle frame is rendered to measure "
               "time and memory)",
               parse_count, flags->chunk);
    when_typed(verb, chosen, flags, check, write);
}

void add_farm(Verb& program, Action& chosen) {
    Verb& verb = add_verb(program, "farm", "jobs for render farms", kExample);
    add_farm_write(verb, chosen);
    add_farm_jobs(verb, chosen);
    when_typed(verb, [&verb] { require_verb(verb); });
}

}  // namespace petzval::cli
