// petzval farm write: a shot as a job for a render farm.
#include "petzval/farm/jobs.h"
#include "petzval/shot_run.h"

#include "console/console.h"
#include "flags/defocus_flags.h"
#include "guard.h"
#include "verbs.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

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
    shot.check(verb);
    if (!is_sequence(shot))
        throw UsageError("a farm renders frames: neither the input nor -o holds #### or %04d");
    if (!shot.frames.report.empty())
        throw UsageError("--report: the job keeps its records itself, in the folder records");
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

// The cost of the middle frame, which is rendered into the job's folder.
Status measure(const WriteFlags& flags, FarmShot& shot) {
    ShotRunHost host;
    host.cancelled = terminal().cancelled;
    Session session(flags.shot.session());
    const int frame = shot.frames[shot.frames.size() / 2];
    const auto cost = measure_frame(session, flags.shot.settings(), frame, shot.folder, host);
    if (!cost) return cost.error();
    set_cost(shot, cost->seconds, cost->peak_memory_bytes);
    note("frame " + std::to_string(frame) + ": " + plain(shot.seconds_per_frame, 3) + " s, so " +
         std::to_string(shot.chunk) + (shot.chunk == 1 ? " frame" : " frames") + " per process");
    return Done{};
}

Result<FarmShot> facts(const WriteFlags& flags) {
    FarmShot shot = farm_shot_in(flags.folder);
    shot.command = command_of(flags);
    shot.threads = flags.shot.run.threads;
    shot.memory_bytes = flags.shot.max_memory_bytes;
    shot.input = flags.shot.input.path;
    shot.output = flags.shot.output;
    const auto& words = flags.words;
    const auto look = std::find(words.begin(), words.end(), "--look");
    if (look != words.end() && look + 1 != words.end()) shot.look = *(look + 1);
    shot.track = flags.shot.track.file;
    ShotRunSettings settings = flags.shot.settings();
    settings.existing = ExistingOutputs::Keep;
    Session session(flags.shot.session());
    ShotRun run(session, settings, {});
    if (Status planned = run.plan(&run_files()); !planned) return planned.error();
    shot.frames = run.frames();
    std::sort(shot.frames.begin(), shot.frames.end());
    return shot;
}

Status write(const WriteFlags& flags) {
    auto shot = facts(flags);
    if (!shot) return shot.error();
    shot->chunk = std::max(flags.chunk, 1);
    // Refused before a frame is rendered.
    if (auto early = farm_files(*shot, *flags.system); !early) return early.error();
    std::error_code error;
    fs::create_directories(shot->folder, error);
    if (error) return Error{ErrorCode::OutputFailed, "-o " + flags.folder + ": " + error.message()};
    if (flags.chunk == 0)
        if (Status done = measure(flags, *shot); !done) return done;
    const auto files = farm_files(*shot, *flags.system);
    if (!files) return files.error();
    for (const FarmFile& file : *files) {
        const auto path = write_farm_file(*shot, file);
        if (!path) return path.error();
        note("wrote " + *path);
    }
    return Done{};
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
        .value("-o,--output", "FOLDER", "folder of the job, on a disk that all machines see", parse_text,
               flags->folder)
        .value("--chunk", "N",
               "frames that one process renders (default: as many as take a minute; the middle frame is "
               "rendered to measure that, and the memory)",
               parse_count, flags->chunk);
    when_typed(verb, [flags, &verb, &chosen] {
        check(*flags, verb);
        chosen = [flags] { return write(*flags); };
    });
}

void add_farm(Verb& program, Action& chosen) {
    Verb& verb = add_verb(program, "farm", "jobs for render farms", kExample);
    add_farm_write(verb, chosen);
    add_farm_jobs(verb, chosen);
    when_typed(verb, [&verb] { require_verb(verb); });
}

}  // namespace petzval::cli
